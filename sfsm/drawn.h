// The decisions that were drawn since a law last changed its mind. One answer makes several of them: D is a share of L,
// and L changes from frame to frame. A time that was drawn with none of them is late and tells of an older answer.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "sfsm/decision.h"
#include "sfsm/pairing.h"

namespace sfsm {

class DrawnDecisions {
public:
    void add(const Decision& decision) {
        if (count_ > 0 && ring_.front() == decision) return;
        std::rotate(ring_.begin(), ring_.end() - 1, ring_.end());
        ring_.front() = decision;
        count_ = std::min(count_ + 1, ring_.size());
    }
    bool contains(const Decision& decision) const {
        const auto end = ring_.begin() + static_cast<std::ptrdiff_t>(count_);
        return std::any_of(ring_.begin(), end, [&](const Decision& drawn) { return is_alike(drawn, decision); });
    }
    void clear() { count_ = 0; }

private:
    std::array<Decision, 32> ring_{};  // newest first; times come at most 16 frames late
    std::size_t count_ = 0;
};

}  // namespace sfsm
