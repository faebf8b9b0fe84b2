#include <array>
#include <cassert>

#include "figures/way.h"
#include "render/gl/figure_drawer.h"

namespace render::gl {

// Each in the file of its representation.
std::unique_ptr<FigureDrawer> make_triangle_drawer();
std::unique_ptr<FigureDrawer> make_point_drawer();

std::vector<std::unique_ptr<FigureDrawer>> make_figure_drawers() {
    constexpr auto makers = std::to_array({make_triangle_drawer, make_point_drawer});
    std::vector<std::unique_ptr<FigureDrawer>> drawers;
    for (const auto make : makers) drawers.push_back(make());
    assert(drawers.size() == figures::by_opengl().representations.size());
    return drawers;
}

}  // namespace render::gl
