// How long a frame took. On a GPU a ring of timer queries, read a fixed number of frames late and so without a stall;
// on a software rasteriser, whose queries measure nothing, a clock and a finish.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "render/frame_time.h"
#include "render/gl/device.h"
#include "render/gl/objects.h"

namespace render::gl {

class FrameTimer final : public render::FrameTimer {
public:
    explicit FrameTimer(const Device& device);

    // 0 with a clock, ring_size - 1 with queries.
    int delay() const override { return software_ ? 0 : ring_size - 1; }

    void begin(std::int64_t frame) override;
    void submit() override;
    std::optional<FrameTime> end() override;
    std::optional<FrameTime> drain() override;

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
