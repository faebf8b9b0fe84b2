// Prices learned from traces: the right ones, whatever hitches; and a defined answer where rows can't tell.
#include "sfsm/simulate/cost_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "sfsm/simulate/noise.h"

namespace sfsm::simulate {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr Prices true_prices{2.5, {0, 1.5e-6, 4e-6, 6e-4, 0, 0, 2e-4}};

// A run through all three states in which everything changes by itself.
std::vector<TraceRow> run_of(int frames, const Prices& prices) {
    std::mt19937 random(5);
    const auto upto = [&](double most) {
        return static_cast<std::int64_t>(most * static_cast<double>(random()) / 4294967296.0);
    };
    std::vector<TraceRow> rows(static_cast<std::size_t>(frames));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        TraceRow& row = rows[i];
        row.frame = static_cast<std::int64_t>(i);
        row.target_ms = 16;
        row.range = 200;
        row.work[WorkKind::single] = 5000 + upto(15000);
        row.work[WorkKind::motion_update] = upto(static_cast<double>(row.work[WorkKind::single]));
        (i % 3 == 2 ? row.work[WorkKind::point] : row.work[WorkKind::triangle]) = 100'000 + upto(5e6);
        row.frame_ms = cost_of(row.work, prices);
    }
    return rows;
}

void add_noise(std::vector<TraceRow>& rows, double sigma, double hitches) {
    for (TraceRow& row : rows) {
        row.frame_ms *= std::exp(sigma * normal_at(1, row.frame, Stream::noise));
        if (uniform_at(1, row.frame, Stream::spike) < hitches) row.frame_ms *= 40;
    }
}

void expect_prices(const Prices& found, const Prices& expected, double relative) {
    EXPECT_NEAR(found.frame, expected.frame, relative * expected.frame);
    EXPECT_NEAR(found[WorkKind::single], expected[WorkKind::single], relative * expected[WorkKind::single]);
    EXPECT_NEAR(found[WorkKind::triangle], expected[WorkKind::triangle], relative * expected[WorkKind::triangle]);
    EXPECT_NEAR(found[WorkKind::point], expected[WorkKind::point], relative * expected[WorkKind::point]);
    EXPECT_NEAR(found[WorkKind::motion_update], expected[WorkKind::motion_update],
                relative * expected[WorkKind::motion_update]);
}

double model_ms(const CostFit& fit, const TraceRow& row) {
    return cost_of(row.work, fit.prices);
}

TEST(CostFit, RecoversThePricesOfTimesWithoutNoise) {
    const std::vector<TraceRow> rows = run_of(200, true_prices);
    const CostFit fit = fit_costs(rows);
    expect_prices(fit.prices, true_prices, 1e-9);
    EXPECT_EQ(fit.frames, 200);
    EXPECT_NEAR(fit.r2, 1, 1e-12);
    for (const double off : fit.residual) EXPECT_NEAR(off, 0, 1e-9);
}

// With 201 frames every percentile is a frame's own residual.
TEST(CostFit, PercentilesAreOfResidualsRelativeToTheModel) {
    std::vector<TraceRow> rows = run_of(201, true_prices);
    add_noise(rows, 0.05, 0);
    const CostFit fit = fit_costs(rows);
    std::vector<double> residuals;
    for (const TraceRow& row : rows) residuals.push_back(row.frame_ms / cost_of(row.work, fit.prices) - 1);
    std::sort(residuals.begin(), residuals.end());
    for (std::size_t i = 0; i < fit.percents.size(); ++i)
        EXPECT_NEAR(fit.residual[i], residuals[static_cast<std::size_t>(2 * fit.percents[i])], 1e-9) << i;
}

TEST(CostFit, RecoversFreeWorkAsFree) {
    Prices prices = true_prices;
    prices[WorkKind::motion_update] = 0;
    const CostFit fit = fit_costs(run_of(200, prices));
    EXPECT_NEAR(fit.prices[WorkKind::motion_update], 0, 1e-12);
    EXPECT_NEAR(fit.prices[WorkKind::triangle], prices[WorkKind::triangle], 1e-9 * prices[WorkKind::triangle]);
}

TEST(CostFit, HitchesBendNothingWhereTheRestIsExact) {
    std::vector<TraceRow> rows = run_of(200, true_prices);
    add_noise(rows, 0, 0.05);
    expect_prices(fit_costs(rows).prices, true_prices, 1e-9);
}

TEST(CostFit, RecoversThePricesWithinTheirSigmasFromNoiseAndHitches) {
    std::vector<TraceRow> rows = run_of(1000, true_prices);
    add_noise(rows, 0.03, 0.01);
    const CostFit fit = fit_costs(rows);
    // The sharpest price is that of triangles; each is stated with its own error.
    expect_prices(fit.prices, true_prices, 0.05);
    constexpr double sigmas = 3.5;
    EXPECT_NEAR(fit.prices.frame, true_prices.frame, sigmas * fit.sigma.frame);
    EXPECT_NEAR(fit.prices[WorkKind::single], true_prices[WorkKind::single], sigmas * fit.sigma[WorkKind::single]);
    EXPECT_NEAR(fit.prices[WorkKind::triangle], true_prices[WorkKind::triangle],
                sigmas * fit.sigma[WorkKind::triangle]);
    EXPECT_NEAR(fit.prices[WorkKind::point], true_prices[WorkKind::point], sigmas * fit.sigma[WorkKind::point]);
    EXPECT_NEAR(fit.prices[WorkKind::motion_update], true_prices[WorkKind::motion_update],
                sigmas * fit.sigma[WorkKind::motion_update]);
    EXPECT_LT(fit.sigma[WorkKind::triangle], 0.01 * true_prices[WorkKind::triangle]);
    // Percentiles of normal noise of 3 %.
    EXPECT_NEAR(fit.residual[1], -0.049, 0.006);
    EXPECT_NEAR(fit.residual[3], 0, 0.003);
    EXPECT_NEAR(fit.residual[5], 0.051, 0.008);
}

// What defines a robust fit: clipped relative residuals balance along every price, so that none would gain by moving.
TEST(CostFit, ClippedResidualsBalanceAlongEveryPrice) {
    std::vector<TraceRow> rows = run_of(1000, true_prices);
    add_noise(rows, 0.03, 0.01);
    const CostFit fit = fit_costs(rows);
    std::vector<double> sizes;
    for (const TraceRow& row : rows) sizes.push_back(std::abs(row.frame_ms / model_ms(fit, row) - 1));
    std::nth_element(sizes.begin(), sizes.begin() + 500, sizes.end());
    const double sigma = 1.4826 * sizes[500], clip = 1.345 * sigma;
    const auto counts = [](const Work& work) {
        std::vector<double> all{1};
        for (const std::int64_t count : work.counts) all.push_back(static_cast<double>(count));
        return all;
    };
    for (std::size_t kind = 0; kind < 1 + work_kinds; ++kind) {
        double slope = 0, squares = 0;
        for (const TraceRow& row : rows) {
            const double model = model_ms(fit, row), share = counts(row.work)[kind] / model;
            slope += share * std::clamp(row.frame_ms / model - 1, -clip, clip);
            squares += share * share;
        }
        if (squares == 0) continue;  // no row has any of the kind
        // In sigmas of what noise alone does to this sum; the belief pulls by a few hundredths.
        EXPECT_LT(std::abs(slope) / (sigma * std::sqrt(squares)), 0.05) << kind;
    }
}

TEST(CostFit, NoPriceIsNegative) {
    // The more is updated, the faster: nothing a price can be.
    std::vector<TraceRow> rows = run_of(300, true_prices);
    Prices prices = true_prices;
    prices[WorkKind::motion_update] = 0;
    for (TraceRow& row : rows) {
        const double all_ms = cost_of(row.work, prices);
        row.frame_ms = all_ms * (1 - 0.2 * static_cast<double>(row.work[WorkKind::motion_update]) / 20000);
    }
    const CostFit fit = fit_costs(rows);
    EXPECT_EQ(fit.prices[WorkKind::motion_update], 0);
    for (const double price :
         {fit.prices.frame, fit.prices[WorkKind::single], fit.prices[WorkKind::triangle], fit.prices[WorkKind::point]})
        EXPECT_GE(price, 0);
}

TEST(CostFit, SharesTheTimeOfAConstantCrowdBetweenItAndTheFrame) {
    std::vector<TraceRow> rows = run_of(200, true_prices);
    for (TraceRow& row : rows) {
        row.work[WorkKind::single] = 20000;
        row.frame_ms = cost_of(row.work, true_prices);
    }
    const CostFit fit = fit_costs(rows);
    EXPECT_GT(fit.prices.frame, 0);
    EXPECT_GT(fit.prices[WorkKind::single], 0);
    EXPECT_NEAR(fit.prices.frame + 20000 * fit.prices[WorkKind::single],
                true_prices.frame + 20000 * true_prices[WorkKind::single], 1e-8);
    EXPECT_NEAR(fit.prices[WorkKind::point], true_prices[WorkKind::point], 1e-9 * true_prices[WorkKind::point]);
    EXPECT_NEAR(fit.r2, 1, 1e-12);
}

// By llvmpipe a point costs two triangles, natively a sixth of one.
TEST(CostFit, GuessesAreThoseOfWhatTheRowsWereDrawnBy) {
    std::vector<TraceRow> rows = run_of(600, true_prices);
    std::erase_if(rows, [](const TraceRow& row) { return row.work[WorkKind::triangle] > 0; });
    add_noise(rows, 0.02, 0);
    const CostFit gl = fit_costs(rows), native = fit_costs(rows, Drawing::native);
    for (const CostFit* fit : {&gl, &native})
        EXPECT_NEAR(fit->prices[WorkKind::point], true_prices[WorkKind::point], 0.05 * true_prices[WorkKind::point]);
    EXPECT_LT(gl.prices[WorkKind::triangle], gl.prices[WorkKind::point]);
    EXPECT_GT(native.prices[WorkKind::triangle], 2 * native.prices[WorkKind::point]);
}

TEST(CostFit, RecoversThePricesOfStructureAndBackground) {
    Prices prices = true_prices;
    prices[WorkKind::structure_triangle] = 3e-5;
    prices[WorkKind::pixel] = 1.5e-6;
    std::vector<TraceRow> rows = run_of(300, prices);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].work[WorkKind::structure_triangle] = 20'000 + 300 * static_cast<std::int64_t>(i * i % 311);
        rows[i].work[WorkKind::pixel] = i % 5 == 0 ? 0 : 921'600;  // the camera stood still
        rows[i].frame_ms = cost_of(rows[i].work, prices);
    }
    const CostFit fit = fit_costs(rows, Drawing::native);
    expect_prices(fit.prices, prices, 1e-8);
    for (const WorkKind kind : {WorkKind::structure_triangle, WorkKind::pixel})
        EXPECT_NEAR(fit.prices[kind], prices[kind], 1e-8 * prices[kind]) << entry_of(kind).name;
}

TEST(CostFit, GuessesThePriceOfTrianglesNeverDrawnFromThatOfPoints) {
    std::vector<TraceRow> rows = run_of(600, true_prices);
    std::erase_if(rows, [](const TraceRow& row) { return row.work[WorkKind::triangle] > 0; });
    add_noise(rows, 0.02, 0);
    const CostFit fit = fit_costs(rows);
    EXPECT_NEAR(fit.prices[WorkKind::point], true_prices[WorkKind::point], 0.05 * true_prices[WorkKind::point]);
    EXPECT_GT(fit.prices[WorkKind::triangle], 0.25 * fit.prices[WorkKind::point]);
    EXPECT_LT(fit.prices[WorkKind::triangle], 1.0 * fit.prices[WorkKind::point]);
    EXPECT_GT(fit.sigma[WorkKind::triangle], 0.5 * fit.prices[WorkKind::triangle]) << "it says that this is a guess";
}

TEST(CostFit, ARunInWhichNothingChangesIsSharedByBelief) {
    std::vector<TraceRow> rows = run_of(100, true_prices);
    for (TraceRow& row : rows) {
        row.work = rows.front().work;
        row.frame_ms = 40;
    }
    const CostFit fit = fit_costs(rows);
    EXPECT_NEAR(model_ms(fit, rows.front()), 40, 1e-6);
    EXPECT_GT(fit.prices[WorkKind::triangle], 0);
    EXPECT_GT(fit.prices[WorkKind::motion_update], fit.prices[WorkKind::triangle]);
    EXPECT_EQ(fit.r2, 0) << "there is nothing to explain";
}

TEST(CostFit, SkipsRowsWithoutATimeAndTimesAThousandfoldOff) {
    std::vector<TraceRow> rows = run_of(200, true_prices);
    const double infinity = std::numeric_limits<double>::infinity();
    const double no_times[] = {none, infinity, -infinity, 0, -3, 1e30, 5e-324, 1e8, 1e-5};
    std::size_t at = 3;
    for (const double ms : no_times) rows[at += 11].frame_ms = ms;
    const CostFit fit = fit_costs(rows);
    EXPECT_EQ(fit.frames, 200 - std::ssize(no_times));
    expect_prices(fit.prices, true_prices, 1e-9);
}

TEST(CostFit, AsksForSixteenFramesAndForWork) {
    std::vector<TraceRow> rows = run_of(16, true_prices);
    EXPECT_NO_THROW(fit_costs(rows));
    rows[4].frame_ms = none;
    EXPECT_THROW(fit_costs(rows), std::runtime_error);
    EXPECT_THROW(fit_costs({}), std::runtime_error);
    std::vector<TraceRow> idle = run_of(100, true_prices);
    for (TraceRow& row : idle) row.work = {};
    EXPECT_THROW(fit_costs(idle), std::runtime_error);
}

TEST(CostFit, HugeCountsGiveFinitePrices) {
    std::vector<TraceRow> rows = run_of(100, true_prices);
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    rows[10].work = {most, most, most, most};
    rows[20].work[WorkKind::motion_update] = std::numeric_limits<std::int64_t>::min();
    const CostFit fit = fit_costs(rows);
    for (const double price : {fit.prices.frame, fit.prices[WorkKind::single], fit.prices[WorkKind::triangle],
                               fit.prices[WorkKind::point], fit.prices[WorkKind::motion_update], fit.r2}) {
        EXPECT_TRUE(std::isfinite(price));
    }
}

TEST(CostFit, TheSameRowsGiveTheSameBits) {
    std::vector<TraceRow> rows = run_of(300, true_prices);
    add_noise(rows, 0.03, 0.01);
    const CostFit a = fit_costs(rows), b = fit_costs(rows);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.prices.frame), std::bit_cast<std::uint64_t>(b.prices.frame));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.prices[WorkKind::motion_update]),
              std::bit_cast<std::uint64_t>(b.prices[WorkKind::motion_update]));
    EXPECT_EQ(a.residual, b.residual);
}

}  // namespace
}  // namespace sfsm::simulate
