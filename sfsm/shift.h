// Has the level of a noisy signal shifted? Two-sided, deaf to a single outlier: no clock, no allocation.
#pragma once

#include <array>

namespace sfsm {

// Watches residuals in units of their own standard deviation. Each is clipped, so that one alone never shifts
// anything, and two in a row beyond about 3 do; smaller ones must add up over more samples: the largest of
// |sum of the last n| / sqrt(n) over n <= window is compared with a threshold (a windowed generalised likelihood
// ratio).
class ShiftDetector {
public:
    static constexpr int window = 32;         // samples
    static constexpr double clip = 3;         // standard deviations; clip < threshold < clip sqrt(2)
    static constexpr double threshold = 4.2;  // false alarms of Gaussian noise: one in some 10^4 samples

    // The number of newest samples (2 to window) that show a shift, or 0. Cost: `window` additions.
    int add(double standardised);

    void clear() { count_ = 0; }

private:
    std::array<double, window> recent_{};  // a ring
    int count_ = 0;
    int next_ = 0;
};

}  // namespace sfsm
