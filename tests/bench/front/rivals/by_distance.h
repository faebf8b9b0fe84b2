// Fixed distances, as groups of levels of detail have them: whatever the frame takes.
#pragma once

#include "tests/bench/front/rivals/rival.h"

namespace bench::front {

class ByDistance final : public Rival {
public:
    // [m] of view depth, 0 <= meshes_to <= points_to <= splats_from.
    struct Distances {
        double meshes_to;    // nearer people are meshes
        double points_to;    // to here points of S = 1 px, then half as many from each doubling of the distance on
        double splats_from;  // farther blocks are a splat a person
    };
    ByDistance(Cast cast, const Distances& distances) : Rival(std::move(cast)), distances_(distances) {}

    float points_of(const render::Subject& subject) const override;
    bool is_splat(const render::Subject& subject) const override;

private:
    void decide(std::span<const render::Subject>) override {}

    Distances distances_;
};

}  // namespace bench::front
