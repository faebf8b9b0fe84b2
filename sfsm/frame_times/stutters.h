// Frames that stand out from those around them, and why.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sfsm/recordings/frame_record.h"

namespace sfsm {

// A frame stutters if it takes over 2.5 times the mean of the frames around it, as CapFrameX counts.
inline constexpr double stutter_factor = 2.5;
inline constexpr double stutter_window_ms = 500;

// What the log tells of a stutter's cause, the first that holds: it is among the first frames, when a recorder itself
// holds up what it starts on; shaders were compiled in it; the GPU or the CPU was busy for 90 % of it; or both are told
// and neither was.
enum class Cause { recorder, compilation, gpu, cpu, waiting, untold };
std::string_view name_of(Cause cause);  // for people: "shader compilation"

struct Stutter {
    std::int64_t frame = 0;  // an index
    double begins_ms = 0;    // after the first frame began: the sum of the times before
    double frame_ms = 0;
    double mean_ms = 0;  // of the frames around it
    Cause cause = Cause::untold;
};

// In order. O(n).
std::vector<Stutter> stutters_of(std::span<const FrameRecord> frames);

}  // namespace sfsm
