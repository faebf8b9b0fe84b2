// Unity's sample dynamic resolution: down by the miss, also by a foreseen one; up by a counter of quiet frames.
#include <algorithm>
#include <cmath>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"

namespace sfsm {
namespace {

constexpr int rise_at = 360;                        // of the counter
constexpr int falling_count = 10, quiet_count = 3;  // a frame adds
constexpr double quiet_spare = 0.06;                // share of t to spare, more than this
constexpr double quiet_growth = 0.035;              // share of t a frame, less than this
constexpr double largest_rise = 0.035;              // of the scale
constexpr double least_share = 0.25;                // of the largest rise, at least_spare
constexpr double least_spare = 0.1, most_spare = 0.5;

class UnitySample final : public OneKnob {
    void forget() override { *this = UnitySample(); }

    void learn(const Measured& measured) override {
        const double spare = 1 - measured.load, growth = has_last_ ? measured.load - last_ : 0;
        last_ = measured.load;
        has_last_ = true;
        if (spare < 0) return fall(spare, "slow");
        if (growth > spare) return fall(-growth, "about to be slow");
        if (growth < 0) {
            counter_ += falling_count;
        } else if (spare > quiet_spare && growth < quiet_growth) {
            counter_ += quiet_count;
        }
        if (counter_ < rise_at) return keep("counting quiet frames");
        counter_ = 0;
        const double share = (std::clamp(spare, least_spare, most_spare) - least_spare) / (most_spare - least_spare);
        turn_to(detail() + largest_rise * std::lerp(least_share, 1.0, share), "quiet for long");
    }

    void fall(double change, const char* reason) {
        counter_ = 0;
        turn_to(detail() + change, reason);
    }

    int counter_ = 0;
    double last_ = 0;
    bool has_last_ = false;
};

}  // namespace

std::unique_ptr<Controller> make_unity_sample() {
    return std::make_unique<UnitySample>();
}

}  // namespace sfsm
