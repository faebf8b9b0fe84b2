// A budget for everybody together: all begin in full, and the smallest on the screen go down a level, one after the
// other and round after round, until the rest fits.
#pragma once

#include "tests/bench/front/rivals/rival.h"

namespace bench::front {

class SmallestDemoted final : public Rival {
public:
    // `budget`: as LargestFirst's.
    SmallestDemoted(Cast cast, double budget) : Rival(std::move(cast)), budget_(budget) {}

    float points_of(const render::Subject& subject) const override;

private:
    void decide(std::span<const render::Subject> people) override;
    // A level is half of the points of the one before, down to the floor.
    Detail at_level(const render::Subject& subject, int level) const;

    double budget_;
    int level_ = 0;          // of those who are larger
    float lower_up_to_ = 0;  // [px^2] of surface: they are a level below
};

}  // namespace bench::front
