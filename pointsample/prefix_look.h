// What a short prefix of a point model must look like: a person drawn by two points shows two averages of their
// surface, not the two spots that happen to come first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pointsample/point_model.h"

namespace pointsample {

// Between two of a model's points; facing the other way counts as twice as far, so that the two sides of something thin
// stay apart [units^2].
float squared_distance(const PointModel& model, std::size_t a, std::size_t b);

// Which of the first `count` points, at least one, is nearest to `point` by that; of equal ones the first.
std::size_t nearest_of_prefix(const PointModel& model, std::size_t point, std::size_t count);

// The mean over the part of the surface that is nearest to one point of the prefix.
struct PrefixLook {
    glm::u8vec4 color;                                   // of the light, sRGB-encoded
    std::array<std::uint8_t, model::slot_count> shares;  // of slots 1 to slot_count, unorm; the rest is no_slot's
    glm::u8vec4 own_light;                               // as PointModel has it, of the light
};

// One element for each of the first `count` points, as if there were no others; count in [1, model.size()].
// Each of the model's points is of equal area and goes to the nearest; facing the other way counts as twice as far.
// Time is count * model.size().
std::vector<PrefixLook> prefix_looks(const PointModel& model, std::size_t count);

}  // namespace pointsample
