// Intel's dynamic resolution rendering sample: a slow integrator of the mean time turns a scale per axis, so the
// rendered area (detail) is its square. A frame here has no time apart from the GPU's: the sample's blend of both is
// that time.
#include <cmath>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr std::size_t history = 10;  // [frames]
constexpr double rate = 0.01;        // of the scale, a frame, at an error of 1

class Intel final : public OneKnob {
    void forget() override { *this = Intel(); }

    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        const double error = 1 - loads_.mean();
        const double scale = std::sqrt(detail()) * (1 + rate * error);
        turn_to(scale * scale, error < 0 ? "slow" : "fast");
    }

    Window<history> loads_;
};

}  // namespace

std::unique_ptr<Controller> make_intel() {
    return std::make_unique<Intel>();
}

}  // namespace sfsm
