#include "sfsm/shift.h"

#include <algorithm>
#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {

int ShiftDetector::add(double standardised) {
    recent_[static_cast<std::size_t>(next_)] = std::clamp(standardised, -clip, clip);
    count_ = std::min(count_ + 1, window);
    double sum = 0, most = threshold * threshold;
    int shown = 0;
    for (int n = 1, at = next_; n <= count_; ++n, at = (at + window - 1) % window) {
        sum += recent_[static_cast<std::size_t>(at)];
        if (sum * sum > most * n) {
            most = sum * sum / n;
            shown = n;
        }
    }
    next_ = (next_ + 1) % window;
    return shown;
}

}  // namespace sfsm
