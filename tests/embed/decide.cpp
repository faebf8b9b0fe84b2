// A program outside of Grandstand: one law, a hundred frames of a renderer whose costs are round numbers, and every bit
// of what the law decides and believes. Whatever flags it and the law are built with, it says the same.
#include <array>
#include <cstdio>
#include <limits>
#include <memory>

#include "sfsm/controller.h"
#include "sfsm/decision.h"
#include "sfsm/forecast.h"

namespace {

constexpr std::array<sfsm::MotionStep, 3> motion{
    {{std::numeric_limits<double>::infinity(), 20000, 0}, {128, 15000, 0.125}, {32, 6000, 0.5}}};
constexpr std::array<sfsm::SplatStep, 5> splats{{{0, 8'000'000, 0, 0},
                                                 {0.75, 1'000'000, 6'000'000, 0.25},
                                                 {1, 700'000, 3'500'000, 0.5},
                                                 {2, 400'000, 900'000, 1},
                                                 {8, 100'000, 60'000, 4}}};

// The work of the step that a decision is nearest to.
sfsm::Work work_of(const sfsm::Decision& decision) {
    sfsm::Work work{20000, splats[0].triangles, 0, motion[0].updates};
    for (const sfsm::SplatStep& step : splats) {
        if (step.size > decision.splat_size) break;
        work.triangles = step.triangles;
        work.points = step.points;
    }
    for (const sfsm::MotionStep& step : motion)
        if (decision.state != sfsm::State::original && step.distance >= decision.motion_distance)
            work.motion_updates = step.updates;
    return work;
}

// [ms]; sums of eighths, which no compiler can round in another way.
double cost_of(const sfsm::Work& work) {
    const std::int64_t eighths =
        10 + work.people / 2000 + work.triangles / 25000 + work.points / 12500 + work.motion_updates / 2500;
    return static_cast<double>(eighths) / 8;
}

}  // namespace

int main() {
    const std::unique_ptr<sfsm::Controller> law = sfsm::make_controller("predictive");
    const sfsm::Forecast forecast{20000, motion, splats};
    for (std::int64_t frame = 0; frame < 100; ++frame) {
        const sfsm::Decision decision = law->decide({frame < 50 ? 33.0 : 16.0, 200, &forecast});
        const sfsm::Work work = work_of(decision);
        const double ms = frame % 10 == 7 ? std::numeric_limits<double>::quiet_NaN() : cost_of(work);
        law->observe({frame, ms, decision, work});
        const sfsm::Status& status = law->status();
        std::printf("%d D %a S %a predicted %a uncertainty %a gain %a bad %d\n", static_cast<int>(decision.state),
                    decision.motion_distance, decision.splat_size, status.predicted_ms, status.uncertainty, status.gain,
                    static_cast<int>(status.bad_samples));
    }
}
