// Whether one recording is faster than another, or only seems so.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sfsm/recordings/frame_record.h"

namespace sfsm {

// A figure of two recordings. Neighbouring frames are alike, so what would be seen if both were recorded again is
// estimated from blocks of frames drawn with replacement (the block bootstrap: Carlstein 1986, Kuensch 1989, both in
// the Annals of Statistics). A run is cut into blocks of equal time: 5 s, or a twentieth of the run if that is less,
// but no more than 1000 blocks and about 30 frames in each. It tells what likeness of neighbours does to a figure if
// that lasts for less than a block, not what another day, place or player would.
inline constexpr int difference_draws = 1000;
inline constexpr int fewest_blocks = 8;

struct Difference {
    std::string name;  // "average", "P1"
    std::string unit;  // "fps"; "%" of a share, which is told as [0, 1]
    double first = 0, second = 0;
    double change = 0;         // second / first - 1; of shares the difference; NaN: not to be told
    double low = 0, high = 0;  // 95 % of the changes drawn lie between; NaN: not to be told
    bool is_share = false;     // `change`, `low` and `high` are differences of shares
    bool is_clear() const { return low > 0 || high < 0; }
};

// Of average, median, P1, P0.1, 1 % low (integral), the share of time in stutter. The same frames and seed give the
// same numbers on every machine. Of a run of fewer than `fewest_blocks` blocks `low` and `high` can't be told. A
// million frames take under a second.
std::vector<Difference> differences_of(std::span<const FrameRecord> first, std::span<const FrameRecord> second,
                                       std::uint64_t seed);

}  // namespace sfsm
