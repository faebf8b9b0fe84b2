// Room in a vector that is filled anew.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace render {

// `count` elements, of any content. Where they don't fit, the old ones are let go first: resize() would have both in
// memory for a moment. A quarter more is taken, at most `most`.
template <typename T>
void resize_anew(std::vector<T>& elements, std::size_t count,
                 std::size_t most = std::numeric_limits<std::size_t>::max()) {
    if (count > elements.capacity()) {
        elements = {};
        elements.reserve(std::max(count, std::min(count + count / 4, most)));
    }
    elements.resize(count);
}

}  // namespace render
