// The stadium drawn both ways: as the product does, from the selector to the pixels, and by the reference.
#pragma once

#include <memory>

#include "render/gl/renderer.h"
#include "render/select.h"
#include "tests/reference/picture.h"
#include "tests/render/small_scene.h"

namespace reference {

struct Frame {
    render::Image drawn;
    Picture expected;
};

// Needs a current context.
class Stadium {
public:
    Stadium(const tests::SmallScene& scene, int width, int height);

    Frame shoot(const scene::CameraPose& pose, const sfsm::Decision& decision, std::int64_t tick);
    scene::CameraPose preset(const char* name, double seconds = 0) const {
        return scene::aim_cameras(scene_.plan).named(name).at(seconds);
    }

private:
    const tests::SmallScene& scene_;
    int width_, height_;  // [px]
    scene::StaticMesh structure_;
    std::vector<Figure> figures_;
    render::gl::Renderer renderer_;
    render::Selector selector_;
};

}  // namespace reference
