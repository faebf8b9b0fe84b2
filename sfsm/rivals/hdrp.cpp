// Unity's HDRP example script: large fixed steps on the verdict of several groups of frames.
#include "sfsm/rivals/laws.h"
#include "sfsm/rivals/one_knob.h"

namespace sfsm {
namespace {

constexpr int group = 15;                       // [frames]
constexpr int bad_groups = 4, good_groups = 8;  // in a row: how "4 bad groups" is read here
constexpr double knob_range = 1 - least_detail;
constexpr double fall_step = knob_range / 2, rise_step = knob_range / 5;

class Hdrp final : public OneKnob {
    void forget() override { *this = Hdrp(); }

    void learn(const Measured& measured) override {
        sum_ += measured.load;
        if (++frames_ < group) return;
        const bool is_bad = sum_ / group > 1;
        sum_ = 0;
        frames_ = 0;
        bad_ = is_bad ? bad_ + 1 : 0;
        good_ = is_bad ? 0 : good_ + 1;
        if (bad_ == bad_groups) return take(-fall_step, "slow for long");
        if (good_ == good_groups) return take(rise_step, "fast for long");
        keep("counting groups");
    }

    void take(double change, const char* reason) {
        bad_ = good_ = 0;
        turn_to(detail() + change, reason);
    }

    double sum_ = 0;
    int frames_ = 0, bad_ = 0, good_ = 0;
};

}  // namespace

std::unique_ptr<Controller> make_hdrp() {
    return std::make_unique<Hdrp>();
}

}  // namespace sfsm
