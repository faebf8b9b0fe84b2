#include "sfsm/recordings/display_times.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sfsm {
namespace {

constexpr double untold = DisplayRow::untold;

// A time that a display can have shown something; else NaN.
double usable_display(double ms) {
    return ms > 0 && ms <= longest_frame_ms ? ms : untold;
}

}  // namespace

void DisplayTimes::add_generated(const DisplayRow& row) {
    const double ms = usable_display(row.display_ms);
    if (std::isnan(ms)) return;
    waiting_ms_ += ms;
    shown_for_ms_ += ms;
}

double DisplayTimes::add(const DisplayRow& row, const FrameRecord& frame, DisplayMeaning meaning) {
    const bool is_shown = frame.fate == FrameRecord::Fate::shown;
    const double own_ms = frame.fate == FrameRecord::Fate::dropped ? untold : usable_display(row.display_ms);
    const double display_ms = own_ms + waiting_ms_;
    if (meaning.computes_errors) {
        const double since_shown_ms = meaning.is_shown_for ? shown_for_ms_ : display_ms;
        const std::array<double, simulation_starts> starts = starts_of(row);
        for (std::size_t i = 0; i < simulation_starts; ++i) {
            clocks_[i].add(starts[i], frame.frame_ms, frames_, is_shown ? std::optional(since_shown_ms) : std::nullopt);
        }
    }
    if (is_shown || !std::isnan(own_ms)) {
        waiting_ms_ = 0;
        shown_for_ms_ = own_ms;
    }
    ++frames_;
    return display_ms;
}

// A step that isn't told parts what was before from what comes.
std::array<double, simulation_starts> DisplayTimes::starts_of(const DisplayRow& row) {
    if (std::isnan(row.step_ms)) {
        clocks_[static_cast<std::size_t>(SimulationStart::simulation_step)].begin_again();
    } else {
        steps_ms_ += row.step_ms;
    }
    const double present_end_ms = std::exchange(present_end_ms_, row.present_ms + row.in_present_ms);
    return {row.animation_ms, steps_ms_, row.cpu_start_ms, present_end_ms};
}

void DisplayTimes::Clock::begin_again() {
    shown_ms = before_ms = untold;
}

// `displays_ms`: since the frame shown before, of a frame that is shown itself.
void DisplayTimes::Clock::add(double start_ms, double frame_ms, std::int64_t frame, std::optional<double> displays_ms) {
    constexpr double most_unlike = 4;
    const double ratio = (start_ms - std::exchange(before_ms, start_ms)) / frame_ms;
    if (!std::isnan(ratio)) {
        ++compared;
        alike += ratio >= 1 / most_unlike && ratio <= most_unlike;
    }
    if (!displays_ms) return;
    const double error_ms = start_ms - std::exchange(shown_ms, start_ms) - *displays_ms;
    if (!(std::abs(error_ms) <= longest_frame_ms)) return;
    errors.resize(static_cast<std::size_t>(frame), FrameRecord().animation_error_ms);
    errors.push_back(static_cast<float>(error_ms));
}

void DisplayTimes::begin_again() {
    for (Clock& clock : clocks_) clock.begin_again();
    waiting_ms_ = 0;
    shown_for_ms_ = present_end_ms_ = untold;
}

std::string computed_note(const std::string& start, const std::string& display) {
    return "animation error is not recorded: computed from " + start + " and " + display;
}

std::optional<SimulationStart> DisplayTimes::finish(std::vector<FrameRecord>& frames) {
    for (std::size_t i = 0; i < simulation_starts; ++i) {
        const Clock& clock = clocks_[i];
        if (clock.errors.empty() || 2 * clock.alike < clock.compared) continue;
        for (std::size_t k = 0; k < clock.errors.size(); ++k) frames[k].animation_error_ms = clock.errors[k];
        clocks_ = {};
        return static_cast<SimulationStart>(i);
    }
    clocks_ = {};
    return std::nullopt;
}

}  // namespace sfsm
