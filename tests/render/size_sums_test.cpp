// Sums of people between two sizes, held against people who are added up one bin after another.
#include "render/size_sums.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "sfsm/random.h"

namespace {

using render::SizeBin;
using render::SizeBorders;
using render::SizedRow;
using render::SizeParts;
using render::SizeSums;

constexpr std::size_t rows = 5, bins = 20;
constexpr float first_edge = 40;

double number(std::size_t i, std::uint64_t seed) {
    return 1 + 100 * static_cast<double>(sfsm::lower_unit(sfsm::hash(i, seed)));
}

// Rows of other borders each, some of which lie beyond their bins.
struct Example {
    std::vector<SizeBin> people;
    std::vector<SizeSums> weights, below;
    std::vector<SizeBorders> borders{{0, 40, 41.5f, 70},
                                     {43.25f, 43.25f, 59.875f, 60},
                                     {44.5f, 47, 47, 47.125f},
                                     {-300, -200, -100, 0},
                                     {90, 90, 90, 100}};

    Example() : weights(bins), below(rows * (bins + 1) + 1) {
        for (std::size_t i = 0; i < bins; ++i) {
            people.push_back({number(i, 1), number(i, 2), number(i, 3)});
            for (std::size_t sum = 0; sum < SizeSums::count; ++sum)
                weights[i].sums[sum] = static_cast<float>(number(i * SizeSums::count + sum, 4));
        }
    }
    SizeParts parts() {
        std::vector<SizedRow> sized;
        for (std::size_t row = 0; row < rows; ++row) {
            SizeSums* sums = &below[row * (bins + 1)];
            render::sum_up(people, weights.data(), sums);
            sized.push_back({sums, sums + bins, first_edge, bins, static_cast<std::uint32_t>(row)});
        }
        return render::divide(sized, borders.data());
    }
    // Of all rows, people whose sizes are between two borders, each of which is one of a row's.
    template <typename Low, typename High>
    double between(std::size_t sum, const Low& low, const High& high) const {
        double total = 0;
        for (const SizeBorders& row : borders)
            for (std::size_t i = 0; i < bins; ++i) {
                const auto share_below = [&](double border) {
                    return std::clamp(border - static_cast<double>(first_edge) - static_cast<double>(i), 0.0, 1.0);
                };
                const bool by_surface = sum == SizeSums::surface;
                const bool by_people = sum == SizeSums::people || sum == SizeSums::triangles ||
                                       sum == SizeSums::few_points || sum == SizeSums::most_points;
                const double amount = by_surface ? people[i].surface : by_people ? people[i].people : people[i].shown;
                total += (share_below(high(row)) - share_below(low(row))) * amount * weights[i][sum];
            }
        return total;
    }
};

TEST(SizeSums, PeopleBetweenBordersAreInOnePart) {
    constexpr double rounding = 1e-5;  // of sums in single precision
    Example example;
    const SizeParts parts = example.parts();
    const auto none = [](const SizeBorders&) { return -1e3; };
    const auto every = [](const SizeBorders&) { return 1e3; };
    const auto splats_to = [](const SizeBorders& row) { return static_cast<double>(row.splats_to); };
    const auto few_to = [](const SizeBorders& row) { return static_cast<double>(row.few_to); };
    const auto most_from = [](const SizeBorders& row) { return static_cast<double>(row.most_from); };
    const auto meshes_from = [](const SizeBorders& row) { return static_cast<double>(row.meshes_from); };
    for (std::size_t sum = 0; sum < SizeSums::count; ++sum) {
        const double near = rounding * example.between(sum, none, every);
        EXPECT_NEAR(parts.splats[sum], example.between(sum, none, splats_to), near) << sum;
        EXPECT_NEAR(parts.few[sum], example.between(sum, splats_to, few_to), near) << sum;
        EXPECT_NEAR(parts.spaced[sum], example.between(sum, few_to, most_from), near) << sum;
        EXPECT_NEAR(parts.most[sum], example.between(sum, most_from, meshes_from), near) << sum;
        EXPECT_NEAR(parts.meshes[sum], example.between(sum, meshes_from, every), near) << sum;
    }
}

TEST(SizeSums, AreTheSameOnEveryInstructionSet) {
    std::optional<SizeParts> first;
    for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest & -rest);
        const SizeParts parts = Example().parts();
        hwy::SetSupportedTargetsForTest(0);
        if (first)
            EXPECT_EQ(std::memcmp(&*first, &parts, sizeof parts), 0) << hwy::TargetName(rest & -rest);
        else
            first = parts;
    }
}

}  // namespace
