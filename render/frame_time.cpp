#include "render/frame_time.h"

#include <limits>

namespace render {

void FrameClock::begin(std::int64_t frame) {
    frame_ = frame;
    start_ = std::chrono::steady_clock::now();
}

std::optional<FrameTime> FrameClock::end() {
    using milliseconds = std::chrono::duration<double, std::milli>;
    const double ms = milliseconds(std::chrono::steady_clock::now() - start_).count();
    return FrameTime{frame_, ms, ms, std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace render
