#include "sfsm/pairing.h"

#include <algorithm>
#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double rounding = 1e-5;  // relative; six digits are off by half of that

bool is_near(double a, double b) {
    return a == b || std::abs(a - b) <= rounding * std::min(std::abs(a), std::abs(b));
}

// Frames may have any number; the difference of two must not overflow.
std::int64_t less(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

double distance(std::int64_t a, std::int64_t b) {
    return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

}  // namespace

bool is_alike(const Decision& a, const Decision& b) {
    if (a.state != b.state || !is_near(a.rate, b.rate)) return false;
    if (a.state != State::original && !is_near(a.motion_distance, b.motion_distance)) return false;
    return a.state != State::points || is_near(a.splat_size, b.splat_size);
}

void Pairing::add(const Decision& decision) {
    ring_[static_cast<std::size_t>(count_ % most)] = decision;
    ++count_;
}

bool Pairing::is_known(std::int64_t number) const {
    return number >= std::max(first_, count_ - most) && number < count_;
}

// The nearest decision that is alike; of two the newer.
bool Pairing::find(std::int64_t& number, const Decision& decision) const {
    bool is_found = false;
    std::int64_t nearest = 0;
    for (std::int64_t i = count_ - 1; is_known(i); --i) {
        if (!is_alike(at(i), decision) || (is_found && distance(i, number) >= distance(nearest, number))) continue;
        nearest = i;
        is_found = true;
    }
    if (is_found) number = nearest;
    return is_found;
}

bool Pairing::pair(FrameSample& sample) {
    if (!is_numbered_ && (sample.frame < 0 || sample.frame >= count_)) offset_ = less(sample.frame, first_);
    is_numbered_ = true;
    const std::int64_t numbered = less(sample.frame, offset_);
    if (numbered < first_ && numbered >= std::max<std::int64_t>(first_ - most, 0)) return false;
    std::int64_t number = numbered;
    if ((is_known(number) && is_alike(at(number), sample.decision)) || find(number, sample.decision)) {
        offset_ = less(sample.frame, number);
        sample.decision = at(number);
    }
    sample.frame = number;
    return true;
}

}  // namespace sfsm
