// Now and then a few frames with less detail than a law keeps, while a target is out of reach: what it has given up on
// may work again. That less detail buys nothing is learned where something else limits the frames (a processor, another
// program), and would be believed for ever after.
#pragma once

#include <array>
#include <cstdint>

namespace sfsm {

// A retest is three decisions long. The first begins with the 64th decision, the next with the 128th after it, and so
// on up to the longest wait; a new load begins the waits anew. So at most 3 of 66 frames are drawn coarser for it, and
// in the long run 3 of 258 if the longest wait is 256.
class Retest {
public:
    explicit Retest(int longest_wait) : longest_wait_(longest_wait) {}  // [decisions], at least 64

    // Once a decision. `is_due`: out of reach, and there is less detail to test. `shifts`: how often the load has
    // changed so far. Whether this decision is one of a retest.
    bool step(bool is_due, std::int64_t shifts);

    // A retest's time took exp(residual) times what was predicted; `noise`: 1 sigma of a single frame, relative. True
    // with the last of a retest, if the median is clearly below what was believed.
    bool has_disproved(double residual, double noise);

private:
    static constexpr int frames = 3;  // of a retest
    static constexpr int first_wait = 64;

    void begin_anew();

    int longest_wait_;
    int wait_ = first_wait;  // [decisions] until the next
    int patience_ = first_wait;
    int left_ = 0;  // [decisions] of the one that is being drawn
    std::int64_t shifts_ = 0;
    std::array<double, frames> residuals_{};
    int heard_ = frames;
};

}  // namespace sfsm
