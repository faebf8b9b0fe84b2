// The demo's stadium drawn both ways in one process, frame by frame as the demo does.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "apps/stage.h"
#include "render/gl/headless.h"
#include "render/gl/renderer.h"
#include "render/native/renderer.h"
#include "render/select.h"

namespace bench {

inline constexpr int frame_width = 1280, frame_height = 720;  // [px]
inline constexpr int reference_factor = 4;                    // samples a pixel, in both directions

// Everybody moves in every frame.
sfsm::Decision triangles();
sfsm::Decision points_of(double splat_size);  // [px]; 0: triangles

// A renderer and whom it draws.
class Shooter {
public:
    // All must outlive the shooter. `density`: SelectOptions::density.
    Shooter(render::Renderer& renderer, const scene::Crowd& crowd, const apps::Stage& stage, const figures::Way& way,
            float density = render::SelectOptions{}.density);

    // The two steps of a frame before it is drawn; what they return is valid until the next.
    const render::Survey& survey(const render::View& view, std::int64_t tick);
    const render::Frame& select(const sfsm::Decision& decision, std::int64_t tick);
    const render::Frame& select(const render::DrawingRule& rule, std::int64_t tick);

    // The frame, which is drawn when this returns.
    const render::Frame& shoot(const render::View& view, const sfsm::Decision& decision, std::int64_t tick);
    // The same without the draw.
    const render::Frame& choose(const render::View& view, const sfsm::Decision& decision, std::int64_t tick);
    void draw(const render::Frame& frame);

    // Resizes to the view's size.
    render::Image picture(const render::View& view, const sfsm::Decision& decision, std::int64_t tick);

private:
    render::Renderer& renderer_;
    render::Selector selector_;
    bool needs_finish_;
};

// A crowd drawn both ways before a place.
struct Shooting {
    const apps::Stage& stage;
    scene::Crowd nobody;
    render::native::Renderer native_renderer;
    render::gl::Renderer gl_renderer;
    Shooter native, native_nobody, gl, gl_nobody;

    // `crowd` and `stage` must outlive it. Needs a current context.
    Shooting(const apps::Stage& stage, const scene::Crowd& crowd, const scene::StaticMesh& structure,
             const scene::Ground& ground, const scene::Light& light);
};

// The 16-sample picture: triangles by OpenGL, 4 times as wide and high, box-filtered in linear light.
render::Image reference(Shooter& gl, const scene::CameraPose& pose, int width, int height, std::int64_t tick);

// 20,000 people. Made when first asked for, once.
Shooting& stadium();

scene::CameraPose preset(std::string_view name);

// Turned about the vertical until the middle of a picture of that height has moved by so many pixels.
scene::CameraPose panned(scene::CameraPose pose, double pixels, int height);

// Some of a crowd, in their order, as one block.
scene::Crowd some_of(const scene::Crowd& crowd, std::uint32_t first, std::uint32_t count);

// A block of some two hundred who all sit, in front of the main stand.
scene::CrowdBlock seated_block(const scene::Crowd& crowd);

}  // namespace bench
