// What a front says, in sentences that are made from its rows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/front/scene.h"

namespace bench::front {

inline constexpr double frame_ms = 16.6;  // 60 frames a second

// `key` is what somebody wants to know who has no time for the rest: it is printed bold. Any part may be empty.
struct Sentence {
    std::string before, key, after;

    std::string text() const { return before + key + after; }
};

// The setting with the least error that a frame has time for, or the fastest where none is fast enough.
Sentence what_to_draw(const Scene& scene, const ErrorKind& error);

// What each further millisecond takes off the error: between the front at 16.6 ms, or its fast end where that is
// slower, and the front at twice that time. One step alone can be steep or flat by chance.
Sentence what_a_millisecond_buys(const Scene& scene, const ErrorKind& error);

// Where what the default law chose has the most error for what the front has in the same time: by ratio, of PSNR by
// difference.
struct Loss {
    Sentence sentence;
    std::optional<std::size_t> scene, row;  // which of `scenes`, and which of its rows
};
Loss where_the_law_loses(const std::vector<Scene>& scenes, const ErrorKind& error);

// The front's row with the least error in at most `ms`; nothing: none is so fast. `front`: as front_of gives it.
std::optional<std::size_t> best_within(const Scene& scene, const std::vector<std::size_t>& front, double ms);

}  // namespace bench::front
