// Has the level of a noisy signal shifted, up or down? A single outlier shifts nothing. No clock, no allocation.
#pragma once

#include <array>

namespace sfsm {

// Watches residuals, in units of their standard deviation. It finds a shift where |sum of the last n| / sqrt(n) is over
// the threshold for some n <= window (a windowed generalised likelihood ratio). Residuals are clipped: one alone never
// shows a shift, two in a row beyond about 3 do, smaller ones must be more.
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
