// drei's PerformanceMonitor: the vote of ten quarter-second frame rates. Its bounds of 60 and 40 frames a second are
// taken in proportion to the target's rate.
#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"

namespace sfsm {
namespace {

constexpr double window_ms = 250;
constexpr int windows = 10;
constexpr double majority = 7.5;              // windows, more than this
constexpr double upper = 1, lower = 2.0 / 3;  // frame rates, of the target's
constexpr double step = 0.1;
constexpr double start = 0.5;

class Drei final : public OneKnob {
public:
    Drei() : OneKnob(start) {}

private:
    void forget() override { *this = Drei(); }

    void learn(const Measured& measured) override {
        elapsed_ms_ += measured.ms;
        ++frames_;
        if (elapsed_ms_ < window_ms) return;
        const double rate = frames_ * measured.target_ms / elapsed_ms_;
        elapsed_ms_ = 0;
        frames_ = 0;
        above_ += rate > upper ? 1 : 0;
        below_ += rate < lower ? 1 : 0;
        if (++votes_ == windows) count();
    }

    void count() {
        if (above_ > majority) {
            turn_to(detail() + step, "fast in most windows");
        } else if (below_ > majority) {
            turn_to(detail() - step, "slow in most windows");
        } else {
            keep("no majority");
        }
        votes_ = above_ = below_ = 0;
    }

    double elapsed_ms_ = 0;
    int frames_ = 0, votes_ = 0, above_ = 0, below_ = 0;
};

}  // namespace

std::unique_ptr<Controller> make_drei() {
    return std::make_unique<Drei>();
}

}  // namespace sfsm
