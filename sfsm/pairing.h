// Which decision does a time belong to? Whoever gives times back may number frames from any number on, and may have
// rounded the decision: to floats, or to a text of six digits.
#pragma once

#include <array>
#include <cstdint>

#include "sfsm/decision.h"

namespace sfsm {

// The same but for rounding to six digits: states, and those numbers that mean something in them.
bool is_alike(const Decision& a, const Decision& b);

// Remembers the newest 32 decisions; times come at most 16 frames late. Frames are taken to be numbered from 0, or if
// the first time's number is none that has been decided yet, from that on. Where a decision is another one than the
// number says, the nearest decision that is alike moves the numbering.
class Pairing {
public:
    // The next decision.
    void add(const Decision& decision);

    std::int64_t count() const { return count_; }  // decisions so far

    // Gives the sample the number of its decision, counted from 0, and that decision to the bit. One of an unknown
    // decision keeps it. False: it was drawn before forget().
    bool pair(FrameSample& sample);

    // The decisions so far are of another scene.
    void forget() { first_ = count_; }

private:
    static constexpr std::int64_t most = 32;

    const Decision& at(std::int64_t number) const { return ring_[static_cast<std::size_t>(number % most)]; }
    bool is_known(std::int64_t number) const;
    bool find(std::int64_t& number, const Decision& decision) const;

    std::array<Decision, most> ring_{};
    std::int64_t count_ = 0;
    std::int64_t first_ = 0;   // number of the first decision that is not forgotten
    std::int64_t offset_ = 0;  // a frame's number less its decision's
    bool is_numbered_ = false;
};

}  // namespace sfsm
