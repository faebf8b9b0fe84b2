#include "sfsm/ceiling.h"

#include <algorithm>

namespace sfsm {
namespace {

constexpr int trial = 24;                           // decisions that a rise is watched for
constexpr int first_patience = 16, longest = 1024;  // decisions
constexpr double narrow = 0.01;                     // of detail: not worth a rise below a ceiling
constexpr double fallen = 0.9;                      // share of the time by which load is found to have fallen

}  // namespace

double Ceiling::rise(double from, double to, double ms_at_from) {
    if (wait_ > 0) return from;
    if (ceiling_ <= 1) {
        to = std::min(to, (from + ceiling_) / 2);
        if (to - from < narrow) return from;
        wait_ = trial;
    }
    from_ = from;
    to_ = to;
    ms_ = ms_at_from;
    age_ = failures_ = 0;
    return to;
}

double Ceiling::fall(double at, double to) {
    if (age_ > trial || at != to_ || at <= from_) return to;
    ceiling_ = at;
    lasts_ = longest;
    wait_ = patience_;
    patience_ = std::min(2 * patience_, longest);
    // What was learned of the way may be right, but not twice wrong.
    to_ = ++failures_ == 1 ? std::max(to, from_) : std::clamp(to, from_, (from_ + at) / 2);
    age_ = 0;
    return to_;
}

void Ceiling::step(double ms_at_floor) {
    if (age_ <= trial) ++age_;
    if (wait_ > 0) --wait_;
    if (lasts_ > 0 && (--lasts_ == 0 || (age_ > trial && ms_at_floor < fallen * ms_))) forget();
}

void Ceiling::forget() {
    ceiling_ = 2;
    wait_ = lasts_ = 0;
    patience_ = first_patience;
}

}  // namespace sfsm
