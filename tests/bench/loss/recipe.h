// Ways to draw everybody alike, from which errors are learned one kind at a time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/stage.h"
#include "figures/choices.h"
#include "render/drawing_rule.h"

namespace bench::loss {

struct Recipe {
    std::string name;
    double spacing = 0;      // [px] of points; 0: triangles
    double cell = 1;         // [px] that points are added up in
    bool as_splats = false;  // whoever may be drawn with their block is; others by points
    int period = 1;          // [ticks] from a move to the next
    double rate = 0;         // Decision::rate; over 0: the exchange decides instead of all of the above
};

// Triangles, points, splats, motion, rates: of a way with cells; of one without, fewer.
std::vector<Recipe> recipes(bool has_cells);

// Everybody by a recipe that isn't of a rate.
class RecipeRule final : public render::DrawingRule {
public:
    // All must outlive it.
    RecipeRule(const Recipe& recipe, std::span<const figures::Choices> choices, const figures::Way& way)
        : recipe_(recipe), choices_(choices), way_(way) {}

    Shape shape_of(const render::Subject& subject) const override;
    bool is_splat(const render::Subject&) const override { return recipe_.as_splats; }
    int period_of(const render::Subject&) const override { return recipe_.period; }
    double splat_size() const override;

private:
    const Recipe& recipe_;
    std::span<const figures::Choices> choices_;
    const figures::Way& way_;
};

}  // namespace bench::loss
