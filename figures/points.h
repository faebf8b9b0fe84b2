// A person as the first points of their model, each a square splat of S pixels that is no larger than the person's
// silhouette. Its elements are what point_looks lists.
#pragma once

#include <array>

#include "figures/representation.h"

namespace figures {

// One for each number of points that is drawn.
std::vector<Level> point_levels(const Figure& figure);

// Half a splat, as far as splats go.
constexpr double point_outline_px(double splat_size, double silhouette) {
    return 0.5 * (splat_size < silhouette ? splat_size : silhouette);
}

inline constexpr Representation points{"points", false, point_levels, point_outline_px};

// The same points with coverage: any number of them is drawn, always from the first on. Its levels only say up to how
// many points a person is drawn so; the last is all of the model.
std::vector<Level> native_point_levels(const Figure& figure);

// [px] Natively points are added up in cells of this share of S, at least a pixel: four fifths of a point or more a
// cell, half of which face the eye. Smaller cells have holes, and larger ones blur.
inline constexpr double cell_share = 0.8408964;

// An area-sampled picture gains nothing from points finer than half a pixel.
constexpr double native_point_outline_px(double splat_size, double silhouette) {
    constexpr double finest = 0.5;  // [px]
    return point_outline_px(splat_size > finest ? splat_size : finest, silhouette);
}

inline constexpr Representation native_points{"points", false, native_point_levels, native_point_outline_px};

// What a drawer shows at one of the model's points.
struct PointLook {
    std::uint32_t point = 0;                               // into the model's, and a pose's, points
    glm::u8vec3 color{0};                                  // sRGB
    std::array<std::uint8_t, model::slot_count> shares{};  // of slots 1 to slot_count, unorm; the rest is no_slot's
    glm::u8vec4 own_light{0};                              // as pointsample::PointModel has it
    bool two_sided = false;                                // shown from behind too, even of a closed body
};

// First the short prefixes, one after the other, each with the mean looks of the surface that its points stand for;
// then all points with their own. Level::first says where a level's begin.
std::vector<PointLook> point_looks(const Figure& figure);

}  // namespace figures
