// A scene's chart as an SVG for inside HTML: time to the right, error upwards, both
// logarithmic. page/chart.js is its twin,
// and front.css gives both their looks.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/front/scene.h"

namespace bench::front {

// What the charts of one crowd have in common, or one large chart.
struct Range {
    double fast_ms = 1, slow_ms = 100;  // > 0
    double least = -2, most = 0;        // of ErrorKind::height, finite
    bool has_exact = false;             // some height is -inf: shown at the bottom
};
Range range_of(std::span<const Scene> scenes, const ErrorKind& error);

inline constexpr std::size_t family_looks = 12;  // that page/front.css has; from there on they come again

// Families by the place of their look.
std::vector<std::string> families_of(const Front& front);

enum class ChartSize { small, large };
std::string chart_svg(const Scene& scene, const ErrorKind& error, const Range& range,
                      const std::vector<std::string>& families, ChartSize size);

// "predictive", "safeguarded", "paper", or "other": of a law's class.
std::string law_class(std::string_view law);

// The path of a law's mark around (0, 0): predictive a diamond, safeguarded a square, paper a triangle, others a cross.
std::string mark_path(std::string_view law, double radius);

}  // namespace bench::front
