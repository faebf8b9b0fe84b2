// A contact sheet of characters: what somebody opens first with a new file.
#pragma once

#include <vector>

#include "apps/troupe.h"
#include "render/image.h"

namespace apps {

struct Gallery {
    render::Image sheet;
    int failed = 0;  // files that could not be drawn
};

// Each character in each of its roles, a quarter into the clip that it plays there: from the front and from its left,
// as triangles and as points side by side, on tiles of half a metre, on a seat if it sits, beside a pole that is as
// high as the person is meant to be. Drawn by the processor alone, as people are in the stadium. A file that can't be
// drawn is named in its place and on stderr.
Gallery draw_gallery(const std::vector<CharacterFile>& characters, const Preparation& preparation);

}  // namespace apps
