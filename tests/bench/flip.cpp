#include "tests/bench/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <numeric>

namespace bench {
namespace {

using std::numbers::pi;

// Three planes of a picture in one.
struct Field {
    int width, height;
    std::vector<glm::dvec3> pixels;
};

// One side of a separable filter, around its middle; the planes' filters side by side.
using Taps = std::vector<glm::dvec3>;

// Linear light to the CIE's XYZ, D65.
const glm::dmat3 xyz_of_rgb =
    glm::transpose(glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,  //
                              2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,    //
                              1425376.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
const glm::dmat3 rgb_of_xyz = glm::inverse(xyz_of_rgb);
const glm::dvec3 white = xyz_of_rgb * glm::dvec3(1);

// The opponent space that the contrast sensitivities are of: lightness, red-green, blue-yellow.
glm::dvec3 opponent_of_rgb(const glm::dvec3& rgb) {
    const glm::dvec3 xyz = xyz_of_rgb * rgb / white;
    return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

glm::dvec3 rgb_of_opponent(const glm::dvec3& opponent) {
    const double y = (opponent.x + 16) / 116;
    return rgb_of_xyz * (glm::dvec3(y + opponent.y / 500, y, y - opponent.z / 200) * white);
}

// L*a*b* whose colours fade with lightness, as Hunt found.
glm::dvec3 hunt_lab_of_rgb(const glm::dvec3& rgb) {
    const auto compressed = [](double t) {
        constexpr double delta = 6.0 / 29;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
    };
    const glm::dvec3 xyz = xyz_of_rgb * rgb / white;
    const double fx = compressed(xyz.x), fy = compressed(xyz.y), fz = compressed(xyz.z);
    const double lightness = 116 * fy - 16;
    return {lightness, 0.01 * lightness * 500 * (fx - fy), 0.01 * lightness * 200 * (fy - fz)};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// `across` along the rows, then `down` along the columns, plane by plane; the border's pixels go on outside.
Field filtered(const Field& field, const Taps& across, const Taps& down) {
    const auto pass = [&](const Field& in, const Taps& taps, int dx, int dy) {
        const int radius = static_cast<int>(taps.size() / 2);
        Field out = in;
        for (int y = 0; y < in.height; ++y) {
            for (int x = 0; x < in.width; ++x) {
                glm::dvec3 sum(0);
                for (int i = -radius; i <= radius; ++i) {
                    const int from_x = std::clamp(x + i * dx, 0, in.width - 1);
                    const int from_y = std::clamp(y + i * dy, 0, in.height - 1);
                    sum += taps[static_cast<std::size_t>(i + radius)] *
                           in.pixels[static_cast<std::size_t>(from_y) * in.width + from_x];
                }
                out.pixels[static_cast<std::size_t>(y) * in.width + x] = sum;
            }
        }
        return out;
    };
    return pass(pass(field, across, 1, 0), down, 0, 1);
}

// What an eye makes of an opponent picture from where it stands: the contrast sensitivities as sums of Gaussians
// a sqrt(pi / b) exp(-pi^2 x^2 / b) (table 1), x in degrees.
Field seen(const Field& opponent, double pixels_per_degree) {
    struct Gaussian {
        glm::dvec3 a, b;
    };
    constexpr double nothing = 1e-5;
    const std::array<Gaussian, 2> sum{Gaussian{{1, 1, 34.1}, {0.0047, 0.0053, 0.04}},
                                      Gaussian{{0, 0, 13.5}, {nothing, nothing, 0.025}}};
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
    Field out = opponent;
    std::fill(out.pixels.begin(), out.pixels.end(), glm::dvec3(0));
    glm::dvec3 total(0);
    for (const Gaussian& gaussian : sum) {
        Taps taps;
        glm::dvec3 side(0);
        for (int i = -radius; i <= radius; ++i) {
            const double degrees = i / pixels_per_degree;
            taps.push_back(glm::exp(-pi * pi * degrees * degrees / gaussian.b));
            side += taps.back();
        }
        const glm::dvec3 scale = gaussian.a * glm::sqrt(pi / gaussian.b);
        const Field part = filtered(opponent, taps, taps);
        for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] += scale * part.pixels[i];
        total += scale * side * side;
    }
    for (glm::dvec3& pixel : out.pixels) pixel /= total;
    return out;
}

// Edges and points of lightness: first and second derivatives of a Gaussian as wide as an eye resolves. The plane x has
// the lightness smoothed across, y its first, z its second derivative; then the same downwards.
struct Features {
    std::vector<double> edges, points;
};

Features features(const Field& opponent, double pixels_per_degree) {
    const double deviation = 0.5 * 0.082 * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    Taps taps;
    glm::dvec3 above(0), below(0);
    for (int i = -radius; i <= radius; ++i) {
        const double gaussian = std::exp(-i * i / (2 * deviation * deviation));
        taps.emplace_back(gaussian, -i * gaussian, (i * i / (deviation * deviation) - 1) * gaussian);
        above += glm::max(taps.back(), 0.0);
        below -= glm::min(taps.back(), 0.0);
    }
    for (glm::dvec3& tap : taps)
        for (int plane = 0; plane < 3; ++plane) tap[plane] /= tap[plane] > 0 ? above[plane] : below[plane];
    Taps smooth;
    for (const glm::dvec3& tap : taps) smooth.emplace_back(tap.x);

    Field lightness = opponent;
    for (glm::dvec3& pixel : lightness.pixels) pixel = glm::dvec3((pixel.x + 16) / 116);
    const Field across = filtered(lightness, taps, smooth), down = filtered(lightness, smooth, taps);
    Features found;
    for (std::size_t i = 0; i < lightness.pixels.size(); ++i) {
        found.edges.push_back(std::hypot(across.pixels[i].y, down.pixels[i].y));
        found.points.push_back(std::hypot(across.pixels[i].z, down.pixels[i].z));
    }
    return found;
}

Field opponent_picture(const render::Image& image) {
    Field field{image.width, image.height, {}};
    for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
        const auto light = [&](std::size_t k) {
            const double code = image.pixels[i + k] / 255.0;
            return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
        };
        field.pixels.push_back(opponent_of_rgb({light(0), light(1), light(2)}));
    }
    return field;
}

// Of two colours as seen, in [0, 1]: small differences, which are frequent, get most of the range.
double color_error(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double exponent = 0.7, knee = 0.4, knee_error = 0.95;
    static const double largest = std::pow(hyab(hunt_lab_of_rgb({0, 1, 0}), hunt_lab_of_rgb({0, 0, 1})), exponent);
    const auto lab = [](const glm::dvec3& opponent) {
        return hunt_lab_of_rgb(glm::clamp(rgb_of_opponent(opponent), 0.0, 1.0));
    };
    const double share = std::pow(hyab(lab(a), lab(b)), exponent) / largest;
    return share < knee ? share / knee * knee_error : knee_error + (share - knee) / (1 - knee) * (1 - knee_error);
}

}  // namespace

std::vector<float> flip_errors(const render::Image& reference, const render::Image& test, double pixels_per_degree) {
    assert(reference.width == test.width && reference.height == test.height && reference.width > 0);
    const Field reference_field = opponent_picture(reference), test_field = opponent_picture(test);
    const Field reference_seen = seen(reference_field, pixels_per_degree);
    const Field test_seen = seen(test_field, pixels_per_degree);
    const Features a = features(reference_field, pixels_per_degree), b = features(test_field, pixels_per_degree);
    std::vector<float> errors;
    for (std::size_t i = 0; i < reference_seen.pixels.size(); ++i) {
        const double feature = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
        const double feature_error = std::sqrt(feature / std::numbers::sqrt2);
        const double color = color_error(reference_seen.pixels[i], test_seen.pixels[i]);
        errors.push_back(static_cast<float>(std::pow(color, 1 - feature_error)));
    }
    return errors;
}

double mean_flip_error(const render::Image& reference, const render::Image& test, double pixels_per_degree) {
    const std::vector<float> errors = flip_errors(reference, test, pixels_per_degree);
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

}  // namespace bench
