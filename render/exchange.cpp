#include "render/exchange.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace render {

namespace {

constexpr double first_rate = 0x1p-14, steps_per_octave = Exchange::steps_an_octave, shares_per_octave = 2;
constexpr int usual_share = 3;  // of a stand: a third of each of its people shows

// The least of a function over octaves from `first` to `last`: the best of a grid, then by golden section beside it.
template <typename Function>
double least_at(double first, double last, const Function& function) {
    constexpr double step = 0.125, golden = 0.618033988749895;
    double best = first, least = std::numeric_limits<double>::infinity();
    for (double at = first; at <= last; at += step) {
        const double value = function(std::exp2(at));
        if (value < least) least = value, best = at;
    }
    double low = std::max(best - step, first), high = std::min(best + step, last);
    for (int i = 0; i < 16; ++i) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (function(std::exp2(a)) <= function(std::exp2(b)))
            high = b;
        else
            low = a;
    }
    return 0.5 * (low + high);
}

// Where a condition that holds for all small sizes ceases to [octaves of px^2].
template <typename Holds>
double holds_until(const Holds& holds) {
    double low = -8, high = 26;
    if (!holds(std::exp2(low))) return low;
    if (holds(std::exp2(high))) return high;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (low + high);
        (holds(std::exp2(middle)) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// What one person of a surface [px^2] costs, all of whom shows [px].
struct Costs {
    const figures::Way& way;
    const Exchange::Kind& kind;
    double rate;  // over the share that shows
    double cell, spacing;

    double height(double surface) const { return kind.height * std::sqrt(surface / kind.area); }
    double as_points(double surface) const {
        const double most = static_cast<double>(kind.choices->most_samples());
        if (!(most > 0)) return std::numeric_limits<double>::infinity();
        const double count =
            std::clamp(surface / (spacing * spacing), std::min<double>(figures::fewest_points, most), most);
        return surface / 4 * way.error.of_points(std::sqrt(surface / count), cell) +
               rate * (way.effort.single + way.effort.point * count);
    }
    double as_mesh(double surface) const {
        const auto triangles =
            static_cast<double>(kind.choices->all()[kind.choices->exact()].level.work[sfsm::WorkKind::triangle]);
        return surface / 4 * way.error.of_mesh(height(surface)) +
               rate * (way.effort.single + way.effort.triangle * triangles);
    }
    double as_splat(double surface) const {
        return surface / 4 * way.error.of_splat(height(surface)) * way.error.times_in_cells(cell) +
               rate * way.effort.splat;
    }
};

double best_spacing(const figures::Way& way, double rate, double cell) {
    return least_at(-1.75, 4, [&](double spacing) {
        return way.error.of_points(spacing, cell) + 4 * rate * way.effort.point / (spacing * spacing);
    });
}

// From the first step on; of what is no rate 0.
double steps_at(double rate) {
    const double at = steps_per_octave * std::log2(rate / first_rate);
    return at > 0 ? std::min(at, Exchange::steps - 1.0) : 0;
}

float between(float a, float b, float share) {
    return a + share * (b - a);
}

}  // namespace

double Exchange::rate_of(int step) {
    assert(step >= 0 && step < steps);
    static const auto rates = [] {
        constexpr double digits = 1e7;  // traces keep them all
        std::array<double, steps> all{};
        for (int i = 0; i < steps; ++i)
            all[static_cast<std::size_t>(i)] =
                std::round(digits * first_rate * std::exp2(i / steps_per_octave)) / digits;
        return all;
    }();
    return rates[static_cast<std::size_t>(step)];
}

float Exchange::share_of(int place) {
    return static_cast<float>(std::exp2(-place / shares_per_octave));
}

float Exchange::place_of(float share) {
    const float place = -static_cast<float>(shares_per_octave) * std::log2(share);
    return place > 0 ? std::min(place, static_cast<float>(shares - 1)) : 0.0f;
}

Exchange::Exchange(std::span<const Kind> kinds, const figures::Way& way)
    : cells_(std::span(cell_sides).first(way.has_cells ? cell_sides.size() : 1)) {
    for (const double cell : cells_)
        for (int step = 0; step < steps; ++step) add_terms(kinds, way, rate_of(step), cell);
}

void Exchange::add_terms(std::span<const Kind> kinds, const figures::Way& way, double rate, double cell) {
    Terms& terms = terms_.emplace_back();
    const double usual_rate = rate / static_cast<double>(share_of(usual_share));
    terms.cell = static_cast<float>(cell);
    const double usual_spacing = best_spacing(way, usual_rate, cell);
    terms.spacing = static_cast<float>(std::exp2(usual_spacing));
    for (int place = 0; place < shares; ++place) {
        const double seen_rate = rate / static_cast<double>(share_of(place));
        const double spacing = way.has_cells ? best_spacing(way, seen_rate, cell) : usual_spacing;
        terms.spacings[static_cast<std::size_t>(place)] = static_cast<float>(spacing);
        for (const Kind& kind : kinds) {
            const Costs costs{way, kind, seen_rate, cell, std::exp2(spacing)};
            const double mesh_from =
                holds_until([&](double surface) { return costs.as_points(surface) < costs.as_mesh(surface); });
            const double splat_to = holds_until([&](double surface) {
                return costs.as_splat(surface) <= std::min(costs.as_points(surface), costs.as_mesh(surface));
            });
            const bool has_splat = kind.choices->block_reach() >= 0;
            const double tallest = std::log2(kind.area * tallest_splat * tallest_splat / (kind.height * kind.height));
            terms.meshes_from.push_back(static_cast<float>(mesh_from));
            terms.splats_to.push_back(has_splat ? static_cast<float>(std::min(splat_to, tallest)) : -126.0f);
        }
    }
}

Exchange::Terms::Sizes Exchange::Terms::sizes(std::size_t kind, float place) const {
    const auto low = std::min(static_cast<std::size_t>(place), std::size_t{shares - 2});
    const float share = place - static_cast<float>(low);
    const std::size_t kinds = meshes_from.size() / shares;
    const auto of_kind = [&](const std::vector<float>& table) {
        return std::exp2(between(table[low * kinds + kind], table[(low + 1) * kinds + kind], share));
    };
    return {std::exp2(between(spacings[low], spacings[low + 1], share)), of_kind(meshes_from), of_kind(splats_to)};
}

// Rates of steps are rounded: none may be missed for that.
int Exchange::step_below(double rate) {
    constexpr double rounding = 2e-3;
    return static_cast<int>(steps_at(rate) + rounding);
}

void Exchange::find_terms(double rate, std::size_t cell, Terms& terms) const {
    const double at = steps_at(rate);
    const int low = std::min(static_cast<int>(at), steps - 2);
    const auto share = static_cast<float>(at - low);
    const Terms &a = at_step(low, cell), &b = at_step(low + 1, cell);
    const auto mix = [&](const auto& from, const auto& to, auto& out) {
        for (std::size_t i = 0; i < from.size(); ++i) out[i] = between(from[i], to[i], share);
    };
    terms.cell = a.cell;
    terms.spacing = between(a.spacing, b.spacing, share);
    terms.meshes_from.resize(a.meshes_from.size());
    terms.splats_to.resize(a.splats_to.size());
    mix(a.spacings, b.spacings, terms.spacings);
    mix(a.meshes_from, b.meshes_from, terms.meshes_from);
    mix(a.splats_to, b.splats_to, terms.splats_to);
}

}  // namespace render
