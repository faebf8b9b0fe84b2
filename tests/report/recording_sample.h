// Recordings as recorders leave them, and their reports.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sfsm/report/report.h"

namespace tests {

using sfsm::FrameRecord;

constexpr std::size_t sample_frames = 3000;

// Of 100 frames/s, with all that a recorder can tell: 7 stutters, one of each cause but two by shaders; every 97th
// frame dropped; the CPU is busy for most of a frame at the end, before that the GPU; one frame without a time.
inline std::vector<FrameRecord> sample_recording() {
    std::vector<FrameRecord> frames(sample_frames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        FrameRecord& frame = frames[i];
        const auto at = static_cast<double>(i);
        frame.frame_ms = 10 + std::sin(0.01 * at) + 0.3 * std::sin(1.7 * at);
        const bool is_late = i >= 2500;
        frame.gpu_ms = frame.frame_ms * (is_late ? 0.6 : 0.95);
        frame.cpu_ms = frame.frame_ms * (is_late ? 0.97 : 0.5);
        frame.display_ms = static_cast<float>(frame.frame_ms + 0.2 * std::sin(2.1 * at));
        frame.animation_error_ms = static_cast<float>(0.2 * std::sin(2.1 * at));
        frame.compilations = 0;
        frame.fate = FrameRecord::Fate::shown;
        if (i % 97 != 96) continue;
        frame.fate = FrameRecord::Fate::dropped;
        frame.display_ms = frame.animation_error_ms = std::nanf("");
    }
    // Of CPU and GPU the shares of the frame's time.
    const auto stutter = [&](std::size_t i, double ms, double cpu, double gpu, float compilations) {
        frames[i].frame_ms = ms;
        frames[i].cpu_ms = cpu * ms;
        frames[i].gpu_ms = gpu * ms;
        frames[i].compilations = compilations;
    };
    stutter(4, 61, 0.5, 0.4, 0);
    stutter(700, 84.321, 0.95, 0.1, 4);
    stutter(705, 75.5, 0.95, 0.1, 2);
    stutter(1200, 66.25, 0.3, 0.97, 0);
    stutter(1800, 55.125, 0.96, 0.3, 0);
    stutter(2200, 45.5, 0.3, 0.4, 0);
    stutter(2350, 44.5, FrameRecord::untold, FrameRecord::untold, 0);
    frames[2700] = {};
    return frames;
}

// The same with frame times alone, of a game that is a tenth faster.
inline std::vector<FrameRecord> bare_recording() {
    std::vector<FrameRecord> frames;
    for (const FrameRecord& frame : sample_recording()) {
        frames.emplace_back();
        frames.back().frame_ms = frame.frame_ms / 1.1;
    }
    return frames;
}

// `frames` must live as long as what is returned.
inline sfsm::ReportedRecording reported(std::string name, const std::vector<FrameRecord>& frames) {
    return {std::move(name),
            {{"game", "Night Drive"}},
            {"1 row has no time"},
            frames,
            sfsm::figures_of(frames, 0, sfsm::usual_limits_ms),
            sfsm::stutters_of(frames)};
}

// A million frames, all series told; one peak in each that is thinned.
inline std::vector<FrameRecord> million_frames(std::size_t peak) {
    std::vector<FrameRecord> frames(1'000'000);
    std::uint64_t state = 1;
    const auto noise = [&state] {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state >> 40) / static_cast<double>(1 << 24) - 0.5;
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        FrameRecord& frame = frames[i];
        frame.frame_ms = 7 + 2 * std::sin(1e-4 * static_cast<double>(i)) + noise();
        if (i % 5003 == 0) frame.frame_ms *= 5;
        frame.cpu_ms = 0.6 * frame.frame_ms;
        frame.gpu_ms = 0.93 * frame.frame_ms;
        frame.display_ms = static_cast<float>(frame.frame_ms);
        frame.animation_error_ms = static_cast<float>(noise());
        frame.compilations = 0;
        frame.fate = FrameRecord::Fate::shown;
    }
    frames[peak].display_ms = 777.25F;
    frames[peak].animation_error_ms = -333.5F;
    frames[peak].gpu_ms = 555.75;
    return frames;
}

}  // namespace tests
