#include "figures/way.h"

#include <cmath>

#include "figures/points.h"
#include "figures/splats.h"
#include "figures/triangles.h"

namespace figures {

namespace {

constexpr Way with_beliefs(Way way) {
    for (std::size_t kind = 0; kind < sfsm::work_kinds; ++kind)
        way.pieces[kind] = sfsm::work_table[kind].prior(way.drawing).pieces;
    return way;
}

}  // namespace

std::size_t points_worth(std::size_t triangle_count, const Way& way) {
    const auto pieces = [&](sfsm::WorkKind kind) { return way.pieces[sfsm::index_of(kind)]; };
    const double points_a_triangle = pieces(sfsm::WorkKind::triangle) / pieces(sfsm::WorkKind::point);
    const double count = std::floor(points_a_triangle * static_cast<double>(triangle_count));
    return count < static_cast<double>(way.most_points) ? static_cast<std::size_t>(count) : way.most_points;
}

const Way& by_opengl() {
    static constexpr Representation list[] = {triangles, points, splats};
    static constexpr Way way =
        with_beliefs({.drawing = sfsm::Drawing::opengl,
                      .representations = list,
                      .pieces = {},
                      .nearest = 0.0f,
                      .overhang = 0.5f,
                      .most_points = 16384,
                      .error = {.finest = 0.1134,
                                .growth = 0.1229,
                                .power = 0.449,
                                .blur = 0,
                                .hole = 0,
                                .filling = 1,
                                .mesh = 0.211,
                                .mesh_height = 32.62,
                                .mesh_power = 0.9953,
                                .splat = 0.08345,
                                .splat_growth = 0.0194,
                                .splat_blur = 0,
                                .splat_most = 0.1753,
                                .motion_growth = 0.03529,
                                .motion_most = 0.1323},
                      .effort = {.triangle = 1, .point = 2, .single = 48, .splat = 1.1, .update = 4, .resampling = 0},
                      .has_cells = false});
    return way;
}

const Way& natively() {
    static constexpr Representation list[] = {triangles, native_points, splats};
    static constexpr Way way = with_beliefs(
        {.drawing = sfsm::Drawing::native,
         .representations = list,
         .pieces = {},
         .nearest = 4.0f,
         .overhang = 0.0f,
         .most_points = 4096,
         .error = {.finest = 0.06768,
                   .growth = 0.0489,
                   .power = 0.725,
                   .blur = 1.5,
                   .hole = 0.3217,
                   .filling = 6.544,
                   .mesh = 0.1368,
                   .mesh_height = 29.26,
                   .mesh_power = 0.7894,
                   .splat = 0.05655,
                   .splat_growth = 0.01728,
                   .splat_blur = 0.2,
                   .splat_most = 0.3163,
                   .motion_growth = 0.03728,
                   .motion_most = 0.1398},
         .effort = {.triangle = 1, .point = 0.16, .single = 28, .splat = 3, .update = 1.2, .resampling = 0.57},
         .has_cells = true});
    return way;
}

}  // namespace figures
