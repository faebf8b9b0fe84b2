#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

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
    assert(static_cast<std::ptrdiff_t>(drawers.size()) ==
           std::ranges::count(figures::by_opengl().representations, false, &figures::Representation::is_by_block));
    return drawers;
}

}  // namespace render::gl
