// Robust MPC's estimate (video streaming), with detail per millisecond in the place of bytes per second: the harmonic
// mean of the last five, divided by 1 + the worst of the last five relative errors of that mean as a forecast. The
// margin is theirs; spending exactly the estimate on the next frame is ours, and takes cost to be in proportion to
// detail.
#include <algorithm>
#include <cmath>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr std::size_t history = 5;  // [frames]

class RobustMpc final : public OneKnob {
    void forget() override { *this = RobustMpc(); }

    void learn(const Measured& measured) override {
        const double cost = measured.load / std::max(measured.detail, least_detail);  // of all detail, in targets
        // The mean rate is 1 / mean cost, so its relative error against this frame's rate is cost / mean - 1.
        if (costs_.size() > 0) errors_.push(std::abs(cost / costs_.mean() - 1));
        costs_.push(cost);  // the harmonic mean of rates is the reciprocal of the mean cost
        const double margin = errors_.size() > 0 ? 1 + errors_.max() : 1;
        turn_to(1 / (costs_.mean() * margin), "what the estimate allows");
    }

    Window<history> costs_, errors_;
};

}  // namespace

std::unique_ptr<Controller> make_robust_mpc() {
    return std::make_unique<RobustMpc>();
}

}  // namespace sfsm
