// What the shaders' functions read of a frame, for whoever runs them: shaders/layout.h's Frame.
#pragma once

#include "render/view.h"
#include "scene/ground.h"
#include "scene/light.h"
#include "shaders/layout.h"

namespace render {

// `splat_size` in px, at least 1.
FrameBlock make_frame_block(const View& view, const scene::Ground& ground, const scene::Light& light, float splat_size);

}  // namespace render
