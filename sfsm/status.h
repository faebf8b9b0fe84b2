// What a controller says of itself: plain data, for the overlay, the trace, the report and the tests. status_text.h has
// it in words. NaN: not known, not yet, or not so.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "sfsm/decision.h"
#include "sfsm/detail.h"
#include "sfsm/prices.h"

namespace sfsm {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr auto unknown_steps = [] {
    std::array<double, detail_steps> steps{};
    steps.fill(unknown);
    return steps;
}();

// What is believed of the machine and of the frame that was decided last. Laws that learn no prices leave it empty.
struct Beliefs {
    double predicted_ms = unknown;  // of the next frame
    double uncertainty = unknown;   // 1 sigma of that, relative, without the noise of a single frame
    double noise = unknown;         // 1 sigma of a single frame, relative
    double gain = unknown;          // what every price is multiplied by, now

    double due_ms = unknown;    // what can be had for the target: a display's next refresh, or an outside cap
    double aim_ms = unknown;    // what frames are aimed at; over `due_ms` where that is out of reach
    double least_ms = unknown;  // that the coarsest frame is predicted to take

    // Gain included. Without a forecast: of what every frame has, and of the steps of detail below.
    Prices price_ms = equal_prices(unknown);
    Prices price_sigma_ms = equal_prices(unknown);             // 1 sigma of each
    std::array<double, detail_steps> step_ms = unknown_steps;  // of each step of detail, the coarsest first
    std::array<double, detail_steps> step_sigma_ms = unknown_steps;

    // Drawn over foreseen, of each kind of work, and ln of it for the time of all that: forecasts are corrected by it.
    std::array<double, work_kinds> foreseen_factor = equal_prices(unknown).each;
    double foreseen_bias = unknown;

    double floor_ms = unknown;    // frames wait, and don't take less than this
    double refresh_ms = unknown;  // for a display of this period; NaN: for something else, as a cap on the frame rate
    double drift = unknown;       // a load that never rests is followed: it grows by this [ln per frame]
    double ceiling = unknown;     // detail that proved too dear; rises go only half the way to it
};

struct Status : Beliefs {
    Decision decision;
    double target_ms = 0;
    double last_ms = 0;            // the newest usable sample
    std::int64_t bad_samples = 0;  // NaN, infinite, zero or negative times: counted and ignored
    const char* reason = "start";  // why the decision is what it is: static string
    std::int64_t kept_for = 0;     // decisions since that reason was found; 0: it is this one's
    bool is_probe = false;         // to learn from, for a frame or three; after that comes again what is kept
};

}  // namespace sfsm
