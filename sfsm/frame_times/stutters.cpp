#include "sfsm/frame_times/stutters.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sfsm/frame_times/figures.h"

namespace sfsm {
namespace {

// The mean of the last values. Only additions of few values, so that a long frame leaves no error behind as it leaves
// the window: a window is the end of one block and the beginning of the next (van Herk 1992).
class TrailingMean {
public:
    explicit TrailingMean(std::size_t window) : block_(window), rest_(window) {}

    double add(double value) {
        const std::size_t place = count_ % block_.size();
        begun_ = place == 0 ? value : begun_ + value;
        block_[place] = value;
        ++count_;
        const double sum = begun_ + rest_[place];
        if (place + 1 == block_.size()) end_block();
        return sum / static_cast<double>(std::min(count_, block_.size()));
    }

private:
    void end_block() {
        double sum = 0;
        for (std::size_t i = block_.size(); i-- > 0; sum += block_[i]) rest_[i] = sum;
    }

    std::vector<double> block_;
    std::vector<double> rest_;  // of the block before: the sum of what stands behind a place
    double begun_ = 0;          // sum of this block so far
    std::size_t count_ = 0;
};

struct Sum {
    double ms = 0;
    std::int64_t frames = 0;

    double mean() const { return ms / static_cast<double>(frames); }
};

// Of the first frames with a time, at most `most`.
Sum first_times(std::span<const FrameRecord> frames, std::int64_t most) {
    Sum sum;
    for (std::size_t i = 0; i < frames.size() && sum.frames < most; ++i) {
        if (!is_timed(frames[i])) continue;
        sum.ms += frames[i].frame_ms;
        ++sum.frames;
    }
    return sum;
}

Cause cause_of(const FrameRecord& frame, std::int64_t index) {
    if (index < recorder_frames) return Cause::recorder;
    if (frame.compilations > 0) return Cause::compilation;
    switch (held_up_by(frame)) {
        case HeldUpBy::gpu:
            return Cause::gpu;
        case HeldUpBy::cpu:
            return Cause::cpu;
        case HeldUpBy::neither:
            return Cause::waiting;
        case HeldUpBy::untold:
            break;
    }
    return Cause::untold;
}

}  // namespace

std::int64_t stutter_window(double mean_ms) {
    constexpr double most = 1e9;  // more frames than any run has
    return static_cast<std::int64_t>(std::clamp(std::nearbyint(10 * std::sqrt(mean_ms)), 1.0, most));
}

std::string_view name_of(Cause cause) {
    switch (cause) {
        case Cause::recorder:
            return "start of the recorder";
        case Cause::compilation:
            return "shader compilation";
        case Cause::gpu:
            return "GPU";
        case Cause::cpu:
            return "CPU";
        case Cause::waiting:
            return "waiting";
        case Cause::untold:
            break;
    }
    return "not told";
}

std::vector<Stutter> stutters_of(std::span<const FrameRecord> frames) {
    const Sum all = first_times(frames, std::ssize(frames));
    std::vector<Stutter> stutters;
    if (all.frames == 0) return stutters;
    const std::int64_t window = std::min(stutter_window(all.mean()), all.frames);
    const double first_mean_ms = first_times(frames, window).mean();
    TrailingMean mean(static_cast<std::size_t>(window));
    double begins_ms = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (!is_timed(frames[i])) continue;
        const std::int64_t index = static_cast<std::int64_t>(i);
        const double frame_ms = frames[i].frame_ms, last_mean_ms = mean.add(frame_ms);
        const double mean_ms = index < recorder_frames ? first_mean_ms : last_mean_ms;
        if (frame_ms > stutter_factor * mean_ms)
            stutters.push_back({index, begins_ms, frame_ms, mean_ms, cause_of(frames[i], index)});
        begins_ms += frame_ms;
    }
    return stutters;
}

}  // namespace sfsm
