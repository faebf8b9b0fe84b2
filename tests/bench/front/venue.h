// A crowd in the demo's stadium, ready to be drawn in every way.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "apps/stage.h"
#include "render/gl/renderer.h"
#include "render/native/renderer.h"
#include "sfsm/drawing.h"
#include "tests/bench/shooter.h"

namespace bench::front {

struct Size {
    int width = frame_width, height = frame_height;  // [px]
};

class Venue {
public:
    // `with_opengl`: a context is current, and stays so. Throws what apps::build_stage throws.
    Venue(std::int64_t people, Size size, bool with_opengl);

    std::int64_t people() const { return static_cast<std::int64_t>(stage_->place.crowd.size()); }
    Size size() const { return size_; }
    const apps::Stage& stage() const { return *stage_; }
    render::Renderer& renderer(sfsm::Drawing drawing);

    // Made when first asked for, and kept.
    Shooter& shooter(sfsm::Drawing drawing, float density = render::SelectOptions{}.density);
    Shooter& nobody();  // natively

    // Of all that determines a picture of triangles, but for the camera, the tick and the size: the crowd, and what the
    // renderer makes of a small picture of it.
    const std::string& key();

private:
    std::string find_key();

    Size size_;
    std::unique_ptr<apps::Stage> stage_;
    scene::Crowd empty_;
    render::native::Renderer native_;
    std::unique_ptr<render::gl::Renderer> gl_;
    std::map<std::pair<sfsm::Drawing, float>, std::unique_ptr<Shooter>> shooters_;
    std::unique_ptr<Shooter> nobody_;
    std::string key_;
};

}  // namespace bench::front
