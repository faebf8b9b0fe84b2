// figures/splats.h by GL's points: people of far blocks, straight from buffers that hold the whole crowd.
#pragma once

#include <span>
#include <vector>

#include "figures/figure.h"
#include "render/frame.h"
#include "render/gl/objects.h"
#include "scene/light.h"

namespace render::gl {

class FarDrawer {
public:
    // `figures` in the order of Crowd::character; they must outlive it.
    FarDrawer(std::span<const figures::Figure> figures, const scene::Light& light);

    // The far blocks of a frame, whose uniform block is bound. What it draws from is made when it is first needed.
    void draw(const Frame& frame);

private:
    void look_at_figures();
    void upload_crowd(const FarPeople& people);
    const glm::dvec3& origin_of(const FarBlock& block) const;
    // All of one origin, from which the camera is at `eye` [m].
    void draw_from(glm::vec3 eye, std::span<const FarBlock> blocks);

    std::vector<figures::Figure> figures_;
    scene::Light light_;
    Program program_;
    TextureObject looks_;
    const scene::Crowd* crowd_ = nullptr;  // whom the buffers hold
    VertexArray array_;
    Buffer people_, keys_;
    std::vector<GLint> first_;
    std::vector<GLsizei> count_;
};

}  // namespace render::gl
