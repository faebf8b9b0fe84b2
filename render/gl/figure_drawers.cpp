#include <cassert>

#include "figures/representation.h"
#include "render/gl/figure_drawer.h"

namespace render::gl {

std::vector<std::unique_ptr<FigureDrawer>> make_figure_drawers() {
    std::vector<std::unique_ptr<FigureDrawer>> drawers;
    drawers.push_back(make_triangle_drawer());
    drawers.push_back(make_point_drawer());
    assert(drawers.size() == figures::representations().size());
    return drawers;
}

}  // namespace render::gl
