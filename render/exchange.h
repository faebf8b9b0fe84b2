// The one rule by which people are drawn: each so that the next piece of work would save less error than the rate asks.
//
// Somebody whose surface covers a pixels of the screen (a quarter of it as a silhouette), of which a share v shows,
// costs
//   J = v * a / 4 * error + rate * work
// as points that are d pixels apart: error(d), work = point * a / d^2 + single; as a mesh: error(height), its
// triangles; with their block as one splat: error(height), next to none. Of these the least is taken. The best d
// depends on rate / v alone, not on who it is; a mesh is best from some size on, and a splat up to one. So the rule is
// three tables over rates and shares, made once, and everybody with the same looks looks up the same.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "figures/choices.h"
#include "figures/figure.h"

namespace render {

class Exchange {
public:
    static constexpr int steps = 30, steps_an_octave = 2;  // of the rate
    static constexpr int shares = 9;                       // half octaves of v, from 1 down
    static double rate_of(int step);                       // [px / piece], of a step in [0, steps)
    static float share_of(int place);                      // v
    // [px] of height: rows of taller ones show as stripes, which the eye finds at once and FLIP hardly minds.
    static constexpr double tallest_splat = 4.5;

    // A place among the shares, [0, shares - 1]: whole numbers are share_of().
    static float place_of(float share);

    struct Kind {
        const figures::Choices* choices = nullptr;
        double area = 0, height = 0;  // of the character's surface [model units^2], and standing [model units]
    };

    Exchange() = default;
    // `way` is only asked here.
    Exchange(std::span<const Kind> kinds, const figures::Way& way);

    // [px] Sides of cells that points may be added up in; the first alone of a way without cells. In larger ones a far
    // crowd is a smear, to the eye much more than to FLIP.
    static constexpr std::array cell_sides = {1.0, 1.68, 2.4};
    std::span<const double> cells() const { return cells_; }

    // What holds at a rate, in cells of a size.
    struct Terms {
        float cell = 1;     // [px]
        float spacing = 1;  // [px] of the points of a frame whose points are all alike
        // log2 of: the spacing [px], by share; of each kind, by share: surfaces [px^2] from which they are meshes, and
        // up to which they are splats.
        std::array<float, shares> spacings{};
        std::vector<float> meshes_from, splats_to;

        struct Sizes {
            float spacing;    // [px]
            float mesh_from;  // [px^2]
            float splat_to;   // [px^2]
        };
        Sizes sizes(std::size_t kind, float place) const;
    };
    const Terms& at_step(int step, std::size_t cell) const {
        return terms_[cell * steps + static_cast<std::size_t>(step)];
    }
    // Between steps; a rate beyond them counts as the nearest.
    void find_terms(double rate, std::size_t cell, Terms& terms) const;
    static int step_below(double rate);  // the last whose rate is no more, or the first

private:
    void add_terms(std::span<const Kind> kinds, const figures::Way& way, double rate, double cell);

    std::span<const double> cells_;  // of cell_sides
    std::vector<Terms> terms_;       // by cell, then step
};

}  // namespace render
