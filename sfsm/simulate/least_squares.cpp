#include "sfsm/simulate/least_squares.h"

#include <cmath>
#include <limits>

namespace sfsm::simulate {
namespace {

constexpr double rounding = 1e-14;  // of a column: less than this share of it is left is nothing
constexpr std::uint32_t all = (1U << unknowns) - 1;

bool has(std::uint32_t set, int unknown) {
    return (set >> unknown & 1U) != 0;
}

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

}  // namespace

// Givens rotations: each takes out one coefficient of the new row.
void LeastSquares::add(const Unknowns& coefficients, double value) {
    Row row{};
    for (int i = 0; i < unknowns; ++i) row[at(i)] = coefficients[at(i)];
    row[unknowns] = value;
    for (int i = 0; i < unknowns; ++i) {
        if (row[at(i)] == 0) continue;
        Row& pivot = triangle_[at(i)];
        const double length = std::sqrt(pivot[at(i)] * pivot[at(i)] + row[at(i)] * row[at(i)]);
        const double cosine = pivot[at(i)] / length, sine = row[at(i)] / length;
        for (int j = i; j <= unknowns; ++j) {
            const double a = pivot[at(j)], b = row[at(j)];
            pivot[at(j)] = cosine * a + sine * b;
            row[at(j)] = cosine * b - sine * a;
        }
        row[at(i)] = 0;
    }
    rest_ += row[unknowns] * row[unknowns];
}

LeastSquares LeastSquares::only(std::uint32_t free) const {
    LeastSquares part;
    part.rest_ = rest_;
    for (const Row& row : triangle_) {
        Unknowns coefficients{};
        for (int i = 0; i < unknowns; ++i) coefficients[at(i)] = has(free, i) ? row[at(i)] : 0.0;
        part.add(coefficients, row[unknowns]);
    }
    return part;
}

bool LeastSquares::is_told(int unknown) const {
    double column = 0;
    for (int i = 0; i <= unknown; ++i) column = std::hypot(column, triangle_[at(i)][at(unknown)]);
    return std::abs(triangle_[at(unknown)][at(unknown)]) > rounding * column;
}

Unknowns LeastSquares::solve(std::uint32_t free) const {
    const LeastSquares part = only(free);
    Unknowns solution{};
    for (int i = unknowns - 1; i >= 0; --i) {
        if (!has(free, i) || !part.is_told(i)) continue;
        const Row& row = part.triangle_[at(i)];
        double rest = row[unknowns];
        for (int j = i + 1; j < unknowns; ++j) rest -= row[at(j)] * solution[at(j)];
        solution[at(i)] = rest / row[at(i)];
    }
    return solution;
}

double LeastSquares::residual(const Unknowns& solution) const {
    double sum = rest_;
    for (const Row& row : triangle_) {
        double rest = row[unknowns];
        for (int i = 0; i < unknowns; ++i) rest -= row[at(i)] * solution[at(i)];
        sum += rest * rest;
    }
    return sum;
}

Unknowns LeastSquares::solve_non_negative() const {
    Unknowns best{};
    double least = residual(best);
    for (std::uint32_t free = all; free > 0; --free) {
        const Unknowns solution = solve(free);
        bool is_in_order = true;
        for (const double value : solution) is_in_order = is_in_order && value >= 0;
        if (!is_in_order) continue;
        const double sum = residual(solution);
        if (!(sum < least)) continue;
        least = sum;
        best = solution;
    }
    return best;
}

// With R the triangle, the rows of its inverse squared and summed.
Unknowns LeastSquares::variances() const {
    Unknowns sums{};
    for (int column = 0; column < unknowns; ++column) {
        Unknowns inverse{};
        for (int i = column; i >= 0; --i) {
            double rest = i == column ? 1.0 : 0.0;
            for (int j = i + 1; j <= column; ++j) rest -= triangle_[at(i)][at(j)] * inverse[at(j)];
            inverse[at(i)] = is_told(i) ? rest / triangle_[at(i)][at(i)] : std::numeric_limits<double>::infinity();
            sums[at(i)] += inverse[at(i)] * inverse[at(i)];
        }
    }
    for (double& sum : sums) {
        if (!std::isfinite(sum)) sum = std::numeric_limits<double>::infinity();
    }
    return sums;
}

}  // namespace sfsm::simulate
