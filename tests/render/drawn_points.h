// People of a frame in words.
#pragma once

#include "figures/way.h"
#include "render/frame.h"

namespace tests {

// How many points a person is drawn by; 0: by something else.
inline std::uint32_t points_of(const render::Person& person, const figures::Way& way = figures::by_opengl()) {
    return way.representations[person.representation].is_mesh ? 0 : person.count;
}

}  // namespace tests
