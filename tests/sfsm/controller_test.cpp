#include "sfsm/controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sfsm/detail.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

// A renderer whose time is that of its points and moving people; and a program around it, with the habits of such.
struct Machine {
    using Rounding = std::function<double(double)>;

    double target_ms = 16;
    double range = test_range;
    double load = 1;
    int delay = 0;
    std::int64_t first_frame = 0;
    bool is_said = true;  // target and range
    bool has_forecast = false;
    double foreseen = 1;  // share of the points
    Rounding rounding = [](double value) { return value; };

    static constexpr double each_ms = 6e-6, moved_ms = 2e-4;

    Work work(const Decision& decision) const {
        Work work{1000};
        const double reach = range > 0 ? range : unknown_range;
        const double moving = decision.state == State::original ? 1 : std::min(decision.motion_distance / reach, 1.0);
        const double coarse = decision.state == State::points ? std::max(decision.splat_size, 0.5) : 0.5;
        work[WorkKind::motion_update] = std::llround(20'000 * moving);
        work[WorkKind::point] = std::llround(1e6 / coarse);
        return work;
    }

    double ms(std::int64_t frame, const Decision& decision) const {
        const Work drawn = work(decision);
        const double wave = 1 + 0.02 * std::sin(1.3 * static_cast<double>(frame * frame));  // like noise
        return load * wave *
               (3 + each_ms * counted(drawn[WorkKind::point]) + moved_ms * counted(drawn[WorkKind::motion_update]));
    }

    std::vector<Step> motion() const {
        std::vector<Step> steps;
        const double reach = range > 0 ? range : unknown_range;
        for (int i = 0; i <= 8; ++i) {
            const double distance = i == 0 ? std::numeric_limits<double>::infinity() : reach * (1 - i / 9.0);
            steps.push_back({distance, {}, 0.1 * i});
            steps.back().work[WorkKind::motion_update] = work({State::slowed, distance, 0})[WorkKind::motion_update];
        }
        return steps;
    }

    std::vector<Step> shapes() const {
        std::vector<Step> steps{{0, {}, 0}};
        for (int i = 0; i <= 20; ++i) steps.push_back({0.5 * std::exp2(i / 4.0), {}, 0.3 * i});
        for (Step& step : steps) {
            const Decision decision{step.setting > 0 ? State::points : State::original, range, step.setting};
            step.work[WorkKind::point] = std::llround(foreseen * counted(work(decision)[WorkKind::point]));
        }
        return steps;
    }

    std::vector<Decision> run(Controller& law, std::int64_t frames) const {
        const std::vector<Step> moving = motion(), shaped = shapes();
        const Forecast forecast{Work{1000}, moving, shaped};
        std::vector<Decision> decisions;
        for (std::int64_t frame = 0; frame < frames; ++frame) {
            if (frame > delay) {
                const Decision& old = decisions[static_cast<std::size_t>(frame - 1 - delay)];
                const Decision told{old.state, rounding(old.motion_distance), rounding(old.splat_size),
                                    rounding(old.rate)};
                law.observe({first_frame + frame - 1 - delay, ms(frame - 1 - delay, old), told, work(old)});
            }
            decisions.push_back(
                law.decide({is_said ? target_ms : 0, is_said ? range : 0, has_forecast ? &forecast : nullptr}));
        }
        return decisions;
    }

    double mean_ms(Controller& law) const {
        const std::vector<Decision> decisions = run(law, 400);
        double sum = 0;
        for (std::size_t i = 200; i < decisions.size(); ++i) sum += ms(static_cast<std::int64_t>(i), decisions[i]);
        return sum / 200;
    }
};

TEST(Laws, EveryListedNameMakesALaw) {
    ASSERT_FALSE(law_names().empty());
    EXPECT_EQ(law_names().front(), "predictive");
    for (const std::string_view name : law_names()) {
        const auto law = make_controller(name);
        ASSERT_NE(law, nullptr) << name;
        const Decision first = law->decide({16.6, 100});
        EXPECT_TRUE(first == Decision{} || first.state == State::points) << name;
        EXPECT_EQ(law->status().target_ms, 16.6) << name;
    }
}

TEST(Laws, AnUnknownNameIsAnsweredWithTheNamesThereAre) {
    try {
        make_controller("papier");
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("papier"), std::string::npos) << message;
        for (const std::string_view name : law_names()) EXPECT_NE(message.find(name), std::string::npos) << message;
    }
}

TEST(Laws, OptionsReachTheLawAndAreChecked) {
    LawOptions options;
    options.predictive.tail_limit = 1;
    options.predictive.lowest_aim = 0.8;
    options.predictive.headroom = 3;
    options.predictive.most_headroom = 0.1;
    Machine machine;
    const double usual = machine.mean_ms(*make_controller("predictive"));
    EXPECT_LT(machine.mean_ms(*make_controller("predictive", options)), 0.97 * usual);
    options.predictive.band = 7;
    EXPECT_THROW(make_controller("predictive", options), std::invalid_argument);
}

// After another level was loaded a law is as good as new, but for what it was asked for.
TEST(Laws, ALawThatIsResetDecidesLikeANewOne) {
    for (const std::string_view name : law_names()) {
        for (const bool has_forecast : {false, true}) {
            Machine old_level, level;
            old_level.has_forecast = level.has_forecast = has_forecast;
            old_level.load = 3;
            const auto law = make_controller(name);
            old_level.run(*law, 300);
            law->reset();
            EXPECT_EQ(law->status().target_ms, level.target_ms) << name;
            EXPECT_EQ(level.run(*law, 300), level.run(*make_controller(name), 300)) << name << has_forecast;
        }
    }
}

TEST(Laws, AfterAResetTheTargetAndRangeStayInForce) {
    for (const std::string_view name : law_names()) {
        Machine level, unsaid;
        const auto law = make_controller(name), fresh = make_controller(name);
        level.run(*law, 100);
        law->reset();
        unsaid.is_said = false;
        EXPECT_EQ(unsaid.run(*law, 200), level.run(*fresh, 200)) << name;
    }
}

// Times of the level before are still on their way when the next is loaded.
TEST(Laws, TimesOfFramesBeforeAResetAreNotHeard) {
    const auto law = make_controller("predictive"), fresh = make_controller("predictive");
    Machine level;
    level.run(*law, 100);
    const Decision late = law->status().decision;
    law->reset();
    for (std::int64_t frame = 100; frame < 150; ++frame) {
        const Decision decision = law->decide({level.target_ms, test_range});
        ASSERT_EQ(decision, fresh->decide({level.target_ms, test_range})) << frame;
        if (frame < 103) law->observe({frame - 3, 900, late, {}});
        law->observe({frame, level.ms(frame, decision), decision, {}});
        fresh->observe({frame - 100, level.ms(frame, decision), decision, {}});
    }
}

TEST(Laws, FramesMayBeNumberedFromAnyNumber) {
    for (const std::string_view name : law_names()) {
        for (const bool has_forecast : {false, true}) {
            Machine machine;
            machine.has_forecast = has_forecast;
            machine.delay = 2;
            const auto from_0 = machine.run(*make_controller(name), 400);
            for (const std::int64_t first : {std::int64_t{-5}, std::int64_t{1000}, std::int64_t{1} << 60}) {
                machine.first_frame = first;
                EXPECT_EQ(machine.run(*make_controller(name), 400), from_0) << name << " from " << first;
            }
        }
    }
}

// Numbers from 1 on can't be told from those from 0 until decisions change.
TEST(Laws, FramesMayBeNumberedFrom1) {
    Machine machine;
    machine.has_forecast = true;
    machine.foreseen = 0.5;
    machine.delay = 2;
    const double from_0_ms = machine.mean_ms(*make_controller("predictive"));
    machine.first_frame = 1;
    EXPECT_NEAR(machine.mean_ms(*make_controller("predictive")), from_0_ms, 0.01 * machine.target_ms);
}

TEST(Laws, DecisionsMayComeBackRounded) {
    const auto to_float = [](double value) { return static_cast<double>(static_cast<float>(value)); };
    const auto to_text = [](double value) {
        std::ostringstream text;
        text << value;  // six digits
        return std::isfinite(value) ? std::stod(text.str()) : value;
    };
    for (const std::string_view name : law_names()) {
        for (const bool has_forecast : {false, true}) {
            Machine machine;
            machine.has_forecast = has_forecast;
            const auto exact = machine.run(*make_controller(name), 400);
            for (const Machine::Rounding& rounding : {Machine::Rounding(to_float), Machine::Rounding(to_text)}) {
                machine.rounding = rounding;
                const auto rounded = machine.run(*make_controller(name), 400);
                // The paper's law learns the D that it is told.
                if (name != "paper") {
                    EXPECT_EQ(rounded, exact) << name << has_forecast;
                }
                for (std::size_t i = 0; i < exact.size(); ++i)
                    ASSERT_NEAR(detail_of(rounded[i], test_range), detail_of(exact[i], test_range), 0.01)
                        << name << has_forecast << " frame " << i;
            }
        }
    }
}

TEST(Laws, WithoutARangeDistancesAreHundredthsOfIt) {
    for (const std::string_view name : law_names()) {
        Machine machine, rangeless;
        machine.range = unknown_range;
        rangeless.range = 0;
        const auto decisions = rangeless.run(*make_controller(name), 400);
        EXPECT_EQ(decisions, machine.run(*make_controller(name), 400)) << name;
        for (const Decision& decision : decisions) {
            if (decision.state != State::original) {
                ASSERT_LE(decision.motion_distance, unknown_range);
            }
            ASSERT_EQ(detail_of(decision), detail_of(decision, unknown_range));
        }
        EXPECT_LT(detail_of(decisions.back()), 1) << name << " does nothing";
    }
}

TEST(Laws, WithoutARangeAForecastIsEnough) {
    Machine machine;
    machine.has_forecast = true;
    machine.range = 0;
    EXPECT_NEAR(machine.mean_ms(*make_controller("predictive")), machine.target_ms, 0.03 * machine.target_ms);
}

}  // namespace
}  // namespace sfsm
