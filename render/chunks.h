// A long list in a few parts, side by side: each may count first and write to its own place then, so that what comes
// out doesn't depend on threads.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cstddef>

namespace render {

inline constexpr std::size_t most_chunks = 32;

struct Chunk {
    std::size_t number;      // below most_chunks
    std::size_t first, end;  // of the list
};

// The same chunks for lists of the same length.
template <typename Work>
void for_each_chunk(std::size_t length, Work work) {
    constexpr std::size_t worth_a_task = 1024;
    const std::size_t chunks = std::clamp<std::size_t>(length / worth_a_task, 1, most_chunks);
    const auto at = [&](std::size_t number) { return length * number / chunks; };
    tbb::parallel_for(
        std::size_t{0}, chunks,
        [&](std::size_t i) {
            work(Chunk{i, at(i), at(i + 1)});
        },
        tbb::static_partitioner());
}

}  // namespace render
