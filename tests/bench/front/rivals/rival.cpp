#include "tests/bench/front/rivals/rival.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "figures/points.h"
#include "sfsm/prices.h"

namespace bench::front {

namespace {

const figures::Way& way() {
    return figures::natively();
}

bool is_mesh(const figures::Choice& choice) {
    return way().representations[choice.representation].is_mesh;
}

// [px] A mean over all who are drawn as points: the side of a square as large as the surface that a point stands for.
double mean_spacing(const Rival& rival, std::span<const render::Subject> people) {
    double surface = 0, points = 0;
    for (const render::Subject& subject : people) {
        const float each = rival.points_of(subject);
        if (!std::isfinite(each)) continue;
        surface += static_cast<double>(subject.surface);
        points += static_cast<double>(std::max(each, static_cast<float>(figures::fewest_points)));
    }
    return points > 0 ? std::sqrt(surface / points) : 0;
}

// [px] S for points so far apart: cells that they fill and that blur as little as may be.
double splat_size_for(double spacing) {
    constexpr double close = 2, cells_a_spacing = 0.75, most = 2.85;
    return spacing > close ? std::min(cells_a_spacing * spacing / figures::cell_share, most) : 1;
}

}  // namespace

Cast cast_of(std::span<const figures::Figure> figures) {
    Cast cast;
    for (const figures::Figure& figure : figures) cast.emplace_back(figure, way());
    return cast;
}

void Rival::settle(std::vector<render::Subject> people) {
    const auto rank = [](const render::Subject& subject) {
        return std::tuple(subject.surface, subject.character, subject.depth);
    };
    std::ranges::sort(people, {}, rank);
    decide(people);
    splat_size_ = splat_size_for(mean_spacing(*this, people));
}

render::DrawingRule::Shape Rival::shape_of(const render::Subject& subject) const {
    const float points = points_of(subject);
    if (!std::isfinite(points)) return {choices_of(subject).exact(), 0.0f};
    return {choices_of(subject).samples_at(points), points};
}

bool Rival::is_splat(const render::Subject& subject) const {
    return subject.demand <= choices_of(subject).block_reach();
}

Rival::Detail Rival::full_of(const render::Subject& subject) const {
    constexpr float splat_area = 0.25f;  // [px^2]
    const float demand = subject.demand / splat_area;
    const figures::Choice& choice = choices_of(subject).all()[choices_of(subject).at(demand)];
    if (!is_mesh(choice)) return {figures::part_of(choice.level, demand).count * 1.0, false};
    const double point = way().pieces[sfsm::index_of(sfsm::WorkKind::point)];
    return {std::floor(sfsm::cost_of(choice.level.work, {0, way().pieces}) / point), true};
}

double Rival::least_of(const Detail& full) {
    constexpr double floor = 16;  // points
    return std::min(full.points, floor);
}

}  // namespace bench::front
