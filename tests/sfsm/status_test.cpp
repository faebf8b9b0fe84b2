// What the default law says of itself, against plants whose prices, displays and loads are known; and all that in
// words.
#include "sfsm/status.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <numbers>

#include "sfsm/detail.h"
#include "sfsm/pair_plans.h"
#include "sfsm/predictive.h"
#include "sfsm/status_text.h"
#include "tests/sfsm/normal.h"
#include "tests/sfsm/rate_scene.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

constexpr double target_ms = 1000.0 / 60;

// A closed loop of which the status before every frame is judged.
template <class Look>
void watch(Controller& law, std::int64_t frames, const Time& time, const Look& look) {
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        const Decision decision = law.decide({target_ms, test_range});
        look(frame, law.status());
        law.observe({frame, time(frame, decision), decision, {}});
    }
}

double whole_ms(const Status& status) {
    double ms = status.price_ms.frame;
    for (const double step : status.step_ms) ms += step;
    return ms;
}

TEST(Status, PricesOfDetailAddUpToWhatFramesTake) {
    PredictiveLaw law;
    std::mt19937_64 random(3);
    const auto cost = [](double detail) { return target_ms * (0.3 + 1.2 * detail); };
    int judged = 0;
    watch(
        law, 400,
        [&](std::int64_t, const Decision& decision) {
            return cost(detail_of(decision, test_range)) * std::exp(0.01 * normal(random));
        },
        [&](std::int64_t frame, const Status& status) {
            if (frame < 100) return;
            ++judged;
            const double detail = detail_of(status.decision, test_range) * detail_steps;
            double ms = status.price_ms.frame;
            for (int i = 0; i < detail_steps; ++i)
                ms += std::clamp(detail - i, 0.0, 1.0) * status.step_ms[static_cast<std::size_t>(i)];
            EXPECT_NEAR(ms, status.predicted_ms, 1e-9);
            EXPECT_NEAR(whole_ms(status), cost(1), 0.25 * cost(1)) << "frames of all detail are never drawn";
            for (std::size_t i = 0; i < status.step_ms.size(); ++i) EXPECT_GT(status.step_sigma_ms[i], 0);
            for (const double ms_of_kind : status.price_ms.each) EXPECT_TRUE(std::isnan(ms_of_kind));
        });
    EXPECT_GT(judged, 0);
}

// Of each kind that was drawn in many amounts: off by three sigmas at most, and far surer than at first.
TEST(Status, PricesAreAsFarOffAsTheirSigmaSays) {
    constexpr double well_known = 0.1;  // of a price; before times it is believed to 80 % and 100 %
    PredictiveLaw law;
    std::mt19937_64 random(7);
    const Prices prices = bowl(1).prices;
    for (std::int64_t frame = 0; frame < 600; ++frame) {
        const RateScene scene = bowl(20'000 + 15'000 * std::sin(0.05 * static_cast<double>(frame)));
        const Decision decision = law.decide({frame % 100 < 50 ? 14.0 : 9.0, test_range, &scene.forecast});
        const Work work = scene.work(decision);
        law.observe({frame, scene.ms(work) * std::exp(0.02 * normal(random)), decision, work});
    }
    const Status& status = law.status();
    for (const WorkKind kind : {WorkKind::point, WorkKind::single}) {
        EXPECT_NEAR(status.price_ms[kind], prices[kind], 3 * status.price_sigma_ms[kind]) << entry_of(kind).name;
        EXPECT_LT(status.price_sigma_ms[kind], well_known * status.price_ms[kind]) << entry_of(kind).name;
    }
    for (const double ms : status.step_ms) EXPECT_TRUE(std::isnan(ms));
}

TEST(Status, AReasonIsKeptAsLongAsItsDecision) {
    PredictiveLaw law;
    Decision before;
    std::int64_t kept = 0, longest = 0;
    watch(
        law, 300,
        [](std::int64_t frame, const Decision& decision) {
            return target_ms * (0.3 + 1.2 * detail_of(decision, test_range)) * (frame < 150 ? 1 : 1.5);
        },
        [&](std::int64_t frame, const Status& status) {
            if (frame == 0) {
                EXPECT_STREQ(status.reason, reason_to_guess);
            } else if (status.kept_for > 0) {
                EXPECT_EQ(status.decision, before) << frame;
                EXPECT_EQ(status.kept_for, kept + 1) << frame;
            }
            kept = status.kept_for;
            longest = std::max(longest, kept);
            before = status.decision;
        });
    EXPECT_GT(longest, 100);
}

// Counts the frames to learn from; what is kept must come back after them.
struct ProbeCount {
    int probes = 0;
    Decision kept;
    bool was_probe = false;

    void look(const Status& status) {
        if (status.is_probe) {
            ++probes;
            EXPECT_NE(status_text(status).find("to learn from"), std::string::npos);
        } else {
            if (was_probe && status.kept_for > 0) {
                EXPECT_EQ(status.decision, kept);
            }
            EXPECT_EQ(std::string_view(status.reason).find("learning"), std::string_view::npos);
            EXPECT_EQ(std::string_view(status.reason).find("in vain"), std::string_view::npos);
            kept = status.decision;
        }
        was_probe = status.is_probe;
    }
};

// What a decision by D and S draws.
Work work_of(const Forecast& forecast, const Decision& decision) {
    const Plan plan = PairPlans(forecast, test_range).at(decision);
    Work work;
    for (std::size_t i = 0; i < work_kinds; ++i) work.counts[i] = std::llround(plan.counts[i]);
    return work;
}

TEST(Status, AFrameToLearnFromIsSaidToBeAlone) {
    const RateScene scene = bowl(20'000);
    const Forecast forecast{scene.forecast.frame, scene.motion, scene.shapes};
    for (const bool has_forecast : {true, false}) {
        PredictiveLaw law;
        ProbeCount count;
        for (std::int64_t frame = 0; frame < 300; ++frame) {
            const Decision decision = law.decide({target_ms, test_range, has_forecast ? &forecast : nullptr});
            count.look(law.status());
            const Work work = has_forecast ? work_of(forecast, decision) : Work{};
            law.observe({frame, has_forecast ? scene.ms(work) : 2 * target_ms, decision, work});
        }
        EXPECT_GT(count.probes, 0) << (has_forecast ? "of prices" : "of a target that was given up");
    }
}

TEST(Status, TellsThatFramesWaitAndForWhat) {
    for (const bool is_display : {true, false}) {
        PredictiveLaw law;
        const double floor_ms = is_display ? target_ms : 1.08 * target_ms;
        const auto wait = [&](std::int64_t, const Decision& decision) {
            const double work = target_ms * (0.2 + 0.5 * detail_of(decision, test_range));
            return is_display ? std::ceil(work / floor_ms) * floor_ms : std::max(work, floor_ms);
        };
        watch(law, 300, wait, [](std::int64_t, const Status&) {});
        const Status& status = law.status();
        EXPECT_NEAR(status.floor_ms, floor_ms, 0.02 * floor_ms);
        const std::string text = status_text(status);
        EXPECT_NE(text.find("waiting: frames wait for "), std::string::npos) << text;
        if (is_display) continue;
        EXPECT_TRUE(std::isnan(status.refresh_ms));
        EXPECT_NEAR(status.due_ms, floor_ms, 0.02 * floor_ms);
        EXPECT_NE(text.find(" can be had"), std::string::npos) << text;
    }
}

TEST(Status, TellsADisplaysPeriod) {
    PredictiveLaw law;
    std::mt19937_64 random(2);
    const auto shown = [&](std::int64_t frame, const Decision& decision) {
        const double load = frame / 40 % 2 == 0 ? 1 : 2.2;
        const double work = target_ms * load * (0.3 + 1.2 * detail_of(decision, test_range));
        return std::ceil(work * std::exp(0.05 * normal(random)) / 8.3) * 8.3;
    };
    bool has_told = false;
    watch(law, 600, shown, [&](std::int64_t, const Status& status) {
        if (!std::isfinite(status.refresh_ms)) return;
        const double refreshes = status.refresh_ms / 8.3;  // two, as long as no time was three
        EXPECT_NEAR(refreshes, std::round(refreshes), 0.01);
        has_told |= status_text(status).find("waiting: frames wait for a display, ") != std::string::npos;
    });
    EXPECT_TRUE(has_told);
}

TEST(Status, TellsThatADriftIsFollowedAndWhichWay) {
    PredictiveLaw law;
    std::mt19937_64 random(5);
    const auto load = [](std::int64_t frame) {
        return 1 + 0.33 * std::sin(2 * std::numbers::pi * static_cast<double>(frame) / 200);
    };
    int followed = 0, right = 0;
    watch(
        law, 1600,
        [&](std::int64_t frame, const Decision& decision) {
            return target_ms * load(frame) * (0.3 + 1.2 * detail_of(decision, test_range)) *
                   std::exp(0.02 * normal(random));
        },
        [&](std::int64_t frame, const Status& status) {
            if (!std::isfinite(status.drift)) return;
            ++followed;
            const bool is_growing = load(frame) > load(frame - 8);
            right += is_growing == (status.drift > 0);
            EXPECT_NE(status_text(status).find(status.drift > 0 ? " % more a frame" : " % less a frame"),
                      std::string::npos);
        });
    EXPECT_GT(followed, 400);
    EXPECT_GT(right, 0.8 * followed);
}

TEST(Status, TellsTheDetailThatProvedTooDear) {
    PredictiveLaw law;
    bool is_told = false;
    watch(
        law, 400,
        [](std::int64_t, const Decision& decision) {
            return target_ms * (0.3 + 1.2 * std::floor(detail_of(decision, test_range) * 8) / 8);
        },
        [&](std::int64_t, const Status& status) {
            if (!std::isfinite(status.ceiling)) return;
            is_told = true;
            EXPECT_GE(status.ceiling, 5.0 / 8) << "less detail fits";
            EXPECT_NE(status_text(status).find("ceiling: detail 0."), std::string::npos);
        });
    EXPECT_TRUE(is_told);
}

TEST(Status, TellsByHowMuchForecastsAreCorrected) {
    PredictiveLaw law;
    const RateScene scene = bowl(20'000);
    std::vector<RateStep> halved = scene.rates;
    for (RateStep& step : halved) step.work[WorkKind::point] /= 2;
    Forecast forecast = scene.forecast;
    forecast.rates = halved;
    for (std::int64_t frame = 0; frame < 60; ++frame) {
        const Decision decision = law.decide({10, test_range, &forecast});
        const Work work = scene.work(decision);
        law.observe({frame, scene.ms(work), decision, work});
    }
    EXPECT_NEAR(law.status().foreseen_factor[index_of(WorkKind::point)], 2, 0.1);
    const std::string text = status_text(law.status());
    EXPECT_NE(text.find("forecasts: point drawn 2"), std::string::npos) << text;
}

TEST(StatusText, SaysAllThatIsKnownAndNothingElse) {
    Status status;
    status.target_ms = 16.6;
    EXPECT_EQ(status_text(status), "decided: state 0 (original)\nwhy: start\ntarget: 16.6 ms asked\n");
    status.decision = {State::points, 24.105199, 2, 1.25e-6};
    status.reason = "has time to spare: finer";
    status.kept_for = 12;
    status.due_ms = 16.6;
    status.aim_ms = 16.4;
    status.least_ms = 5;
    status.predicted_ms = 16.31;
    status.uncertainty = 0.012;
    status.noise = 0.03;
    status.price_ms.frame = 1.25;
    status.price_sigma_ms.frame = 1.5;
    status.price_ms[WorkKind::point] = 5.3e-6;
    status.price_sigma_ms[WorkKind::point] = 5.3e-7;
    status.price_ms[WorkKind::person] = 0;
    status.price_sigma_ms[WorkKind::person] = 2e-3;
    EXPECT_EQ(status_text(status),
              "decided: state 2 (points), D 24.11 m, S 2 px, rate 1.25e-06 px\n"
              "why: has time to spare: finer; kept since, for 12 frames\n"
              "target: 16.6 ms asked, 16.4 ms aimed at\n"
              "predicted: 16.31 ms +- 1.2 %, and a single frame's noise is 3 %; the coarsest frame takes 5 ms\n"
              "prices, learned from times:\n"
              "  what every frame has: 1.25 ms +- 120 %\n"
              "  person: 0 ms +- 2 us\n"
              "  point: 5.3 ns +- 10 %\n");
    status.least_ms = 20;
    EXPECT_NE(status_text(status).find("out of reach, even the coarsest frame takes 20 ms"), std::string::npos);
}

TEST(StatusText, LinesAreShort) {
    static constexpr std::size_t longest = 160;
    PredictiveLaw law;
    watch(
        law, 300,
        [](std::int64_t frame, const Decision& decision) {
            return target_ms * (0.3 + 1.2 * detail_of(decision, test_range)) * (frame < 150 ? 1 : 7.123456789);
        },
        [](std::int64_t, const Status& status) {
            const std::string text = status_text(status);
            ASSERT_TRUE(text.ends_with('\n'));
            for (std::size_t begin = 0; begin < text.size();) {
                const std::size_t end = text.find('\n', begin);
                ASSERT_LE(end - begin, longest) << text;
                begin = end + 1;
            }
        });
}

}  // namespace
}  // namespace sfsm
