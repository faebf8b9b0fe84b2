// Frames that stand out from those before them, and why.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sfsm/recordings/frame_record.h"

namespace sfsm {

// A frame stutters if it takes over 2.5 times the mean of the last frames, it among them, as CapFrameX counts: of the
// last 10 sqrt(mean time of the run in ms) frames with a time (41 frames at 60 frames/s), fewer at the start. The
// first 10 have too few before them to stand out: unlike there they are compared with the mean of the run's first such
// window.
inline constexpr double stutter_factor = 2.5;
std::int64_t stutter_window(double mean_ms);  // [frames], at least 1

// What the log tells of a stutter's cause, the first that holds: it is among the first frames, when a recorder itself
// holds up what it starts on; shaders were compiled in it; the GPU or the CPU was busy for 90 % of it (held_up_by); or
// both are told and neither was.
inline constexpr std::int64_t recorder_frames = 10;
enum class Cause { recorder, compilation, gpu, cpu, waiting, untold };
inline constexpr std::array every_cause = {Cause::recorder, Cause::compilation, Cause::gpu,
                                           Cause::cpu,      Cause::waiting,     Cause::untold};
std::string_view name_of(Cause cause);  // for people: "shader compilation"

struct Stutter {
    std::int64_t frame = 0;  // an index
    double begins_ms = 0;    // after the first frame began: the sum of the times before
    double frame_ms = 0;
    double mean_ms = 0;  // of the window, this frame among them
    Cause cause = Cause::untold;
};

// In order. O(n).
std::vector<Stutter> stutters_of(std::span<const FrameRecord> frames);

}  // namespace sfsm
