// Least squares against what defines it: gradients that vanish or point the right way, and nothing near that is better.
#include "sfsm/simulate/least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sfsm::simulate {
namespace {

constexpr double rounding = 1e-10;  // relative, of some dozen equations with coefficients around 1
constexpr std::uint32_t all = (1U << unknowns) - 1;

struct Equation {
    Unknowns coefficients{};
    double value = 0;
};

// Uniform in [0, 1), of any standard library.
double share(std::mt19937& random) {
    return static_cast<double>(random()) / 4294967296.0;
}

std::vector<Equation> random_equations(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::vector<Equation> equations(static_cast<std::size_t>(count));
    for (Equation& equation : equations) {
        for (double& coefficient : equation.coefficients) coefficient = share(random);
        equation.value = 2 * share(random) - 0.7;
    }
    return equations;
}

LeastSquares sum_of(const std::vector<Equation>& equations) {
    LeastSquares sum;
    for (const Equation& equation : equations) sum.add(equation.coefficients, equation.value);
    return sum;
}

double off(const Equation& equation, const Unknowns& at) {
    double rest = equation.value;
    for (std::size_t i = 0; i < at.size(); ++i) rest -= equation.coefficients[i] * at[i];
    return rest;
}

double squares(const std::vector<Equation>& equations, const Unknowns& at) {
    double sum = 0;
    for (const Equation& equation : equations) sum += off(equation, at) * off(equation, at);
    return sum;
}

// Of half the sum of squares.
Unknowns gradient(const std::vector<Equation>& equations, const Unknowns& at) {
    Unknowns sums{};
    for (const Equation& equation : equations) {
        for (std::size_t i = 0; i < at.size(); ++i) sums[i] -= equation.coefficients[i] * off(equation, at);
    }
    return sums;
}

TEST(LeastSquares, ItsGradientVanishes) {
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
        const std::vector<Equation> equations = random_equations(seed, 20);
        const LeastSquares sum = sum_of(equations);
        const Unknowns solution = sum.solve(all);
        for (const double slope : gradient(equations, solution)) EXPECT_NEAR(slope, 0, rounding);
        EXPECT_NEAR(sum.residual(solution), squares(equations, solution), rounding);
    }
}

TEST(LeastSquares, TheRestOfTheUnknownsAreNothing) {
    const std::vector<Equation> equations = random_equations(7, 20);
    const Unknowns solution = sum_of(equations).solve(0b01101);
    EXPECT_EQ(solution[1], 0);
    EXPECT_EQ(solution[4], 0);
    const Unknowns slopes = gradient(equations, solution);
    for (const std::size_t i : {0U, 2U, 3U}) EXPECT_NEAR(slopes[i], 0, rounding);
}

// Karush, Kuhn, Tucker: an unknown over 0 has no slope, and one at 0 has none that leads down above 0.
TEST(LeastSquares, NonNegativeOnesMeetTheirConditions) {
    int held = 0;
    for (std::uint32_t seed = 1; seed <= 300; ++seed) {
        const std::vector<Equation> equations = random_equations(seed, 12);
        const Unknowns solution = sum_of(equations).solve_non_negative();
        const Unknowns slopes = gradient(equations, solution);
        for (std::size_t i = 0; i < solution.size(); ++i) {
            ASSERT_GE(solution[i], 0);
            if (solution[i] > 0) {
                EXPECT_NEAR(slopes[i], 0, rounding) << "seed " << seed;
            } else {
                EXPECT_GE(slopes[i], -rounding) << "seed " << seed;
                ++held;
            }
        }
    }
    EXPECT_GT(held, 100) << "the problems are too easy";
}

TEST(LeastSquares, NoNonNegativePointOfAGridIsBetter) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const std::vector<Equation> equations = random_equations(seed, 12);
        const double least = squares(equations, sum_of(equations).solve_non_negative());
        constexpr int steps = 12;
        Unknowns at{};
        for (int code = 0; code < steps * steps * steps * steps * steps; ++code) {
            int rest = code;
            for (double& value : at) {
                value = 2.0 * (rest % steps) / steps;
                rest /= steps;
            }
            ASSERT_GE(squares(equations, at), least - rounding);
        }
    }
}

TEST(LeastSquares, UnknownsThatCantBeToldApartDontBlowUp) {
    LeastSquares sum;
    for (int i = 0; i < 100; ++i) sum.add({1, 20000, 0, static_cast<double>(i), 3.0 * i}, 2 + i);
    const Unknowns solution = sum.solve(all);
    EXPECT_NEAR(solution[0], 2, 1e-9);
    EXPECT_EQ(solution[1], 0);
    EXPECT_EQ(solution[2], 0);
    EXPECT_NEAR(solution[3], 1, 1e-9);
    EXPECT_EQ(solution[4], 0);
    const Unknowns variances = sum.variances();
    EXPECT_TRUE(std::isinf(variances[2]));
}

TEST(LeastSquares, VariancesAreThoseOfManyDraws) {
    const std::vector<Equation> equations = random_equations(3, 30);
    const Unknowns variances = sum_of(equations).variances();
    std::mt19937 random(1);
    Unknowns mean{}, spread{};
    constexpr int draws = 4000;
    for (int draw = 0; draw < draws; ++draw) {
        std::vector<Equation> noisy = equations;
        // Of variance 1: a sum of twelve uniform numbers.
        for (Equation& equation : noisy) {
            equation.value = -6;
            for (int i = 0; i < 12; ++i) equation.value += share(random);
        }
        const Unknowns solution = sum_of(noisy).solve(all);
        for (std::size_t i = 0; i < solution.size(); ++i) {
            mean[i] += solution[i] / draws;
            spread[i] += solution[i] * solution[i] / draws;
        }
    }
    constexpr double sampling = 0.1;  // four sigma of the variance of that many draws
    for (std::size_t i = 0; i < mean.size(); ++i)
        EXPECT_NEAR((spread[i] - mean[i] * mean[i]) / variances[i], 1, sampling);
}

}  // namespace
}  // namespace sfsm::simulate
