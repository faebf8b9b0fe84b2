// The user's target over the frames of a run: "16.6", or "1000,300@30,95@100" (the paper's first experiment).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sfsm {

class TargetSchedule {
public:
    // "MS[,MS@FRAME ...]": times [ms] finite and in (0, 1e6], frames ascending and > 0.
    // Throws std::invalid_argument with one line saying what was found and what was expected.
    static TargetSchedule parse(std::string_view text);

    double at(std::int64_t frame) const;  // [ms]
    std::string text() const;             // parses back to the same schedule

private:
    struct Step {
        std::int64_t frame;
        double ms;
    };
    std::vector<Step> steps_;
};

}  // namespace sfsm
