#include "tests/bench/front/marks.h"

#include <cmath>
#include <cstdio>

#include "tests/bench/times.h"

namespace bench::front {

namespace {

std::string three_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

// Of whatever was chosen: the family that would have been asked for it.
Setting native_setting(const sfsm::Decision& decision) {
    Setting setting{.family = "native triangles", .name = "4 samples", .state = decision.state};
    if (decision.rate > 0) {
        setting.family = "native rates";
        setting.name = rate_name(decision.rate);
        return setting;
    }
    if (decision.state == sfsm::State::original) return setting;
    const bool has_points = decision.state == sfsm::State::points, slows = std::isfinite(decision.motion_distance);
    setting.family = !has_points ? "native motion" : slows ? "native mixture" : "native points";
    setting.name = slows ? "D = " + three_digits(decision.motion_distance) + " m" : "";
    if (slows && has_points) setting.name += ", ";
    if (has_points) setting.name += "S = " + three_digits(decision.splat_size);
    return setting;
}

}  // namespace

Measured mark(const Sight& sight, std::string_view law, double target_ms, const sfsm::Decision& decision,
              Effort effort) {
    Measured measured = measure(sight, native_setting(decision), effort, decision);
    measured.row.law = law;
    measured.row.target_ms = target_ms;
    return measured;
}

Loop::Loop(const Sight& sight, std::string_view law)
    : sight_(sight),
      law_(law),
      controller_(
          sfsm::make_controller(law == law_by_knobs ? sfsm::law_names().front() : law, {sfsm::Drawing::native})) {}

sfsm::Decision Loop::settle(double target_ms, Patience patience) {
    const Size size = sight_.venue().size();
    sight_.venue().renderer(sfsm::Drawing::native).resize(size.width, size.height);
    double spent = 0;
    for (int frames = 0; frames < patience.most_frames && spent < patience.most_ms; ++frames) {
        if (frames >= patience.fewest_frames && spent >= patience.enough_ms) break;
        const double rate = decision_.rate;
        spent += draw(target_ms);
        if (frames == 0 || decision_.rate == rate) kept_ = decision_;
    }
    return kept_;
}

double Loop::draw(double target_ms) {
    constexpr double nudge = 0.001;  // [m]
    const Size size = sight_.venue().size();
    Shooter& shooter = sight_.venue().shooter(sfsm::Drawing::native);
    scene::CameraPose pose = sight_.shot().now;
    pose.position.y += nudge * static_cast<double>(frame_ % 2);
    const std::int64_t tick = sight_.shot().tick + frame_;
    const render::Frame* drawn = nullptr;
    Times times;
    times.take([&] {
        const render::Survey& survey = shooter.survey(render::make_view(pose, size.width, size.height), tick);
        sfsm::Forecast forecast = survey.forecast;
        if (law_ == law_by_knobs) forecast.rates = {};
        decision_ = controller_->decide({target_ms, static_cast<double>(survey.range), &forecast});
        drawn = &shooter.select(decision_, tick);
        shooter.draw(*drawn);
    });
    const double ms = times.wall.front();
    controller_->observe({frame_++, ms, decision_, drawn->work});
    return ms;
}

Measured Loop::mark(double target_ms, Patience patience, Effort effort) {
    return front::mark(sight_, law_, target_ms, settle(target_ms, patience), effort);
}

}  // namespace bench::front
