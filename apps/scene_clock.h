// The scene's time in integer ticks: one a frame, or as many as the wall clock has seen.
#pragma once

#include <chrono>
#include <cstdint>

#include "motion/schedule.h"

namespace apps {

class SceneClock {
public:
    // fixed_step: one tick a frame, however long the frames take; a run then depends on its arguments alone.
    explicit SceneClock(bool fixed_step) : fixed_step_(fixed_step) {}

    // On to the next frame; returns the seconds since the last one, which go on while the scene is paused.
    double advance() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds =
            fixed_step_ ? 1.0 / motion::ticks_per_second : std::chrono::duration<double>(now - last_frame_).count();
        last_frame_ = now;
        if (paused) return seconds;
        due_ += fixed_step_ ? 1.0 : seconds * motion::ticks_per_second;
        const auto ticks = static_cast<std::int64_t>(due_);
        due_ -= static_cast<double>(ticks);  // a part of a tick waits for the next frame
        tick_ += ticks;
        return seconds;
    }

    std::int64_t tick() const { return tick_; }
    double seconds() const { return static_cast<double>(tick_) / motion::ticks_per_second; }

    bool paused = false;

private:
    bool fixed_step_;
    std::int64_t tick_ = 0;
    double due_ = 0;  // [ticks]
    std::chrono::steady_clock::time_point last_frame_ = std::chrono::steady_clock::now();
};

}  // namespace apps
