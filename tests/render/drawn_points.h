// People of a frame in words.
#pragma once

#include "figures/way.h"
#include "render/frame.h"

namespace tests {

// How many points a person is drawn by; 0: by something else.
inline std::uint32_t points_of(const render::Person& person, const figures::Way& way = figures::by_opengl()) {
    return way.representations[person.representation].is_mesh ? 0 : person.count;
}

// The same way of drawing, in which nobody is drawn block by block.
inline figures::Way without_blocks(figures::Way way) {
    while (way.representations.back().is_by_block)
        way.representations = way.representations.first(way.representations.size() - 1);
    return way;
}

}  // namespace tests
