// Whether numbers that claim to be random are: by how many standard deviations they miss what chance would give.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tests {

// Standard deviations that chance doesn't reach in the few hundred questions asked here.
inline constexpr double chance = 5.0;

// Of a chi-square value of so many degrees of freedom.
inline double deviations(double chi_square, double freedom) {
    return (chi_square - freedom) / std::sqrt(2.0 * freedom);
}

// By how much `counts` are less even than draws of equal chance would be.
inline double unevenness(const std::vector<std::int64_t>& counts) {
    const double sum = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
    const double expected = sum / static_cast<double>(counts.size());
    double chi_square = 0;
    for (const std::int64_t count : counts) {
        const double miss = static_cast<double>(count) - expected;
        chi_square += miss * miss / expected;
    }
    return deviations(chi_square, static_cast<double>(counts.size()) - 1);
}

// The class of each value, 0 to 3: its quarter of the sorted values. Equal values share a class.
inline std::vector<int> quarters(const std::vector<double>& values) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> result;
    for (const double value : values) {
        int quarter = 0;
        for (std::size_t q = 1; q < 4; ++q) quarter += value > sorted[q * sorted.size() / 4];
        result.push_back(quarter);
    }
    return result;
}

// By how much the quarters that one number and another are in have to do with each other, however crooked the relation.
inline double dependence(const std::vector<int>& in_a, const std::vector<int>& in_b) {
    double table[4][4] = {}, of_a[4] = {}, of_b[4] = {};
    for (std::size_t i = 0; i < in_a.size(); ++i) {
        ++table[in_a[i]][in_b[i]];
        ++of_a[in_a[i]];
        ++of_b[in_b[i]];
    }
    double chi_square = 0;
    int classes_a = 0, classes_b = 0;
    for (int i = 0; i < 4; ++i) {
        classes_a += of_a[i] > 0;
        classes_b += of_b[i] > 0;
        for (int j = 0; j < 4; ++j) {
            const double expected = of_a[i] * of_b[j] / static_cast<double>(in_a.size());
            if (expected > 0) chi_square += (table[i][j] - expected) * (table[i][j] - expected) / expected;
        }
    }
    return deviations(chi_square, std::max(1, (classes_a - 1) * (classes_b - 1)));
}

inline double dependence(const std::vector<double>& a, const std::vector<double>& b) {
    return dependence(quarters(a), quarters(b));
}

inline double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline double deviation(const std::vector<double>& values) {
    const double middle = mean(values);
    double squares = 0;
    for (const double value : values) squares += (value - middle) * (value - middle);
    return std::sqrt(squares / static_cast<double>(values.size()));
}

inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const double mean_a = mean(a), mean_b = mean(b);
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
    return sum / static_cast<double>(a.size()) / (deviation(a) * deviation(b));
}

}  // namespace tests
