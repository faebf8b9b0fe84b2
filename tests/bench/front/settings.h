// The ways to draw that are compared: every one that exists, by all that can be set of it.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "figures/way.h"
#include "render/select.h"
#include "sfsm/decision.h"
#include "sfsm/drawing.h"
#include "tests/bench/front/rivals/rival.h"

namespace bench::front {

// In which views a setting is measured.
enum class Where { everywhere, at_presets, at_marked_presets };

struct Setting {
    std::string family, name;  // Row::family, Row::setting
    sfsm::Drawing drawing = sfsm::Drawing::native;
    sfsm::State state = sfsm::State::original;
    // D in shares of L, the depth of the farthest who is visible, since it is that share that says who moves less
    // often.
    double motion_share = std::numeric_limits<double>::infinity();
    double splat_size = 0;  // S [px]
    float density = render::SelectOptions{}.density;
    double rate = 0;                                      // sfsm::Decision's, which then decides alone
    std::function<std::unique_ptr<Rival>(Cast)> rival{};  // empty: none; else it decides, natively, and nothing above
    int factor = 1;  // a picture is drawn so many times as wide and high, and box-filtered; the time is of drawing it
    Where where = Where::everywhere;

    // `range`: L [m] of the view.
    sfsm::Decision decision(double range) const;
    int samples() const;  // a pixel, of triangles
};

// "rate = 0.00123": what Setting::name says of one.
std::string rate_name(double rate);

const figures::Way& way_of(sfsm::Drawing drawing);

// All of them. A way of drawing that comes to be is a line here; a representation that a figures::Way lists comes in by
// itself, since state 2 draws each person as the cheapest of all that serve them.
std::span<const Setting> settings();

// Triangles by OpenGL, which take a software driver microseconds each: of crowds over `most_for_opengl_triangles` in
// one view, at one sample.
inline constexpr std::int64_t most_for_opengl_triangles = 20'000;
bool is_measured(const Setting& setting, std::int64_t people, const std::string& view, bool is_preset);

}  // namespace bench::front
