// A model of Woof!'s dynamic resolution: one to three steps at once by how far the mean is off. Its thresholds and its
// reserve are facts; the length of the history and the size of a step are ours.
#include <algorithm>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr double reserve_ms = 1.25;                 // of t
constexpr double least_goal = 0.5;                  // share of t: short targets keep some time after the reserve; ours
constexpr std::size_t history = 15;                 // [frames]: ours
constexpr double step = 0.05;                       // of detail: ours
constexpr double slow_ratios[] = {1.08, 1.2, 1.5};  // a step down for each that is exceeded
constexpr double fast_ratios[] = {0.6, 0.4};        // a step up for each that is undercut

class Woof final : public OneKnob {
    void forget() override { *this = Woof(); }

    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        if (!loads_.is_full()) return;  // also the cooldown: one history after each step
        const double goal = std::max(measured.target_ms - reserve_ms, least_goal * measured.target_ms);
        const double ratio = loads_.mean() * measured.target_ms / goal;
        int steps = 0;
        for (const double slow : slow_ratios) steps -= ratio > slow ? 1 : 0;
        for (const double fast : fast_ratios) steps += ratio < fast ? 1 : 0;
        if (steps == 0) return keep("near enough");
        loads_.clear();
        turn_to(detail() + step * steps, steps < 0 ? "slow" : "fast");
    }

    Window<history> loads_;
};

}  // namespace

std::unique_ptr<Controller> make_woof() {
    return std::make_unique<Woof>();
}

}  // namespace sfsm
