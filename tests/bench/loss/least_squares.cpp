#include "tests/bench/loss/least_squares.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace bench::loss {

namespace {

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

double squares(const Vector& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

// Of a symmetric positive matrix; by Gauss without pivots.
Vector solved(Matrix matrix, Vector right) {
    const std::size_t size = right.size();
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t row = i + 1; row < size; ++row) {
            const double times = matrix[row][i] / matrix[i][i];
            for (std::size_t column = i; column < size; ++column) matrix[row][column] -= times * matrix[i][column];
            right[row] -= times * right[i];
        }
    for (std::size_t i = size; i-- > 0;) {
        for (std::size_t column = i + 1; column < size; ++column) right[i] -= matrix[i][column] * right[column];
        right[i] /= matrix[i][i];
    }
    return right;
}

Vector exponentials(const Vector& logarithms) {
    Vector out;
    for (const double one : logarithms) out.push_back(std::exp(one));
    return out;
}

}  // namespace

Vector least_squares(Vector start, const std::function<Vector(std::span<const double>)>& residuals) {
    constexpr int steps = 300;
    constexpr double small = 1e-5, weakest = 1e-9, strongest = 1e9;
    Vector at;
    for (const double one : start) at.push_back(std::log(one));
    Vector here = residuals(exponentials(at));
    double damping = 1e-2;
    for (int step = 0; step < steps && damping < strongest; ++step) {
        Matrix slopes;
        for (std::size_t i = 0; i < at.size(); ++i) {
            Vector moved = at;
            moved[i] += small;
            slopes.push_back(residuals(exponentials(moved)));
            for (std::size_t k = 0; k < here.size(); ++k) slopes[i][k] = (slopes[i][k] - here[k]) / small;
        }
        Matrix normal(at.size(), Vector(at.size()));
        Vector down(at.size());
        for (std::size_t i = 0; i < at.size(); ++i) {
            for (std::size_t k = 0; k < at.size(); ++k)
                normal[i][k] = std::inner_product(slopes[i].begin(), slopes[i].end(), slopes[k].begin(), 0.0);
            normal[i][i] += damping * normal[i][i] + weakest;
            down[i] = -std::inner_product(slopes[i].begin(), slopes[i].end(), here.begin(), 0.0);
        }
        const Vector move = solved(std::move(normal), std::move(down));
        Vector next = at;
        for (std::size_t i = 0; i < at.size(); ++i) next[i] += move[i];
        const Vector there = residuals(exponentials(next));
        const bool is_better = squares(there) < squares(here);  // not: of what isn't finite
        damping = is_better ? std::max(damping / 3, weakest) : damping * 4;
        if (is_better) at = next, here = there;
    }
    return exponentials(at);
}

}  // namespace bench::loss
