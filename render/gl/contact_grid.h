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
    struct Cells {
        int x0, x1, y0, y1;  // to the last
    };

    void choose_cells();
    void sort_into_cells();
    Cells cells_of(glm::vec2 low, glm::vec2 high) const;  // [m] camera-relative x, z
    template <typename Visit>
    void for_each_cell(const ContactShade& shade, Visit visit) const;

    std::vector<ContactShade> shades_;
    glm::vec2 corner_{0};  // [m] camera-relative x, z
    float cells_a_metre_ = 1;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> first_, numbers_;  // as contact_grid.glsl has them
    Buffer block_, cells_, feet_, sorted_;
};

}  // namespace render::gl
