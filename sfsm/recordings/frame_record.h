// What a recorder says of one frame that the application rendered.
#pragma once

#include <cstdint>
#include <limits>

#include "sfsm/trace.h"

namespace sfsm {

inline constexpr double longest_frame_ms = 600'000;  // that a frame or a part of it can take: 10 minutes

struct FrameRecord {
    static constexpr double untold = std::numeric_limits<double>::quiet_NaN();

    // [ms]; NaN: not told, or no time that a frame can take.
    double frame_ms = untold;
    double cpu_ms = untold;  // busy
    double gpu_ms = untold;

    // [ms] between the changes of the display that belong to the frame: up to the one that shows it, or of recorders
    // that say so alone how long it was shown. NaN: not told, or never shown. With the generated frames before it.
    float display_ms = std::numeric_limits<float>::quiet_NaN();

    // [ms] by which the animation went on further than the display did since the frame shown before: over 0 shown too
    // soon, under 0 too late. NaN: not told, never shown.
    float animation_error_ms = std::numeric_limits<float>::quiet_NaN();

    float compilations = std::numeric_limits<float>::quiet_NaN();  // shaders or pipelines compiled; NaN: not told

    enum class Fate : std::uint8_t { untold, shown, dropped } fate = Fate::untold;
};
static_assert(sizeof(FrameRecord) <= 40, "recordings have millions of them");

// What a trace of ours says of a frame.
inline FrameRecord frame_record(const TraceRow& row) {
    return {.frame_ms = row.frame_ms, .cpu_ms = row.cpu_ms, .gpu_ms = row.gpu_ms};
}

}  // namespace sfsm
