// A budget for everybody together: who is largest on the screen gets all that they can use, one after the other.
#pragma once

#include "tests/bench/front/rivals/rival.h"

namespace bench::front {

class LargestFirst final : public Rival {
public:
    // `budget`: points, and what costs as much, of all who are drawn alone. Spent within what the next in line would
    // have got; overdrawn only where the floor that everybody has takes more.
    LargestFirst(Cast cast, double budget) : Rival(std::move(cast)), budget_(budget) {}

    float points_of(const render::Subject& subject) const override;

private:
    void decide(std::span<const render::Subject> people) override;

    double budget_;
    float full_above_ = 0;  // [px^2] of surface
};

}  // namespace bench::front
