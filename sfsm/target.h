// The user's target over the frames of a run: "16.6", or "1000,300@30,95@100" (the paper's first experiment).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sfsm {

inline constexpr std::string_view default_target = "16.6";  // 60 frames a second

class TargetSchedule {
public:
    // "MS[,MS@FRAME ...]": times [ms] finite and in (0, 1e6], frames ascending and > 0.
    // Throws std::invalid_argument with one line saying what was found and what was expected.
    static TargetSchedule parse(std::string_view text);

    // The target of each frame, the first one's first; the last one's holds from then on. Throws std::invalid_argument
    // for none at all, and naming the first frame whose time is not finite and in (0, 1e6].
    static TargetSchedule of_frames(std::span<const double> ms);

    double at(std::int64_t frame) const;  // [ms]; cost: the logarithm of how often the target changes
    std::string text() const;             // parses back to the same schedule

private:
    struct Step {
        std::int64_t frame;
        double ms;
    };
    std::vector<Step> steps_;  // by frame
};

}  // namespace sfsm
