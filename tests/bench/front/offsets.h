// How far people are drawn from where and how they should be, in pixels: by what they are drawn from, not by pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/stage.h"
#include "figures/way.h"
#include "render/frame.h"
#include "tests/bench/front/row.h"

namespace bench::front {

// Everybody visible, drawn exactly: in the crowd's order, and who they are.
struct Present {
    std::vector<render::Person> people;
    std::vector<std::uint32_t> numbers;  // into the crowd; as `people`
};

// Of a frame of original triangles at `tick`.
Present present_in(const render::Frame& exact, const apps::Stage& stage, std::int64_t tick);

// People whose motion is looked at: more visible ones are sampled evenly, in the crowd's order.
inline constexpr std::size_t most_moving_people = 4096;

// Fills motion_px to covering_px of the row, of a frame of the same view and tick drawn in that way.
// - Motion: over people, the farthest of their vertices on the screen, as they are drawn, from where it is at the tick.
//   Vertices nearer than the near plane don't count.
// - Outline: what their representation says of their size on the screen and S. Of all.
// - Covering: the radius by which their points cover them. Of those who are drawn as points of their own; 0 without
// any.
void fill_offsets(const render::Frame& drawn, const Present& present, const apps::Stage& stage, const figures::Way& way,
                  Row& row);

}  // namespace bench::front
