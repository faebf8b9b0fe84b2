#include "sfsm/ceiling.h"

#include <algorithm>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr int trial = 24;                           // decisions that a rise is watched for
constexpr int first_patience = 16, longest = 1024;  // decisions
constexpr int unconfirmed = 64;                     // decisions that a ceiling lasts which may be chance
constexpr double much_to_spare = 0.1;               // [ln] of time
constexpr int hurry = 8;                            // decisions that one counts for while there is so much
constexpr int hopeless = 128;                       // [decisions] patience from which on nothing hurries
constexpr double narrow = 0.01;                     // of detail: not worth a rise below a ceiling
constexpr int held = 6;                             // decisions at the floor after a failure
constexpr int settled = 10;                         // decisions after it from which on predictions are of use
constexpr double fallen = 0.85;                     // share of the time by which load is found to have fallen

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
    if (lasts_ > 0 && since_failure_ < held && at == floor_) return at;
    if (age_ > trial || at != to_ || at <= from_) return to;
    const bool is_confirmed = failures_ > 0 ? lasts_ > unconfirmed : from_ < suspect_;
    lasts_ = is_confirmed ? longest : unconfirmed;
    ceiling_ = suspect_ = at;
    floor_ = from_;
    floor_ms_ = ms_;
    wait_ = patience_;
    patience_ = std::min(2 * patience_, longest);
    // What was learned of the way may be right, but not twice wrong.
    to_ = ++failures_ == 1 ? std::max(to, from_) : std::clamp(to, from_, (from_ + at) / 2);
    age_ = since_failure_ = 0;
    return to_;
}

void Ceiling::step(double ms_at_floor, double to_spare) {
    if (age_ <= trial) ++age_;
    if (since_failure_ < trial) {
        ++since_failure_;
        if (since_failure_ >= settled) floor_ms_ = std::max(floor_ms_, ms_at_floor);
    }
    const bool is_hurrying = to_spare > much_to_spare && patience_ <= hopeless;
    wait_ = std::max(wait_ - (is_hurrying ? hurry : 1), 0);
    if (lasts_ == 0) return;
    if (since_failure_ == trial && ms_at_floor < fallen * floor_ms_) return drop();
    if (--lasts_ == 0) lift();
}

void Ceiling::forget() {
    drop();
    age_ = trial + 1;
}

void Ceiling::drop() {
    lift();
    suspect_ = 0;
}

void Ceiling::lift() {
    ceiling_ = 2;
    wait_ = lasts_ = 0;
    patience_ = first_patience;
}

}  // namespace sfsm
