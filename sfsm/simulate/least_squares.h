// Linear least squares of a few unknowns over any number of equations: each is rotated into a triangle as it comes, so
// memory doesn't grow, and nothing is squared that would lose digits. The same equations give the same bits.
#pragma once

#include <array>
#include <cstdint>

#include "sfsm/work.h"

namespace sfsm::simulate {

// What a frame costs: what every frame has, and each kind of work.
inline constexpr int unknowns = 1 + static_cast<int>(work_kinds);
using Unknowns = std::array<double, unknowns>;

class LeastSquares {
public:
    // One more equation: sum of coefficient * unknown = value; finite.
    void add(const Unknowns& coefficients, double value);

    // The unknowns of the least sum of squares. Bit i of `free`: unknown i may differ from 0; the others are 0. Of
    // unknowns that the equations can't tell apart, the last are 0.
    Unknowns solve(std::uint32_t free) const;

    // What the sum of squares would be.
    double residual(const Unknowns& at) const;

    // The least sum of squares with no unknown below 0: each set of unknowns is held at 0 in turn, and of the
    // solutions that are in order the best is taken.
    Unknowns solve_non_negative() const;

    // The diagonal of the inverse of the normal equations' matrix: variances where those of the values are 1. Infinite
    // where the equations don't tell.
    Unknowns variances() const;

private:
    using Row = std::array<double, unknowns + 1>;  // the last is the value

    LeastSquares only(std::uint32_t free) const;
    bool is_told(int unknown) const;

    std::array<Row, unknowns> triangle_{};  // upper
    double rest_ = 0;                       // sum of squares that no unknown explains
};

}  // namespace sfsm::simulate
