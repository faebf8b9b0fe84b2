// A report that has a bit of everything.
#pragma once

#include <cmath>
#include <limits>

#include "sfsm/report/report.h"

namespace tests {

// All that could break out of a title, an attribute, a script or XML.
inline const std::string hostile =
    "</title></script><script>alert('1')</script>\"'><img src=x onerror=alert(2)>&amp;\\]]>-->\n\x01\xFF{{data}}";

// 400 frames that fall from 60 ms to 33, with a spike of 1.4 s, one frame that was not measured and one of infinite D;
// of a law that predicts, the later ones are by rate.
inline sfsm::ReportRun sample_run(const std::string& name, float share, bool predicts) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    sfsm::ReportRun run{name, {}, {}};
    for (int i = 0; i < 400; ++i) {
        sfsm::ReportFrame frame;
        frame.target_ms = i < 200 ? 60.0F : 33.0F;
        frame.frame_ms = frame.target_ms * share * (1 + 0.05F * static_cast<float>(std::sin(0.7 * i)));
        if (predicts) frame.predicted_ms = frame.target_ms * share;
        frame.state = static_cast<sfsm::State>(i < 20 ? 0 : i < 120 ? 1 : 2);
        frame.motion_distance = 200 - 0.25F * static_cast<float>(i) * share;
        frame.splat_size = frame.state == sfsm::State::points ? 2 + 0.01F * static_cast<float>(i) : 0;
        if (predicts && i >= 120) frame.rate = 1e-9F * static_cast<float>(1 + i / 100);
        run.frames.push_back(frame);
    }
    run.frames[150].frame_ms = 1400;
    run.frames[170].frame_ms = std::numeric_limits<float>::quiet_NaN();
    run.frames[30].motion_distance = infinity;
    run.scores = sfsm::time_scores(run.frames);
    return run;
}

inline sfsm::Report sample_report() {
    return {"Two laws " + hostile,
            {{"device", "llvmpipe"}, {hostile, "https://example.org/" + hostile}},
            {sample_run("safeguarded", 0.94F, false), sample_run("predictive" + hostile, 1.01F, true)}};
}

}  // namespace tests
