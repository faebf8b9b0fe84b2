// What frames are expected to lose, against what they lose.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <numeric>

#include "tests/bench/loss/measure.h"
#include "tests/bench/loss/model.h"

namespace {

namespace fs = std::filesystem;
using bench::loss::Picture;
using bench::loss::Sum;
using bench::loss::What;

constexpr std::int64_t people = 20'000;
constexpr bench::front::Size size{640, 360};

class Prediction : public testing::TestWithParam<const char*> {
protected:
    Prediction() : references_(folder_) {}
    ~Prediction() override { fs::remove_all(folder_); }

    static bench::front::Venue& venue() {
        static bench::front::Venue venue(people, size, false);
        return venue;
    }
    bench::front::Shot shot() const {
        for (const auto& one : bench::front::shots(venue().stage().place.cameras, size.height))
            if (one.name == GetParam()) return one;
        throw std::logic_error("no such view");
    }

    const fs::path folder_ = fs::temp_directory_path() / ("loss_test." + std::to_string(::getpid()));
    bench::front::References references_;
};

INSTANTIATE_TEST_SUITE_P(Views, Prediction, testing::Values("close", "roam-11s"),
                         [](const auto& view) { return std::string(view.param).substr(0, 4); });

TEST_P(Prediction, IsNearWhatIsMeasuredAtRates) {
    constexpr double tolerance = 0.37;  // docs/measurements/loss.md: of these views it is among the farthest off
    const bench::front::Sight sight(venue(), shot(), references_);
    const bench::FlipReference reference(sight.judge().reference().now);
    auto& shooter = venue().shooter(sfsm::Drawing::native);
    for (const double rate : {0.002, 0.02, 0.2}) {
        const sfsm::Decision decision{.state = sfsm::State::points, .rate = rate};
        const render::Frame& frame = shooter.shoot(shot().view_now(size.width, size.height), decision, shot().tick);
        const std::vector<float> flip = reference.errors(venue().renderer(sfsm::Drawing::native).read_image());
        const double measured = std::accumulate(flip.begin(), flip.end(), 0.0) / static_cast<double>(flip.size());
        EXPECT_NEAR(frame.expected_flip, measured, tolerance * measured) << rate;
    }
}

// The measured classes are the whole picture, and what is expected of them is what the selector expects.
TEST_P(Prediction, OfClassesIsThatOfTheFrame) {
    constexpr double tolerance = 0.025;  // classes are octaves of height and quarters of one of spacing
    const bench::front::Sight sight(venue(), shot(), references_);
    const bench::loss::Subject subject(sight, sfsm::Drawing::native);
    std::vector<Picture> pictures = subject.by_recipes();
    pictures.push_back(bench::loss::of_nobody(sight));
    const bench::loss::Measured measured(pictures, sfsm::Drawing::native);
    auto& shooter = venue().shooter(sfsm::Drawing::native);
    shooter.survey(shot().view_now(size.width, size.height), shot().tick);
    int rates = 0;
    for (const auto& one : measured.all()) {
        double pixels = 0, flip = 0;
        for (const Sum& sum : one.picture->sums)
            if (sum.what != What::frame) pixels += sum.pixels, flip += sum.flip;
        const Sum frame = one.picture->of(What::frame);
        EXPECT_NEAR(pixels, frame.pixels, 300) << one.picture->recipe;  // small classes are left out
        EXPECT_NEAR(flip, frame.flip, 0.01 * frame.flip) << one.picture->recipe;
        if (!one.picture->recipe.starts_with("rate ")) continue;
        ++rates;
        const sfsm::Decision decision{.state = sfsm::State::points, .rate = std::stod(one.picture->recipe.substr(5))};
        const double selector = shooter.select(decision, shot().tick).expected_flip;
        EXPECT_NEAR(expected(one, figures::natively().error, {}), selector, tolerance * selector)
            << one.picture->recipe;
    }
    EXPECT_GT(rates, 5);
}

}  // namespace
