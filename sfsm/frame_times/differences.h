// Whether one recording is faster than another, or only seems so.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sfsm/recordings/frame_record.h"

namespace sfsm {

// A figure of two recordings. Neighbouring frames are alike, so what would be seen if both were recorded again is
// estimated from blocks of frames drawn with replacement (the block bootstrap: Kuensch 1989, Annals of Statistics 17),
// 1 second long or a twentieth of the run.
struct Difference {
    std::string name;  // "average", "P1"
    std::string unit;  // "fps", "%", "ms"
    double first = 0, second = 0;
    double change = 0;         // second / first - 1; of shares the difference; NaN: not to be told
    double low = 0, high = 0;  // 95 % of the changes drawn lie between; NaN: too few blocks
    bool is_share = false;     // `change`, `low` and `high` are differences of shares
    bool is_clear() const { return low > 0 || high < 0; }
};

// Of average, median, P1, P0.1, 1 % low (integral), the share of time in stutter. The same frames and seed give the
// same numbers on every machine.
std::vector<Difference> differences_of(std::span<const FrameRecord> first, std::span<const FrameRecord> second,
                                       std::uint64_t seed);

}  // namespace sfsm
