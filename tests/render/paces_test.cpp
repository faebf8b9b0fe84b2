// How often people move at a rate.
#include "render/paces.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using render::Exchange;

constexpr std::size_t role = static_cast<std::size_t>(scene::Role::spectator);
constexpr std::int64_t people = 100;
constexpr double shown = 500;                        // [px]
constexpr float pixels_a_metre = 40, surface = 800;  // [px], [px^2]

// In leaps: between two of them a shorter period costs more, and gains nothing.
render::Staleness in_leaps() {
    render::Staleness off{};  // [m]
    for (std::size_t period = 2; period < off.size(); ++period)
        off[period] = period < 3 ? 0.001f : period < 8 ? 0.02f : period < 16 ? 0.022f : 0.08f;
    return off;
}

TEST(Paces, CostTheLeastAtEveryRate) {
    const figures::Way& way = figures::natively();
    const render::ErrorBounds bounds;
    render::PaceForecaster::Kind kind{{}, &bounds, 1.9, 1};
    kind.staleness[role] = in_leaps();
    render::PaceForecaster forecaster({kind}, way);
    forecaster.begin();
    forecaster.add(0, scene::Role::spectator, people, shown, 20, pixels_a_metre, surface);
    const auto prices = forecaster.finish({});
    const auto error = [&](int period) {
        const double off = static_cast<double>(kind.staleness[role][static_cast<std::size_t>(period)] * pixels_a_metre);
        return period > 1 ? shown * way.error.of_motion(off) : 0;
    };
    std::set<int> chosen;
    for (int step = 0; step < Exchange::steps; ++step) {
        const double rate = Exchange::rate_of(step);
        const auto cost = [&](int period) { return error(period) + rate * people * way.effort.update / period; };
        render::Paces paces;
        forecaster.find(rate, paces);
        const int period = paces.period(0, scene::Role::spectator, pixels_a_metre);
        chosen.insert(period);
        for (const int other : render::paced_periods)
            EXPECT_LE(cost(period), cost(other) * (1 + 1e-6)) << period << ", not " << other << ", rate " << rate;
        const render::PaceForecaster::Price& price = prices[static_cast<std::size_t>(step)];
        EXPECT_NEAR(price.error, error(period), 1e-6 * error(period)) << rate;
        EXPECT_DOUBLE_EQ(price.updates, static_cast<double>(people) / period) << rate;
    }
    EXPECT_GT(chosen.size(), 2u);
}

}  // namespace
