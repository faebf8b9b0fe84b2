// A frame-time controller: past samples in, the next decision out. No clock, no I/O, no allocation after construction;
// the same calls give the same decisions to the bit.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "sfsm/decision.h"
#include "sfsm/drawing.h"
#include "sfsm/forecast.h"
#include "sfsm/predictive_options.h"
#include "sfsm/status.h"

namespace sfsm {

// What is known of a frame before it is drawn.
struct FrameRequest {
    double target_ms = 0;  // > 0
    // L [m] > 0: people are visible up to this view depth. 0 for who has no such thing: without any, D is in hundredths
    // of it (unknown_range), and detail_of() makes one number of a decision. A forecast's depths are metres all the
    // same.
    double range = 0;
    const Forecast* forecast = nullptr;  // nullptr: the renderer can't say
};

class Controller {
public:
    virtual ~Controller() = default;

    // A time has arrived; in frame order, possibly frames late. Frames are numbered one by one, from any number on. The
    // decision may have been rounded to six digits.
    virtual void observe(const FrameSample& sample) = 0;

    // The decision for the next frame. A target or range that is not finite and over 0 is ignored: the last usable one
    // holds.
    virtual Decision decide(const FrameRequest& request) = 0;

    // Another scene was loaded: all that was learned is forgotten. Target, range and options stay. What the next frames
    // are called goes on or begins anew.
    virtual void reset() = 0;

    virtual const Status& status() const = 0;
};

struct LawOptions {
    Drawing drawing = Drawing::opengl;  // by what frames are drawn: what to believe of prices before times were seen
    PredictiveOptions predictive = {};  // of that law; the others keep the values of their papers and files
};

// The laws there are, in the order they are listed to a user.
std::span<const std::string_view> law_names();

// Throws std::invalid_argument naming the laws there are, or the first rule that the options break.
std::unique_ptr<Controller> make_controller(std::string_view law, const LawOptions& options = {});

}  // namespace sfsm
