// Intel's dynamic resolution rendering sample: a slow integrator of the mean time. A frame here has no time apart from
// the GPU's, so the sample's blend of both is the measured one.
#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr std::size_t history = 10;  // [frames]
constexpr double rate = 0.01;        // of the scale, a frame, at an error of 1

class Intel final : public OneKnob {
    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        const double error = 1 - loads_.mean();
        turn_to(detail() * (1 + rate * error), error < 0 ? "slow" : "fast");
    }

    Window<history> loads_;
};

}  // namespace

std::unique_ptr<Controller> make_intel() {
    return std::make_unique<Intel>();
}

}  // namespace sfsm
