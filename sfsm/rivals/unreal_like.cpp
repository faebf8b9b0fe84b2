// A model of Unreal's dynamic resolution, from its documented settings. How it blends and what it does in a panic are
// not documented; those two are ours: the share of the target that is kept free sets the scale in proportion, and a
// panic judges by the newest time alone.
#include <algorithm>
#include <cmath>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr std::size_t history = 16;        // [frames]
constexpr double frame_weight = 0.9;       // of a time, to that of the next newer one
constexpr double headroom = 0.10;          // share of t
constexpr int change_period = 8;           // [frames] at least between changes
constexpr double least_change = 0.02;      // of the scale
constexpr int panic_frames = 2;            // over t, in a row
constexpr double rise_amortisation = 0.9;  // share of a rise that is taken

class UnrealLike final : public OneKnob {
    void forget() override { *this = UnrealLike(); }

    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        since_change_ = std::min(since_change_ + 1, change_period);
        over_ = measured.load > 1 ? std::min(over_ + 1, panic_frames) : 0;
        if (over_ == panic_frames) return panic(measured.load);
        if (since_change_ < change_period) return;
        double change = detail() * ((1 - headroom) / weighted_mean() - 1);
        if (change > 0) change *= rise_amortisation;
        if (std::abs(change) < least_change) return keep("change too small");
        take(detail() + change, change < 0 ? "slow" : "fast");
    }

    void panic(double load) { take(detail() * (1 - headroom) / load, "over budget twice"); }

    void take(double detail, const char* reason) {
        turn_to(detail, reason);
        loads_.clear();
        since_change_ = over_ = 0;
    }

    double weighted_mean() const {
        double sum = 0, weights = 0, weight = 1;
        for (std::size_t age = 0; age < loads_.size(); ++age, weight *= frame_weight) {
            sum += weight * loads_[age];
            weights += weight;
        }
        return sum / weights;
    }

    Window<history> loads_;  // since the last change
    int since_change_ = 0, over_ = 0;
};

}  // namespace

std::unique_ptr<Controller> make_unreal_like() {
    return std::make_unique<UnrealLike>();
}

}  // namespace sfsm
