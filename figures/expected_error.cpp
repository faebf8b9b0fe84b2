#include "figures/expected_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace figures {

double ExpectedError::of_points(double spacing, double cell) const {
    const double coarseness = std::hypot(spacing, blur * (cell - 1));
    const double points_a_cell = cell * cell / (spacing * spacing);
    return finest + growth * std::pow(coarseness, power) + hole * std::exp(-filling * points_a_cell);
}

double ExpectedError::of_mesh(double height) const {
    return mesh / (1 + std::pow(height / mesh_height, mesh_power));
}

double ExpectedError::of_splat(double height) const {
    return std::min(splat + splat_growth * height, splat_most);
}

double ExpectedError::of_motion(double off) const {
    return std::min(motion_growth * off, motion_most);
}

PointsErrors::PointsErrors(const ExpectedError& error, double cell) {
    for (int octave = 0; octave < octaves; ++octave)
        for (int sixteenth = 0; sixteenth < per_octave; ++sixteenth) {
            const double spacing = std::ldexp(1 + (sixteenth + 0.5) / per_octave, octave + first_octave);
            errors_[static_cast<std::size_t>(octave * per_octave + sixteenth)] = error.of_points(spacing, cell);
        }
}

double PointsErrors::at(float spacing) const {
    constexpr int bits = 19, first = (127 + first_octave) * per_octave;  // four bits of the mantissa
    const int place = static_cast<int>(std::bit_cast<std::uint32_t>(spacing) >> bits) - first;
    return errors_[static_cast<std::size_t>(std::clamp(place, 0, octaves * per_octave - 1))];
}

}  // namespace figures
