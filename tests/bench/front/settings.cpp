#include "tests/bench/front/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <utility>

#include "render/exchange.h"
#include "sfsm/number_text.h"
#include "tests/bench/front/marks.h"
#include "tests/bench/front/rivals/by_distance.h"
#include "tests/bench/front/rivals/largest_first.h"
#include "tests/bench/front/rivals/smallest_demoted.h"

namespace bench::front {

namespace {

using sfsm::Drawing;
using sfsm::number_text;
using sfsm::State;

constexpr double usual_density = 1.2;

std::string as_splats(double splat_size) {
    return "S = " + number_text(splat_size);
}

std::string as_share(double motion_share) {
    return "D = " + number_text(motion_share) + " L";
}

Where where(bool everywhere) {
    return everywhere ? Where::everywhere : Where::at_presets;
}

void add_triangles(std::vector<Setting>& all) {
    all.push_back({.family = "native triangles", .name = "4 samples"});
    for (const int factor : {1, 2})
        all.push_back({.family = "OpenGL triangles",
                       .name = factor == 1 ? "1 sample" : "4 samples",
                       .drawing = Drawing::opengl,
                       .factor = factor,
                       .where = Where::at_presets});
}

// A curve for each density: points a splat-sized square.
void add_points(std::vector<Setting>& all) {
    const auto add = [&](const std::string& family, Drawing drawing, double density, double splat_size,
                         bool everywhere) {
        all.push_back({.family = family,
                       .name = as_splats(splat_size),
                       .drawing = drawing,
                       .state = State::points,
                       .splat_size = splat_size,
                       .density = static_cast<float>(density),
                       .where = where(everywhere)});
    };
    for (const double size : {0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0})
        add("native points", Drawing::native, usual_density, size, size >= 0.7 && size <= 4 && size != 2.8);
    for (const double density : {0.6, 2.4})
        for (const double size : {0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6})
            add("native points (density " + number_text(density) + ")", Drawing::native, density, size, false);
    for (const double size : {1.0, 1.4, 2.0, 2.8, 4.0})
        add("OpenGL points", Drawing::opengl, usual_density, size, size == 2);
}

void add_motion(std::vector<Setting>& all) {
    for (const double share : {0.05, 0.25, 0.5, 0.75})
        all.push_back({.family = "native motion",
                       .name = as_share(share),
                       .state = State::slowed,
                       .motion_share = share,
                       .where = where(share == 0.25)});
    for (const double share : {0.25, 0.75})
        for (const double size : {1.0, 2.0, 4.0})
            all.push_back({.family = "native mixture",
                           .name = as_share(share) + ", " + as_splats(size),
                           .state = State::points,
                           .motion_share = share,
                           .splat_size = size,
                           .where = where(share == 0.25 && size == 2)});
}

// An octave apart; which every law that decides by rates has between them too.
void add_rates(std::vector<Setting>& all) {
    constexpr int octave = render::Exchange::steps_an_octave;
    for (int step = 0; step < render::Exchange::steps; step += octave) {
        const double rate = render::Exchange::rate_of(step);
        all.push_back({.family = "native rates",
                       .name = rate_name(rate),
                       .state = State::points,
                       .rate = rate,
                       .where = where(step % (2 * octave) == 0)});
    }
}

void add_rival(std::vector<Setting>& all, const std::string& family, const std::string& name,
               std::function<std::unique_ptr<Rival>(Cast)> make) {
    all.push_back({.family = family,
                   .name = name,
                   .state = State::points,
                   .rival = std::move(make),
                   .where = Where::at_marked_presets});
}

// From coarse to fine.
void add_distances(std::vector<Setting>& all) {
    constexpr ByDistance::Distances grid[] = {{0, 10, 50},     {10, 20, 100},    {20, 40, 200},
                                              {30, 80, 400},   {40, 80, 800},    {60, 160, 800},
                                              {80, 320, 1600}, {160, 640, 3200}, {320, 1280, 6400}};
    for (const ByDistance::Distances& at : grid)
        add_rival(
            all, "rival: by distance",
            number_text(at.meshes_to) + ", " + number_text(at.points_to) + ", " + number_text(at.splats_from) + " m",
            [at](Cast cast) { return std::make_unique<ByDistance>(std::move(cast), at); });
}

template <typename Rule>
void add_budgets(std::vector<Setting>& all, const std::string& family) {
    for (const int thousands : {50, 100, 200, 400, 800, 1600, 3200})
        add_rival(all, family, std::to_string(thousands) + " k points",
                  [thousands](Cast cast) { return std::make_unique<Rule>(std::move(cast), 1000.0 * thousands); });
}

std::vector<Setting> register_all() {
    std::vector<Setting> all;
    add_triangles(all);
    add_points(all);
    add_motion(all);
    add_rates(all);
    add_distances(all);
    add_budgets<LargestFirst>(all, "rival: budget, largest first");
    add_budgets<SmallestDemoted>(all, "rival: budget, smallest demoted");
    return all;
}

}  // namespace

sfsm::Decision Setting::decision(double range) const {
    if (state == State::original) return {};
    return {state, motion_share * range, splat_size, rate};
}

int Setting::samples() const {
    constexpr int native_samples = 4;  // render/native/near_layer.h
    return (drawing == Drawing::native ? native_samples : 1) * factor * factor;
}

std::string rate_name(double rate) {
    char text[32];
    std::snprintf(text, sizeof text, "rate = %.3g", rate);
    return text;
}

const figures::Way& way_of(Drawing drawing) {
    return drawing == Drawing::native ? figures::natively() : figures::by_opengl();
}

std::span<const Setting> settings() {
    static const std::vector<Setting> all = register_all();
    return all;
}

bool is_measured(const Setting& setting, std::int64_t people, const std::string& view, bool is_preset) {
    if (!is_preset && setting.where != Where::everywhere) return false;
    if (setting.where == Where::at_marked_presets && !is_marked(people)) return false;
    const bool is_dear = setting.drawing == Drawing::opengl && setting.state == State::original;
    return !is_dear || people <= most_for_opengl_triangles || (view == "close" && setting.factor == 1);
}

}  // namespace bench::front
