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

constexpr double everywhere = std::numeric_limits<double>::infinity();
constexpr std::array<sfsm::Step, 3> motion{{{everywhere, {0, 0, 0, 20000}, 0},  //
                                            {128, {0, 0, 0, 15000}, 0.125},
                                            {32, {0, 0, 0, 6000}, 0.5}}};
constexpr std::array<sfsm::Step, 5> shapes{{{0, {0, 8'000'000, 0, 0}, 0},
                                            {0.75, {0, 1'000'000, 6'000'000, 0}, 0.25},
                                            {1, {0, 700'000, 3'500'000, 0}, 0.5},
                                            {2, {0, 400'000, 900'000, 0}, 1},
                                            {8, {0, 100'000, 60'000, 0}, 4}}};

// The work of the step that a decision is nearest to.
sfsm::Work work_of(const sfsm::Decision& decision) {
    sfsm::Work moved = motion[0].work, drawn = shapes[0].work;
    for (const sfsm::Step& step : shapes)
        if (step.setting <= decision.splat_size) drawn = step.work;
    for (const sfsm::Step& step : motion)
        if (decision.state != sfsm::State::original && step.setting >= decision.motion_distance) moved = step.work;
    sfsm::Work work{20000};
    work += moved;
    work += drawn;
    return work;
}

// [ms]; sums of eighths, which no compiler can round in another way.
double cost_of(const sfsm::Work& work) {
    constexpr std::array<std::int64_t, sfsm::work_kinds> in_an_eighth{2000, 25000, 12500, 2500, 9000, 100000, 4000};
    std::int64_t eighths = 10;
    for (std::size_t kind = 0; kind < work.counts.size(); ++kind) eighths += work.counts[kind] / in_an_eighth[kind];
    return static_cast<double>(eighths) / 8;
}

}  // namespace

int main() {
    const std::unique_ptr<sfsm::Controller> law = sfsm::make_controller("predictive");
    const sfsm::Forecast forecast{sfsm::Work{20000}, motion, shapes};
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
