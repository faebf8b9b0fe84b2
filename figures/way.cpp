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
                      .error = {.finest = 0.05,
                                .growth = 0.085,
                                .power = 0.95,
                                .blur = 0,
                                .hole = 0,
                                .filling = 1,
                                .mesh = 0.2,
                                .mesh_height = 14,
                                .mesh_power = 0.8,
                                .splat = 0.08,
                                .splat_growth = 0.025,
                                .splat_blur = 0,
                                .splat_most = 0.3,
                                .motion_growth = 0.08,
                                .motion_most = 0.3},
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
         .error = {.finest = 0.0258,
                   .growth = 0.087,
                   .power = 0.386,
                   .blur = 3.235,
                   .hole = 0.2435,
                   .filling = 6.33,
                   .mesh = 0.13,
                   .mesh_height = 14,
                   .mesh_power = 0.8,
                   .splat = 0.06,
                   .splat_growth = 0.024,
                   .splat_blur = 0.13,
                   .splat_most = 0.3,
                   .motion_growth = 0.08,
                   .motion_most = 0.3},
         .effort = {.triangle = 1, .point = 0.24, .single = 34, .splat = 3, .update = 1.2, .resampling = 0.57},
         .has_cells = true});
    return way;
}

}  // namespace figures
