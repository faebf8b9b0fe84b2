// How different people look to an eye from how they should: the mean FLIP (Andersson et al. 2020) of the pixels that
// show them, expected before anything is drawn. Constants are fitted to measured pictures (docs/measurements/loss.md).
//
// What points lose hardly depends on how large somebody is on the screen, only on how far apart their points lie and on
// the cells these are added up in; what triangles and splats lose depends on size alone.
#pragma once

#include <array>

namespace figures {

struct ExpectedError {
    // Points: as fine as they come, and how it grows with their spacing and with cells beyond a pixel.
    double finest, growth, power, blur;
    // Points that leave cells empty: the share of the error of a hole, and how fast holes fill.
    double hole, filling;
    // Triangles: of the smallest people; the height [px] at which it is half of that, and how fast it falls.
    double mesh, mesh_height, mesh_power;
    // Splats that stand for whole people: of the smallest, how it grows with their height [1/px] and with cells, most.
    double splat, splat_growth, splat_blur, splat_most;
    // Surfaces that are not where they should be: growth [1/px], most.
    double motion_growth, motion_most;

    // `spacing` [px] > 0: the side of a square as large as the surface that a point stands for. `cell` [px] >= 1.
    double of_points(double spacing, double cell) const;
    // `height` [px] > 0 of the person.
    double of_mesh(double height) const;
    // In cells of a pixel; in larger ones that many times more.
    double of_splat(double height) const;
    double times_in_cells(double cell) const { return 1 + splat_blur * (cell - 1); }
    // Added to the others. `off` [px] >= 0: how far off surfaces are, mean over them.
    double of_motion(double off) const;
};

// ExpectedError::of_points in cells of one size, by sixteenths of an octave of spacing: to be asked for everybody.
class PointsErrors {
public:
    PointsErrors() = default;
    PointsErrors(const ExpectedError& error, double cell);

    // `spacing` [px] > 0
    double at(float spacing) const;

private:
    static constexpr int octaves = 12, per_octave = 16, first_octave = -4;
    std::array<double, octaves * per_octave> errors_{};
};

}  // namespace figures
