// A law driven by hand: each time answers the newest decision.
#pragma once

#include <gtest/gtest.h>

#include "tests/sfsm/simulation.h"

namespace sfsm {

template <class Law>
struct Driven {
    template <class... Constants>
    explicit Driven(double target_ms, const Constants&... constants)
        : law(constants...), target(target_ms), decision(law.decide({target, range})) {}

    Law law;
    double target;
    double range = test_range;
    Decision decision;

    const Decision& answer(double ms) {
        law.observe({0, ms, decision, {}});
        return decision = law.decide({target, range});
    }
    const Decision& answer(double ms, int times) {
        for (int i = 0; i < times; ++i) answer(ms);
        return decision;
    }
    const Decision& retarget(double ms) { return decision = law.decide({target = ms, range}); }
    const Decision& reach(double metres) { return decision = law.decide({target, range = metres}); }

    // Answers `ms` for as long as the state, or the decision, is the present one. Returns how many times that took.
    int leave_state(double ms) {
        return leave(ms, [state = decision.state](const Decision& d) { return d.state != state; });
    }
    int leave_decision(double ms) {
        return leave(ms, [here = decision](const Decision& d) { return d != here; });
    }

private:
    template <class Left>
    int leave(double ms, const Left& has_left) {
        constexpr int most_times = 100'000;  // the longest wait of a law is a third of that
        int times = 0;
        for (; !has_left(decision) && times < most_times; ++times) answer(ms);
        EXPECT_LT(times, most_times) << "it never left state " << static_cast<int>(decision.state);
        return times;
    }
};

}  // namespace sfsm
