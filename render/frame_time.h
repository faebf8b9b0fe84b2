// How long a frame took.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace render {

struct FrameTime {
    std::int64_t frame = 0;
    double frame_ms = 0;  // what holds the target: the slower of the two on a GPU, all of it on a CPU
    double cpu_ms = 0;    // to choose and submit
    double gpu_ms = 0;    // NaN without a GPU
};

class FrameTimer {
public:
    virtual ~FrameTimer() = default;

    // Frames between the end of one and the arrival of its time.
    virtual int delay() const = 0;

    virtual void begin(std::int64_t frame) = 0;
    // From here on commands are submitted: what a GPU waits for before is not its work.
    virtual void submit() = 0;
    // The time of frame - delay(), if there was one.
    virtual std::optional<FrameTime> end() = 0;
    // The times that were still under way, oldest first, until there is none.
    virtual std::optional<FrameTime> drain() = 0;
};

// Of who draws a frame before end() is called: a clock will do.
class FrameClock final : public FrameTimer {
public:
    int delay() const override { return 0; }
    void begin(std::int64_t frame) override;
    void submit() override {}
    std::optional<FrameTime> end() override;
    std::optional<FrameTime> drain() override { return std::nullopt; }

private:
    std::int64_t frame_ = 0;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace render
