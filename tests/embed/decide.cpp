// A program outside of Grandstand: every law over renderers whose costs are round numbers, with and without a forecast,
// and every bit of what it decides and believes. Whatever flags it and the laws are built with, it says the same.
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <string_view>

#include "sfsm/controller.h"
#include "sfsm/decision.h"
#include "sfsm/detail.h"
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
constexpr sfsm::State points = sfsm::State::points;
constexpr std::array<sfsm::RateStep, 5> rates{
    {{0.001, sfsm::State::original, everywhere, 0, {0, 8'000'000, 0, 20000, 0, 0, 20000}, 0},
     {0.01, points, 150, 0.75, {0, 1'000'000, 6'000'000, 16000, 0, 0, 20000}, 0.01},
     {0.1, points, 100, 1, {0, 500'000, 3'000'000, 12000, 0, 0, 20000}, 0.03},
     {1, points, 50, 2, {0, 0, 1'500'000, 8000, 0, 0, 20000}, 0.06},
     {10, points, 25, 8, {0, 0, 50'000, 5000, 0, 0, 20000}, 0.2}}};

// The work of the step that a decision is nearest to.
sfsm::Work work_of(const sfsm::Decision& decision) {
    sfsm::Work work{20000};
    sfsm::Work moved = motion[0].work, drawn = shapes[0].work, all = rates[0].work;
    for (const sfsm::RateStep& step : rates)
        if (step.rate <= decision.rate) all = step.work;
    for (const sfsm::Step& step : shapes)
        if (step.setting <= decision.splat_size) drawn = step.work;
    for (const sfsm::Step& step : motion)
        if (decision.state != sfsm::State::original && step.setting >= decision.motion_distance) moved = step.work;
    if (decision.rate == 0) all = (moved += drawn);
    return work += all;
}

// What the machine has to do besides, and how busy it is; whole numbers, as is the noise. [128ths of the cost]
std::int64_t load_in(std::int64_t frame) {
    const std::int64_t noise = frame * 7919 % 13 - 6;
    const std::int64_t swing = frame % 200 < 100 ? frame % 100 : 100 - frame % 100;
    return 128 + noise + (frame < 300 ? 0 : swing) + (frame % 250 > 150 ? 96 : 0);
}

// [ms]; whole 1024ths, which no compiler can round in another way.
double cost_of(const sfsm::Work& work, std::int64_t load) {
    constexpr std::array<std::int64_t, sfsm::work_kinds> in_an_eighth{2000, 25000, 12500, 2500, 9000, 100000, 4000};
    std::int64_t eighths = 10;
    for (std::size_t kind = 0; kind < work.counts.size(); ++kind) eighths += work.counts[kind] / in_an_eighth[kind];
    return static_cast<double>(eighths * load) / 1024;
}

void run(std::string_view name, const sfsm::Forecast* forecast) {
    constexpr std::int64_t frames = 700;
    const std::unique_ptr<sfsm::Controller> law = sfsm::make_controller(name);
    std::printf("%.*s\n", static_cast<int>(name.size()), name.data());
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        const sfsm::Decision decision = law->decide({frame % 500 < 250 ? 33.0 : 16.0, 200, forecast});
        const sfsm::Work work = work_of(decision);
        const double ms = frame % 10 == 7 ? std::numeric_limits<double>::quiet_NaN() : cost_of(work, load_in(frame));
        law->observe({frame, ms, decision, work});
        const sfsm::Status& status = law->status();
        std::printf("%d D %a S %a rate %a predicted %a uncertainty %a gain %a bad %d\n",
                    static_cast<int>(decision.state), decision.motion_distance, decision.splat_size, decision.rate,
                    status.predicted_ms, status.uncertainty, status.gain, static_cast<int>(status.bad_samples));
    }
}

// An engine of one knob, which knows nothing but times: no range, no work, no forecast.
void run_one_knob() {
    const std::unique_ptr<sfsm::Controller> law = sfsm::make_controller("predictive");
    for (std::int64_t frame = 1000; frame < 1100; ++frame) {
        if (frame == 1050) law->reset();
        const sfsm::Decision decision = law->decide({.target_ms = 16.5});
        const double detail = sfsm::detail_of(decision);
        const double ms = static_cast<double>(256 + static_cast<int>(detail * 1024)) / 32;
        law->observe({frame, ms, decision, {}});
        std::printf("detail %a\n", detail);
    }
}

}  // namespace

int main() {
    const sfsm::Forecast by_pairs{sfsm::Work{20000}, motion, shapes};
    const sfsm::Forecast by_rates{sfsm::Work{20000}, motion, shapes, rates};
    for (const sfsm::Forecast* forecast : {&by_pairs, &by_rates}) run("predictive", forecast);
    for (const std::string_view name : sfsm::law_names()) run(name, nullptr);
    run_one_knob();
}
