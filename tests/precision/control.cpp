#include "tests/precision/control.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sfsm/controller.h"
#include "sfsm/random.h"

namespace precision {

namespace {

constexpr double everywhere = std::numeric_limits<double>::infinity();
constexpr std::array<sfsm::Step, 3> motion_steps{{{everywhere, {0, 0, 0, 20000}, 0},  //
                                                  {128, {0, 0, 0, 15000}, 0.125},
                                                  {32, {0, 0, 0, 6000}, 0.5}}};
constexpr std::array<sfsm::Step, 5> shape_steps{{{0, {0, 8'000'000, 0, 0}, 0},
                                                 {0.75, {0, 1'000'000, 6'000'000, 0}, 0.25},
                                                 {1, {0, 700'000, 3'500'000, 0}, 0.5},
                                                 {2, {0, 400'000, 900'000, 0}, 1},
                                                 {8, {0, 100'000, 60'000, 0}, 4}}};

sfsm::Work times(const sfsm::Work& work, std::int64_t factor) {
    sfsm::Work all;
    for (std::size_t kind = 0; kind < sfsm::work_kinds; ++kind) {
        const auto one = static_cast<sfsm::WorkKind>(kind);
        all[one] = factor * work[one];
    }
    return all;
}

// A renderer whose costs are proportional to its work, but for a few percent of noise.
class Renderer {
public:
    explicit Renderer(const Loop& loop) : loop_(loop) {
        for (std::size_t i = 0; i < motion_.size(); ++i) motion_[i].work = times(motion_[i].work, loop.elements);
        for (std::size_t i = 0; i < shapes_.size(); ++i) shapes_[i].work = times(shapes_[i].work, loop.elements);
    }

    sfsm::Forecast forecast() const {
        sfsm::Forecast forecast;
        forecast.frame = times({20000}, loop_.elements);
        forecast.motion = motion_;
        forecast.shapes = shapes_;
        return forecast;
    }

    // Of the step that a decision is at or behind. `noise`: of times, from end to end.
    sfsm::FrameSample draw(const sfsm::Decision& decision, std::int64_t frame, double noise) const {
        sfsm::Work work = times({20000}, loop_.elements);
        const sfsm::Step *moved = &motion_[0], *drawn = &shapes_[0];
        for (const sfsm::Step& step : shapes_)
            if (step.setting <= decision.splat_size) drawn = &step;
        for (const sfsm::Step& step : motion_)
            if (decision.state != sfsm::State::original && step.setting >= decision.motion_distance) moved = &step;
        work += moved->work;
        work += drawn->work;
        constexpr std::array<double, sfsm::work_kinds> nanoseconds{100, 9, 18, 60, 20, 2, 50};
        double ms = 1;
        for (std::size_t kind = 0; kind < sfsm::work_kinds; ++kind)
            ms += 1e-6 * nanoseconds[kind] * static_cast<double>(work[static_cast<sfsm::WorkKind>(kind)]) /
                  static_cast<double>(loop_.elements);
        const double chance = double(sfsm::upper_unit(sfsm::hash(1, static_cast<std::uint64_t>(frame)))) - 0.5;
        return {frame, loop_.milliseconds * ms * (1 + noise * chance), decision, work};
    }

private:
    Loop loop_;
    std::array<sfsm::Step, 3> motion_ = motion_steps;
    std::array<sfsm::Step, 5> shapes_ = shape_steps;
};

// S of each frame. Targets change now and then. What a law believes before it has seen times is of real machines, so
// the first frames are drawn in one way whatever it says.
std::vector<double> sizes(const Loop& loop, int frames) {
    constexpr std::int64_t first_frames = 8;
    constexpr double noise = 0.04;
    const Renderer renderer(loop);
    const auto law = sfsm::make_controller(sfsm::law_names().front());
    std::vector<double> chosen;
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        constexpr std::array targets{60.0, 40.0, 25.0, 16.0};  // [ms]
        const double target = loop.milliseconds * targets[static_cast<std::size_t>(frame / 80) % targets.size()];
        const sfsm::Forecast forecast = renderer.forecast();
        sfsm::Decision decision = law->decide({target, 200, &forecast});
        if (frame < first_frames) decision = {};
        chosen.push_back(decision.splat_size);
        law->observe(renderer.draw(decision, frame, noise));
    }
    return chosen;
}

}  // namespace

Errors errors_of_control(const Loop& loop) {
    constexpr int frames = 640;
    const std::vector<double> plain = sizes({}, frames), other = sizes(loop, frames);
    Errors errors;
    for (std::size_t i = 0; i < plain.size(); ++i) errors.add(std::abs(plain[i] - other[i]));
    return errors;
}

double drift_of_control(std::int64_t frames) {
    constexpr std::int64_t settled = 2000;
    const Renderer renderer({});
    const auto law = sfsm::make_controller(sfsm::law_names().front());
    double size = 0, changed = 0;
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        const sfsm::Forecast forecast = renderer.forecast();
        const sfsm::Decision decision = law->decide({25, 200, &forecast});
        if (frame == settled) size = decision.splat_size;
        if (frame > settled) changed = std::max(changed, std::abs(decision.splat_size - size));
        law->observe(renderer.draw(decision, frame, 0));
    }
    return changed;
}

}  // namespace precision
