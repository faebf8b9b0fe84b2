#include "render/gl/timer.h"

#include <algorithm>
#include <limits>

namespace render::gl {

FrameTimer::FrameTimer(const Device& device) : software_(device.software) {
    if (software_) return;
    for (Slot& slot : ring_) slot.query = Query::create(GL_TIME_ELAPSED);
}

void FrameTimer::begin(std::int64_t frame) {
    frame_ = frame;
    start_ = std::chrono::steady_clock::now();
}

void FrameTimer::submit() {
    if (!software_) glBeginQuery(GL_TIME_ELAPSED, ring_[frame_ % ring_size].query.name());
}

std::optional<FrameTime> FrameTimer::end() {
    using milliseconds = std::chrono::duration<double, std::milli>;
    if (software_) {
        const double cpu_ms = milliseconds(std::chrono::steady_clock::now() - start_).count();
        glFinish();
        const double frame_ms = milliseconds(std::chrono::steady_clock::now() - start_).count();
        return FrameTime{frame_, frame_ms, cpu_ms, std::numeric_limits<double>::quiet_NaN()};
    }
    glEndQuery(GL_TIME_ELAPSED);
    Slot& slot = ring_[frame_ % ring_size];
    slot.frame = frame_;
    slot.cpu_ms = milliseconds(std::chrono::steady_clock::now() - start_).count();
    Slot& oldest = ring_[(frame_ + 1) % ring_size];
    if (oldest.frame < 0) return std::nullopt;
    return read(oldest);
}

std::optional<FrameTime> FrameTimer::drain() {
    Slot* oldest = nullptr;
    for (Slot& slot : ring_)
        if (slot.frame >= 0 && (!oldest || slot.frame < oldest->frame)) oldest = &slot;
    if (!oldest) return std::nullopt;
    return read(*oldest);
}

FrameTime FrameTimer::read(Slot& slot) {
    constexpr double ms_per_ns = 1e-6;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(slot.query.name(), GL_QUERY_RESULT, &nanoseconds);
    const double gpu_ms = ms_per_ns * static_cast<double>(nanoseconds);
    const FrameTime time{slot.frame, std::max(slot.cpu_ms, gpu_ms), slot.cpu_ms, gpu_ms};
    slot.frame = -1;
    return time;
}

}  // namespace render::gl
