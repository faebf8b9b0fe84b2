// The oracle for every way of drawing: what each pixel may show, by brute force in double precision. Every triangle and
// every splat of everybody is tried on every pixel that it could cover; nothing is culled, batched, packed or baked.
//
// A renderer rounds: positions to a fraction of a pixel, normals to a degree, depths to float32. So a pixel is
// looked at in five places, its centre and a sixteenth of a pixel off it, and in each place at all surfaces that are as
// good as equally near. Where all of that is one colour the renderer must show it; beside edges, one of these.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "render/image.h"
#include "tests/reference/scene.h"

namespace reference {

// A colour that a pixel may have, [0, 255] as it is stored. Not a single one where the exact value is the driver's own
// choice: which mipmap, which side of an edge-on sheet, how a line thinner than a pixel is faded.
struct Shade {
    glm::dvec3 low, high;
    glm::dvec3 best;  // what is right on average

    static Shade exactly(const glm::dvec3& color) { return {color, color, color}; }
    static Shade between(const glm::dvec3& low, const glm::dvec3& high) { return {low, high, (low + high) / 2.0}; }
};

struct Picture {
    int width = 0, height = 0;
    std::vector<glm::dvec3> colors;          // the best at the pixels' centres, rows from the top
    std::vector<std::vector<Shade>> shades;  // what each may show; never empty
    std::vector<bool> sky;                   // nothing else is seen in it

    render::Image image() const;
};

// With several samples a pixel is the mean of their light, and a range unless they are all certain.
Picture draw(const Scene& scene);

// How a renderer's picture compares.
struct Comparison {
    int pixels = 0;
    int plain = 0;          // of one colour, in the reference
    int wrong_plain = 0;    // of those, off by more than the tolerance
    int surface = 0;        // not of the sky alone
    int plain_surface = 0;  // of those, of one colour
    int wrong = 0;          // of all, off from everything they may show by more than the tolerance
    double worst = 0;       // [of 255] the farthest off
    double mean = 0;        // [of 255] how far off pixels are
    int worst_x = 0, worst_y = 0;

    std::string text() const;
};

inline constexpr double tolerance =
    5;  // [of 255] three for packed normals, one and a half for bytes of looks, rounding

Comparison compare(const render::Image& image, const Picture& picture);

// How far the picture is off from the reference's best, on average over pixels and channels [of 255].
double mean_error(const render::Image& image, const Picture& picture);

// The farthest that the mean colour of any square of `side` [px] is off from the reference's best [of 255]: what is
// drawn finer than a pixel is right on average, wherever in a pixel it falls.
double worst_mean(const render::Image& image, const Picture& picture, int side);

// How far a pixel is off from what it may show [of 255].
double distance(const render::Image& image, const Picture& picture, int x, int y);

}  // namespace reference
