// The stadium drawn both ways: as the product does, from the selector to the pixels, and by the reference.
#pragma once

#include <memory>

#include "figures/way.h"
#include "render/renderer.h"
#include "render/select.h"
#include "tests/reference/picture.h"
#include "tests/render/small_scene.h"

namespace reference {

struct Frame {
    render::Image drawn;
    Picture expected;
};

// By OpenGL it needs a current context. By the processor, whoever is points is expected to look as their triangles do.
class Stadium {
public:
    Stadium(const tests::SmallScene& scene, int width, int height, const figures::Way& way = figures::by_opengl());

    // `darken`: whether the reference has people darken what they stand on.
    Frame shoot(const scene::CameraPose& pose, const sfsm::Decision& decision, std::int64_t tick, bool darken = true);
    // From a few metres at some of those on the track, at that time.
    std::vector<scene::CameraPose> at_feet(std::int64_t tick) const;
    scene::CameraPose preset(const char* name, double seconds = 0) const {
        return scene::aim_cameras(scene_.plan).named(name).at(seconds);
    }

private:
    static render::SelectOptions options_of(const figures::Way& way) {
        render::SelectOptions options;
        options.way = &way;
        return options;
    }

    const tests::SmallScene& scene_;
    int width_, height_;  // [px]
    const figures::Way& way_;
    scene::StaticMesh structure_;
    std::vector<Figure> figures_;
    std::unique_ptr<render::Renderer> renderer_;
    render::Selector selector_;
};

}  // namespace reference
