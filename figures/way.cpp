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
                      .error = {.finest = 0.2534,
                                .growth = 0.01274,
                                .power = 1.186,
                                .blur = 0,
                                .hole = 0,
                                .filling = 1,
                                .mesh = 0.2718,
                                .mesh_height = 20.13,
                                .mesh_power = 0.9556,
                                .splat = 0.08756,
                                .splat_growth = 0.02037,
                                .splat_blur = 0,
                                .splat_most = 0.1818,
                                .motion_growth = 0.03536,
                                .motion_most = 0.1326},
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
         .error = {.finest = 0.09982,
                   .growth = 0.01939,
                   .power = 0.9093,
                   .blur = 3.028,
                   .hole = 0.2913,
                   .filling = 6.029,
                   .mesh = 0.2337,
                   .mesh_height = 5.99,
                   .mesh_power = 0.6643,
                   .splat = 0.08663,
                   .splat_growth = 0.01122,
                   .splat_blur = 0.2067,
                   .splat_most = 0.3,
                   .motion_growth = 0.03536,
                   .motion_most = 0.1326},
         .effort = {.triangle = 1, .point = 0.24, .single = 34, .splat = 3, .update = 1.2, .resampling = 0.57},
         .has_cells = true});
    return way;
}

}  // namespace figures
