// A decision with what it would draw and lose.
#pragma once

#include <array>

#include "sfsm/decision.h"
#include "sfsm/prices.h"

namespace sfsm {

struct Plan {
    State state = State::original;
    double distance = 0;                      // D [m], at most L, where everybody moves
    double size = 0;                          // S [px]; 0: triangles
    double rate = 0;                          // Decision::rate
    std::array<double, work_kinds> counts{};  // of each kind; fractions between two steps

    // Where a picture keeps 1 / (1 + loss) of its detail. By D and S: [px] of motion and shapes together. By rate:
    // FLIP, in units of flip_of_a_pixel.
    double loss = 0;

    constexpr double operator[](WorkKind kind) const { return counts[index_of(kind)]; }
};

// The FLIP that is as bad as a pixel by D and S: with it a picture has half its detail, and twice the time is worth
// half the loss. Below a twentieth a crowd hardly looks any worse, so less loss is worth little time there.
inline constexpr double flip_of_a_pixel = 0.05;

double plan_ms(const Plan& plan, const Prices& prices);

// What a plan's detail, 1 / (1 + loss), costs: the time of a whole one [ms].
double ms_of_detail(const Plan& plan, double ms);

// D is at most `range`, L [m], and infinite in state 0; S is over 0 in state 2 alone: where it draws no points, the
// largest. A rate that isn't finite and over 0 leaves the decision to D and S.
Decision decision_of(const Plan& plan, double range);

// Whether `ms` is less than `other_ms` by more than rounding.
bool is_cheaper(double ms, double other_ms);

// A number or count between two of them; share in [0, 1]. Straight in logarithms, or straight where there are none.
double power_between(double a, double b, double share);

}  // namespace sfsm
