// Who shows in each pixel of a view, roughly: by a depth buffer of everybody's triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/stage.h"
#include "render/view.h"
#include "tests/bench/front/offsets.h"

namespace bench::loss {

inline constexpr std::int32_t nobody = -1;

// By pixel, rows from the top: into Present::people. Of whom is lower than some pixels the vertices stand for the
// triangles. A pixel in which no triangle's middle lies belongs to whom is in front beside it, `fringe` pixels far.
std::vector<std::int32_t> in_front(const front::Present& present, const apps::Stage& stage, const render::View& view);

}  // namespace bench::loss
