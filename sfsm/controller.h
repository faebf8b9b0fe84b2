// A frame-time controller: past samples in, the next decision out. No clock, no I/O, no allocation after construction;
// the same calls give the same decisions to the bit.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sfsm/decision.h"
#include "sfsm/drawing.h"
#include "sfsm/forecast.h"
#include "sfsm/status.h"

namespace sfsm {

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
