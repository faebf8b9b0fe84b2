// A model of Second Life's auto-tune: a mean of 50 frames is judged at a time; over the budget the draw distance
// shrinks by ten metres, and it grows again after three periods in a row with time to spare. Its other half, a limit of
// time per avatar set just below the costliest, has no meaning without the cost of each avatar: what it does is left to
// the distance. The full distance, and how much time is to spare, are ours.
#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr std::size_t period = 50;                    // frames
constexpr double step_m = 10, full_distance_m = 256;  // draw distance
constexpr double step = step_m / full_distance_m;     // of detail
constexpr int periods_to_rise = 3;
constexpr double spare = 0.05;  // of the budget

class SecondLife final : public OneKnob {
    void forget() override { *this = SecondLife(); }

    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        if (!loads_.is_full()) return keep("waiting");
        const double load = loads_.mean();
        loads_.clear();
        fast_periods_ = load < 1 - spare ? fast_periods_ + 1 : 0;
        if (load > 1) {
            turn_to(detail() - step, "over the budget: nearer");
        } else if (fast_periods_ == periods_to_rise) {
            fast_periods_ = 0;
            turn_to(detail() + step, "time to spare: farther");
        } else {
            keep("within the budget");
        }
    }

    Window<period> loads_;
    int fast_periods_ = 0;
};

}  // namespace

std::unique_ptr<Controller> make_second_life() {
    return std::make_unique<SecondLife>();
}

}  // namespace sfsm
