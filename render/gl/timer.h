// How long a frame took. On a GPU a ring of timer queries, read a fixed number of frames late and so without a stall;
// on a software rasteriser, whose queries measure nothing, a clock and a finish.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "render/gl/device.h"
#include "render/gl/objects.h"

namespace render::gl {

struct FrameTime {
    std::int64_t frame = 0;
    double frame_ms = 0;  // what holds the target: the slower of the two on a GPU, all of it on a CPU
    double cpu_ms = 0;    // to choose and submit
    double gpu_ms = 0;    // NaN on a software device
};

class FrameTimer {
public:
    explicit FrameTimer(const Device& device);

    // Frames between the end of one and the arrival of its time: 0 with a clock, ring_size - 1 with queries.
    int delay() const { return software_ ? 0 : ring_size - 1; }

    void begin(std::int64_t frame);
    // From here on commands are submitted: what the GPU waits for before is not its work.
    void submit();
    // The time of frame - delay(), if there was one.
    std::optional<FrameTime> end();
    // The times that were still under way, oldest first, until there is none.
    std::optional<FrameTime> drain();

private:
    static constexpr int ring_size = 3;
    struct Slot {
        Query query;
        std::int64_t frame = -1;  // -1 = empty
        double cpu_ms = 0;
    };
    FrameTime read(Slot& slot);

    bool software_;
    std::chrono::steady_clock::time_point start_;
    std::int64_t frame_ = 0;
    std::array<Slot, ring_size> ring_;
};

}  // namespace render::gl
