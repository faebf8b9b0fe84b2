// A frame-time controller: past samples in, the next decision out. No clock, no I/O, no allocation after construction;
// the same calls give the same decisions to the bit.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "sfsm/decision.h"
#include "sfsm/drawing.h"
#include "sfsm/forecast.h"
#include "sfsm/prices.h"

namespace sfsm {

// All that a controller believes; read by the overlay, the trace, the report and the tests. NaN: not known, or not yet.
struct Status {
    Decision decision;
    double target_ms = 0;
    double last_ms = 0;            // the newest usable sample
    std::int64_t bad_samples = 0;  // NaN, infinite, zero or negative times: counted and ignored
    const char* reason = "start";  // why the decision is what it is: static string

    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    double predicted_ms = unknown;            // of the next frame
    double uncertainty = unknown;             // 1 sigma of that, relative, without the noise of a single frame
    double noise = unknown;                   // 1 sigma of a single frame, relative
    double gain = unknown;                    // what every price is multiplied by, now
    Prices price_ms = equal_prices(unknown);  // gain included
};

// What is known of a frame before it is drawn.
struct FrameRequest {
    double target_ms = 0;                // > 0
    double range = 0;                    // L [m] > 0: people are visible up to this view depth
    const Forecast* forecast = nullptr;  // nullptr: the renderer can't say
};

class Controller {
public:
    virtual ~Controller() = default;

    // A time has arrived; in frame order, possibly frames late.
    virtual void observe(const FrameSample& sample) = 0;

    // The decision for the next frame. A target or range that is not finite and over 0 is ignored: the last usable one
    // holds.
    virtual Decision decide(const FrameRequest& request) = 0;

    virtual const Status& status() const = 0;
};

// The laws there are, in the order they are listed to a user.
std::span<const std::string_view> law_names();

// `drawing`: by what the frames are drawn, which tells a law what to believe of prices before it has seen times. Throws
// std::invalid_argument naming the laws there are.
std::unique_ptr<Controller> make_controller(std::string_view law, Drawing drawing = Drawing::opengl);

}  // namespace sfsm
