// What frames say of themselves on the roaming path, 20,000 people natively: nobody of it is farther off than is
// promised, and the error is what was expected before it was drawn.
#include <gtest/gtest.h>

#include <numeric>

#include "apps/point_cache.h"
#include "tests/bench/flip.h"
#include "tests/bench/front/references.h"
#include "tests/bench/front/settings.h"
#include "tests/bench/front/venue.h"
#include "tests/bench/front/views.h"
#include "tests/render/drawn_errors.h"

namespace {

using bench::front::Shot;

constexpr std::int64_t people = 20'000;
constexpr bench::front::Size size{1280, 720};  // [px]
constexpr std::array rates = {0.03125, 0.5};   // [px / piece] fine and coarse
constexpr auto native = sfsm::Drawing::native;

bench::front::Venue& venue() {
    static bench::front::Venue venue(people, size, false);
    return venue;
}

std::vector<Shot> moments() {
    std::vector<Shot> moments = bench::front::shots(venue().stage().place.cameras, size.height);
    std::erase_if(moments, [](const Shot& shot) { return shot.is_preset; });
    return moments;
}

sfsm::Decision at_rate(double rate) {
    sfsm::Decision decision;
    decision.rate = rate;
    return decision;
}

TEST(Promise, IsKeptAlongTheRoamingPath) {
    constexpr std::size_t stride = 67;  // one of so many people is looked at
    const apps::Stage& stage = venue().stage();
    bench::Shooter& shooter = venue().shooter(native);
    venue().renderer(native).resize(size.width, size.height);
    double motion_share = 0, splat_share = 0;
    for (const Shot& shot : moments()) {
        const render::View view = shot.view_now(size.width, size.height);
        const render::Frame exact = shooter.choose(view, bench::triangles(), shot.tick);
        const auto numbers = tests::numbers_of(exact, stage.place.crowd, stage.cast, shot.tick);
        for (const double rate : rates) {
            const render::Frame& frame = shooter.select(at_rate(rate), shot.tick);
            const tests::Off off = tests::farthest_off(frame, exact, numbers, stage.place.crowd, stage.poses,
                                                       bench::front::way_of(native), stride);
            EXPECT_LE(off.motion_px, frame.max_motion_px) << shot.name << ", rate " << rate;
            EXPECT_LE(off.splat_px, frame.max_splat_px) << shot.name << ", rate " << rate;
            if (frame.max_motion_px > 0) motion_share = std::max(motion_share, off.motion_px / frame.max_motion_px);
            if (frame.max_splat_px > 0) splat_share = std::max(splat_share, off.splat_px / frame.max_splat_px);
        }
    }
    EXPECT_GT(motion_share, 0.05) << "it says nothing";
    EXPECT_GT(splat_share, 0.05) << "it says nothing";
}

TEST(Promise, OfAnErrorIsWhatIsMeasuredAlongTheRoamingPath) {
    constexpr double tolerance = 0.3;  // the worst is 28.4 % off (docs/measurements/loss.md)
    const std::filesystem::path cache = apps::default_cache();
    ASSERT_FALSE(cache.empty()) << "references are kept in the user's cache";
    bench::front::References references(cache / "references");
    for (const Shot& shot : moments()) {
        const bench::FlipReference reference(references.of(venue(), shot).now);
        for (const double rate : rates) {
            bench::Shooter& shooter = venue().shooter(native);
            const render::View view = shot.view_now(size.width, size.height);
            const double expected = shooter.shoot(view, at_rate(rate), shot.tick).expected_flip;
            const std::vector<float> errors = reference.errors(venue().renderer(native).read_image());
            const double measured =
                std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
            EXPECT_NEAR(expected, measured, tolerance * measured) << shot.name << ", rate " << rate;
        }
    }
}

}  // namespace
