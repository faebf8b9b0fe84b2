#include "tests/bench/loss/recipe.h"

#include <cmath>

#include "figures/points.h"
#include "render/exchange.h"
#include "sfsm/number_text.h"

namespace bench::loss {

namespace {

using sfsm::number_text;

Recipe points(double spacing, double cell) {
    return {.name = "points " + number_text(spacing) + " in " + number_text(cell), .spacing = spacing, .cell = cell};
}

Recipe splats(double cell) {
    return {.name = "splats in " + number_text(cell), .spacing = cell, .cell = cell, .as_splats = true};
}

void add_of_cells(std::vector<Recipe>& all) {
    for (const double spacing : {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 4.0}) all.push_back(points(spacing, 1));
    for (const double spacing : {1.4, 2.0, 2.8}) all.push_back(points(spacing, 1.68));
    for (const double spacing : {2.0, 2.8, 4.0}) all.push_back(points(spacing, 2.4));
    all.push_back(points(3.36, 3.36));
    for (const double cell : {1.0, 2.4}) all.push_back(splats(cell));
}

void add_motion(std::vector<Recipe>& all) {
    for (const int period : {6, 24}) all.push_back({.name = "every " + number_text(period), .period = period});
}

void add_rates(std::vector<Recipe>& all) {
    for (int step = 0; step < render::Exchange::steps; step += render::Exchange::steps_an_octave) {
        const double rate = render::Exchange::rate_of(step);
        all.push_back({.name = "rate " + number_text(rate), .rate = rate});
    }
}

}  // namespace

std::vector<Recipe> recipes(bool has_cells) {
    std::vector<Recipe> all = {{.name = "triangles"}};
    if (has_cells) {
        add_of_cells(all);
        add_motion(all);
    } else {
        for (const double spacing : {0.7, 1.4, 2.8}) all.push_back(points(spacing, 1));
        all.push_back(splats(1));
    }
    add_rates(all);
    return all;
}

render::DrawingRule::Shape RecipeRule::shape_of(const render::Subject& subject) const {
    const figures::Choices& choices = choices_[subject.character];
    if (!(recipe_.spacing > 0) || !std::isfinite(subject.surface)) return {choices.exact(), 0.0f};
    const float samples = subject.surface / static_cast<float>(recipe_.spacing * recipe_.spacing);
    return {choices.samples_at(samples), samples};
}

// Of a way without cells points are as large as they are apart, and a little more.
double RecipeRule::splat_size() const {
    constexpr double usual_density = 1.2;
    return way_.has_cells ? recipe_.cell / figures::cell_share : std::sqrt(usual_density) * recipe_.spacing;
}

}  // namespace bench::loss
