#include "render/frame_block.h"

#include <algorithm>

namespace render {

static_assert(sizeof(FrameBlock::ground_parameters) == sizeof(scene::Ground::parameters));

FrameBlock make_frame_block(const View& view, const scene::Ground& ground, const scene::Light& light,
                            float splat_size) {
    FrameBlock frame;
    frame.clip_from_camera_relative = view.clip_from_camera_relative;
    frame.camera_position = glm::vec4(glm::vec3(view.position), 0.0f);
    frame.sun_direction = glm::vec4(light.to_sun, 0.0f);
    frame.sun_color = glm::vec4(light.sun, 0.0f);
    frame.sky_light = glm::vec4(light.from_above, 0.0f);
    frame.ground_light = glm::vec4(light.from_below, 0.0f);
    frame.sky_haze = glm::vec4(light.haze, 0.0f);
    frame.sky_zenith = glm::vec4(light.zenith, 0.0f);
    frame.sky_glare = glm::vec4(light.glare, 0.0f);
    frame.view_right = glm::vec4(view.right * view.tan_half_x, 0.0f);
    frame.view_up = glm::vec4(view.up * view.tan_half_y, 0.0f);
    frame.view_forward = glm::vec4(view.forward, 0.0f);
    std::copy(ground.parameters.begin(), ground.parameters.end(), frame.ground_parameters);
    frame.splat = glm::vec4(splat_size, view.pixels_per_metre(1.0f), 0.0f, 0.0f);
    return frame;
}

}  // namespace render
