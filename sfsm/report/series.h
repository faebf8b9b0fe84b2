// One number of each frame, as charts and pages take them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "sfsm/report/report.h"

namespace sfsm::report {

template <class Value>
std::vector<float> series_of(std::span<const FrameRecord> frames, Value FrameRecord::*field) {
    std::vector<float> values;
    values.reserve(frames.size());
    for (const FrameRecord& frame : frames) values.push_back(static_cast<float>(frame.*field));
    return values;
}

// D only where it means something, else NaN.
inline std::vector<float> series_of(std::span<const ReportFrame> frames, float ReportFrame::*field) {
    std::vector<float> values;
    values.reserve(frames.size());
    for (const ReportFrame& frame : frames) {
        const bool means_nothing = field == &ReportFrame::motion_distance && frame.state == State::original;
        values.push_back(means_nothing ? std::numeric_limits<float>::quiet_NaN() : frame.*field);
    }
    return values;
}

// Whether any is known.
inline bool is_told(std::span<const float> values) {
    return std::any_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

}  // namespace sfsm::report
