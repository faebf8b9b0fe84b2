// People's shades (render/contact_shade.h) where the shaders of what is darkened find them: by the cell of a level grid
// that a place is in, so that what a pixel costs doesn't depend on how many people there are.
#pragma once

#include <cstdint>
#include <vector>

#include "render/contact_shade.h"
#include "render/gl/objects.h"
#include "render/view.h"

namespace render::gl {

class ContactGrid {
public:
    ContactGrid();

    // Uploads a frame's, and binds them.
    void fill(const Frame& frame);

    // Whether any may darken something in a box told from the origin of `view`, the last frame's.
    bool touches(const View& view, const motion::Bounds& box) const;

private:
    void choose_cells();
    template <typename Visit>
    void for_each_cell(const ContactShade& shade, Visit visit) const;

    std::vector<ContactShade> shades_;
    glm::vec2 corner_{0};  // [m] camera-relative x, z
    float cells_a_metre_ = 1;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> first_;
    std::vector<glm::vec4> feet_;  // two a shade: contact_grid.glsl's Feet
    Buffer block_, cells_, sorted_;
};

}  // namespace render::gl
