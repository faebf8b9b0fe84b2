// A frame of one person at the origin, drawn natively.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "figures/way.h"
#include "render/frame.h"

namespace tests {

// By so many of its points, of 1 px; 0: by its mesh.
inline render::Frame frame_of_one(const render::View& view, std::size_t points) {
    render::Person person{};
    person.instance.position = view.relative(glm::vec3(0));
    person.instance.scale = 1;
    person.instance.turn.cos_yaw = 32767;
    person.depth = view.depth(person.instance.position);
    person.last_share = 1;
    person.count = static_cast<std::uint32_t>(points);
    const auto all = figures::natively().representations;
    const auto is_wanted = [&](const figures::Representation& one) { return one.is_mesh == (points == 0); };
    person.representation = static_cast<std::uint32_t>(std::ranges::find_if(all, is_wanted) - all.begin());
    render::Frame frame;
    frame.view = view;
    frame.splat_size = 1;
    frame.people.push_back(person);
    return frame;
}

}  // namespace tests
