#include "sfsm/simulate/endurance.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sfsm/replay.h"

namespace sfsm::simulate {
namespace {

struct Sums {
    std::int64_t frames = 0, over = 0;
    double detail = 0, best = 0;
};

Stretch stretch_of(const Sums& sums, std::int64_t end, const Controller& law) {
    return {end, law.status().gain, static_cast<double>(sums.over) / static_cast<double>(sums.frames),
            sums.best > 0 ? sums.detail / sums.best : 0};
}

}  // namespace

std::vector<Stretch> endure(const Course& course, Controller& law, std::uint64_t seed, std::int64_t frames,
                            int stretches) {
    const Scenario& scenario = course.scenario;
    const Plant& plant = *scenario.plant;
    std::array<FrameSample, max_delay + 1> under_way;  // by frame
    const auto slot_of = [&](std::int64_t frame) -> FrameSample& {
        return under_way[static_cast<std::size_t>(frame % std::ssize(under_way))];
    };
    const std::int64_t length = std::max<std::int64_t>(1, (frames + stretches - 1) / stretches);
    std::vector<Stretch> run;
    Sums sums;
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        const std::int64_t lap = frame % scenario.frames;
        const double target_ms = scenario.target.at(lap);
        const std::int64_t arrived = frame - 1 - scenario.delay;
        if (arrived >= 0) law.observe(slot_of(arrived));
        const Decision decision = law.decide({target_ms, plant.range(lap), plant.forecast(lap)});
        const double ms = measured_ms(scenario, seed, frame, plant.cost_ms(lap, decision));
        slot_of(frame) = {frame, ms, decision, plant.work(lap, decision)};
        ++sums.frames;
        sums.over += ms > 1.05 * target_ms ? 1 : 0;
        sums.detail += plant.detail(lap, decision);
        sums.best += course.best[static_cast<std::size_t>(lap)].detail;
        if (sums.frames < length && frame + 1 < frames) continue;
        run.push_back(stretch_of(sums, frame + 1, law));
        sums = {};
    }
    return run;
}

}  // namespace sfsm::simulate
