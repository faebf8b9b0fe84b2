// A model of Unity's Adaptive Performance indexer: means of means, then one step after seconds. The thresholds, means
// and the missing headroom test are its; the size of a step is not published, and which delay belongs to which step
// isn't either: those are ours. With one knob, "undo the costliest" is one step up.
#include <algorithm>

#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"
#include "sfsm/rivals/window.h"

namespace sfsm {
namespace {

constexpr std::size_t frame_history = 100, sample_history = 120;
constexpr double lower_at = 0.15, lower_fast_at = 0.30;  // T / t - 1
constexpr double fast_delay_ms = 4000, delay_ms = 10000;
constexpr double step = 0.1;  // of detail: ours

class UnityAdaptive final : public OneKnob {
    void forget() override { *this = UnityAdaptive(); }

    void learn(const Measured& measured) override {
        loads_.push(measured.load);
        excesses_.push(loads_.mean() - 1);
        since_ms_ = std::min(since_ms_ + measured.ms, delay_ms);
        const double excess = excesses_.mean();
        const bool is_fast = excess >= lower_fast_at;
        if (since_ms_ < (is_fast ? fast_delay_ms : delay_ms)) return keep("waiting");
        since_ms_ = 0;
        if (excess >= lower_at) {
            turn_to(detail() - step, is_fast ? "very slow" : "slow");
        } else {
            turn_to(detail() + step, "not slow: undo one");
        }
    }

    Window<frame_history> loads_;
    Window<sample_history> excesses_;
    double since_ms_ = 0;  // the last step
};

}  // namespace

std::unique_ptr<Controller> make_unity_adaptive() {
    return std::make_unique<UnityAdaptive>();
}

}  // namespace sfsm
