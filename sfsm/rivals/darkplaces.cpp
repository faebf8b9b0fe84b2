// DarkPlaces (Xonotic): a proportional step on every frame, with a tax on the way up.
#include <algorithm>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"

namespace sfsm {
namespace {

constexpr double gain = 0.2;          // of the quality, at an error of 1
constexpr double rise_tax = 0.05;     // of the quality: a rise starts where the gain is worth more
constexpr double largest_step = 0.1;  // of quality

class DarkPlaces final : public OneKnob {
    void forget() override { *this = DarkPlaces(); }

    void learn(const Measured& measured) override {
        double step = gain * detail() * (1 / measured.load - 1);
        if (step > 0) step = std::max(0.0, step - rise_tax * detail());
        if (step == 0) return keep("not fast enough to rise");
        turn_to(detail() + std::clamp(step, -largest_step, largest_step), step < 0 ? "slow" : "fast");
    }
};

}  // namespace

std::unique_ptr<Controller> make_darkplaces() {
    return std::make_unique<DarkPlaces>();
}

}  // namespace sfsm
