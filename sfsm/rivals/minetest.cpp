// Minetest's view range: a damped secant of busy time over range, five times a second. The shipped precedent of the
// paper's secant; it was removed after users saw the range wander.
#include <algorithm>
#include <cmath>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"

namespace sfsm {
namespace {

constexpr double period_ms = 200;
constexpr double ignored_share = 1.0 / 3;  // of t: smaller misses are left alone
constexpr double least_slope = 0.5;        // [ms per node]
constexpr double damping = 0.5;            // share of the secant step taken
constexpr double full_range = 240;         // [nodes] of view range at detail 1: ours, its longest preset

class Minetest final : public OneKnob {
    void forget() override { *this = Minetest(); }

    void learn(const Measured& measured) override {
        elapsed_ms_ += measured.ms;
        ++frames_;
        if (elapsed_ms_ < period_ms) return;
        const double busy_ms = elapsed_ms_ / frames_;
        elapsed_ms_ = 0;
        frames_ = 0;
        adjust(busy_ms, measured.target_ms);
    }

    void adjust(double busy_ms, double target_ms) {
        const double range = detail() * full_range;
        const double moved = range - last_range_;
        if (moved != 0 && last_range_ > 0) slope_ = (busy_ms - last_busy_ms_) / moved;
        slope_ = std::max(slope_, least_slope);
        last_range_ = range;
        last_busy_ms_ = busy_ms;
        const double spare_ms = target_ms - busy_ms;
        if (std::abs(spare_ms) < ignored_share * target_ms) return keep("near enough");
        turn_to((range + damping * spare_ms / slope_) / full_range, spare_ms < 0 ? "slow" : "fast");
    }

    double elapsed_ms_ = 0;
    int frames_ = 0;
    double last_range_ = 0;  // [nodes]; 0: none yet
    double last_busy_ms_ = 0;
    double slope_ = least_slope;  // [ms per node]
};

}  // namespace

std::unique_ptr<Controller> make_minetest() {
    return std::make_unique<Minetest>();
}

}  // namespace sfsm
