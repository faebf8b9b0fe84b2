#include "figures/way.h"

#include <cmath>

#include "figures/points.h"
#include "figures/splats.h"
#include "figures/triangles.h"

namespace figures {

namespace {

constexpr Way way_of(sfsm::Drawing drawing, std::span<const Representation> representations, float nearest,
                     float overhang, std::size_t most_points) {
    Way way{drawing, representations, {}, nearest, overhang, most_points};
    for (std::size_t kind = 0; kind < sfsm::work_kinds; ++kind)
        way.pieces[kind] = sfsm::work_table[kind].prior(drawing).pieces;
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
    static constexpr Way way = way_of(sfsm::Drawing::opengl, list, 0.0f, 0.5f, 16384);
    return way;
}

const Way& natively() {
    static constexpr Representation list[] = {triangles, native_points, splats};
    static constexpr Way way = way_of(sfsm::Drawing::native, list, 4.0f, 0.0f, 4096);
    return way;
}

}  // namespace figures
