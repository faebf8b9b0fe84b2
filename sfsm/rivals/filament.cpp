// Filament's dynamic resolution: a PI controller on the median GPU time turns the rendered area.
#include <algorithm>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr std::size_t history = 15;          // [frames]
constexpr double headroom = 0;               // share of t, by default
constexpr double proportional = 0.11750309;  // Kp = 1 - exp(-1/8)
constexpr double integral_gain = 0.002;      // a frame
constexpr double integral_limit = 100;
constexpr double dead_below = -0.01, dead_above = 0.05;  // output between them is 0

class Filament final : public OneKnob {
    void forget() override { *this = Filament(); }

    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        const double error = 1 - loads_.median() / (1 - headroom);
        if (!is_limited_) integral_ = std::clamp(integral_ + error, -integral_limit, integral_limit);
        const double output = proportional * error + integral_gain * integral_;
        is_limited_ = false;
        if (output > dead_below && output < dead_above) return keep("inside the dead band");
        if (output < 0) {
            is_limited_ = turn_to(detail() / (1 - output), "slow");
        } else {
            is_limited_ = turn_to(detail() * (1 + output), "fast");
        }
    }

    Window<history> loads_;
    double integral_ = 0;
    bool is_limited_ = false;  // by the last step
};

}  // namespace

std::unique_ptr<Controller> make_filament() {
    return std::make_unique<Filament>();
}

}  // namespace sfsm
