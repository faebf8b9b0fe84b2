// A simulated renderer without its noise: what a frame costs for each decision, what of that the renderer knows
// beforehand, and which decision a clairvoyant would take. A pure function of the frame number.
#pragma once

#include <cstdint>
#include <functional>

#include "sfsm/decision.h"
#include "sfsm/forecast.h"

namespace sfsm::simulate {

using OverFrames = std::function<double(std::int64_t frame)>;

class Plant {
public:
    virtual ~Plant() = default;

    virtual double range(std::int64_t frame) const = 0;  // L [m] > 0

    // nullptr: this renderer can't say. Lives as long as the plant.
    virtual const Forecast* forecast(std::int64_t frame) const = 0;

    // [ms] > 0, free of noise. Any decision, also of no axis.
    virtual double cost_ms(std::int64_t frame, const Decision& decision) const = 0;

    virtual Work work(std::int64_t frame, const Decision& decision) const = 0;

    // How much of the picture a decision keeps, in (0, 1]: what quality is measured in.
    virtual double detail(std::int64_t frame, const Decision& decision) const = 0;

    // The decision of most detail that costs at most `limit_ms`, or, where that can't be had, no more than the least a
    // frame can cost: a limit that detail has no power over takes none of it away.
    virtual Decision optimum(std::int64_t frame, double limit_ms) const = 0;
};

}  // namespace sfsm::simulate
