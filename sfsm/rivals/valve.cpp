// Valve's The Lab: levels of rendered area, two down when a frame comes near its budget or is about to, one up when
// three were well inside.
#include <algorithm>
#include <cmath>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr double level_ratio = 1.15;                           // of area
constexpr int coarsest_level = 22;                             // where detail reaches its least
constexpr int drop = 2, rise = 1;                              // [levels]
constexpr double high = 0.9, nearly_high = 0.85, low = 0.7;    // shares of t
constexpr int drop_wait = 3, predict_wait = 4, full_wait = 5;  // [frames] since a change

class Valve final : public OneKnob {
    void forget() override { *this = Valve(); }

    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        since_change_ = std::min(since_change_ + 1, full_wait);
        // "Three above `high` after full_wait" is a case of the first.
        if (since_change_ >= drop_wait && loads_[0] > high) return change(drop, "near the budget");
        if (since_change_ >= predict_wait && loads_[0] > nearly_high && next_load() > high)
            return change(drop, "about to be near the budget");
        if (since_change_ >= full_wait && loads_.max() < low) return change(-rise, "well inside three times");
        keep("between");
    }

    // The newest load and its growth, by one frame's or half of two frames'.
    double next_load() const {
        double growth = loads_[0] - loads_[1];
        if (since_change_ >= full_wait) growth = std::max(growth, (loads_[0] - loads_[2]) / 2);
        return loads_[0] + growth;
    }

    void change(int levels, const char* reason) {
        const int next = std::clamp(level_ + levels, 0, coarsest_level);
        if (next == level_) return keep("at the end of the levels");
        level_ = next;
        since_change_ = 0;
        turn_to(std::pow(level_ratio, -level_), reason);
    }

    Window<3> loads_;
    int level_ = 0;  // 0 is all of the detail
    int since_change_ = 0;
};

}  // namespace

std::unique_ptr<Controller> make_valve() {
    return std::make_unique<Valve>();
}

}  // namespace sfsm
