#include "tests/bench/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "tests/bench/filter.h"

namespace bench {
namespace {

using std::numbers::pi;

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

// Lightness, red-green, blue-yellow.
using Opponent = std::array<Plane, 3>;

Opponent opponent_picture(const render::Image& image) {
    static const auto lights = [] {
        std::array<double, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i) {
            const double code = static_cast<double>(i) / 255.0;
            table[i] = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
        }
        return table;
    }();
    const std::size_t count = image.pixels.size() / 3;
    Opponent out;
    for (Plane& plane : out) plane = {image.width, image.height, std::vector<double>(count)};
    for_each_row(image.height, [&](int y) {
        const std::uint8_t* code = &image.pixels[std::size_t{3} * y * image.width];
        for (int x = 0; x < image.width; ++x, code += 3) {
            const glm::dvec3 color = opponent_of_rgb({lights[code[0]], lights[code[1]], lights[code[2]]});
            for (int plane = 0; plane < 3; ++plane) out[plane].row(y)[x] = color[plane];
        }
    });
    return out;
}

Plane filtered(const Plane& plane, const Taps& across, const Taps& down) {
    return filtered_down(filtered_across(plane, across, Border::goes_on), down, Border::goes_on);
}

// What an eye makes of an opponent picture from where it stands: the contrast sensitivities as sums of Gaussians
// a sqrt(pi / b) exp(-pi^2 x^2 / b) (table 1), x in degrees.
Opponent seen(const Opponent& opponent, double pixels_per_degree) {
    struct Gaussian {
        double a, b;
    };
    static const std::array<std::vector<Gaussian>, 3> sums{
        {{{1, 0.0047}}, {{1, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}}};
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
    Opponent out = opponent;
    for (std::size_t plane = 0; plane < out.size(); ++plane) {
        std::vector<double>& values = out[plane].values;
        std::fill(values.begin(), values.end(), 0.0);
        double total = 0;
        for (const Gaussian& gaussian : sums[plane]) {
            Taps taps;
            double side = 0;
            for (int i = -radius; i <= radius; ++i) {
                const double degrees = i / pixels_per_degree;
                taps.push_back(std::exp(-pi * pi * degrees * degrees / gaussian.b));
                side += taps.back();
            }
            const double scale = gaussian.a * std::sqrt(pi / gaussian.b);
            const Plane part = filtered(opponent[plane], taps, taps);
            for (std::size_t i = 0; i < values.size(); ++i) values[i] += scale * part.values[i];
            total += scale * side * side;
        }
        for (double& value : values) value /= total;
    }
    return out;
}

// Derivatives of a Gaussian as wide as an eye resolves, the sums of whose positive and negative taps are 1 and -1.
struct Detectors {
    Taps smooth, edge, point;  // the Gaussian, its first and second derivative
};

Detectors detectors(double pixels_per_degree) {
    const double deviation = 0.5 * 0.082 * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    Detectors found;
    for (int i = -radius; i <= radius; ++i) {
        const double gaussian = std::exp(-i * i / (2 * deviation * deviation));
        found.smooth.push_back(gaussian);
        found.edge.push_back(-i * gaussian);
        found.point.push_back((i * i / (deviation * deviation) - 1) * gaussian);
    }
    for (Taps* taps : {&found.smooth, &found.edge, &found.point}) {
        double above = 0, below = 0;
        for (const double tap : *taps) (tap > 0 ? above : below) += std::abs(tap);
        for (double& tap : *taps) tap /= tap > 0 ? above : below;
    }
    return found;
}

// Edges and points of lightness: how strong, whatever their direction.
struct Features {
    std::vector<double> edges, points;
};

Features features(const Plane& opponent_lightness, double pixels_per_degree) {
    const Detectors detect = detectors(pixels_per_degree);
    Plane lightness = opponent_lightness;
    for (double& value : lightness.values) value = (value + 16) / 116;
    const Plane smooth = filtered_across(lightness, detect.smooth, Border::goes_on);
    const auto strength = [&](const Taps& taps) {
        const Plane across = filtered(lightness, taps, detect.smooth);
        const Plane down = filtered_down(smooth, taps, Border::goes_on);
        std::vector<double> out(across.values.size());
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = std::sqrt(across.values[i] * across.values[i] + down.values[i] * down.values[i]);
        return out;
    };
    return {strength(detect.edge), strength(detect.point)};
}

glm::dvec3 lab_of(const glm::dvec3& opponent) {
    return hunt_lab_of_rgb(glm::clamp(rgb_of_opponent(opponent), 0.0, 1.0));
}

// Of two colours as seen, in L*a*b*, in [0, 1]: small differences, which are frequent, get most of the range.
double color_error(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double exponent = 0.7, knee = 0.4, knee_error = 0.95;
    static const double largest = std::pow(hyab(hunt_lab_of_rgb({0, 1, 0}), hunt_lab_of_rgb({0, 0, 1})), exponent);
    const double share = std::pow(hyab(a, b), exponent) / largest;
    return share < knee ? share / knee * knee_error : knee_error + (share - knee) / (1 - knee) * (1 - knee_error);
}

}  // namespace

FlipReference::Side FlipReference::side_of(const render::Image& image, double pixels_per_degree) {
    const Opponent opponent = opponent_picture(image);
    const Opponent as_seen = seen(opponent, pixels_per_degree);
    Features found = features(opponent[0], pixels_per_degree);
    Side side{std::vector<glm::dvec3>(found.edges.size()), std::move(found.edges), std::move(found.points)};
    for_each_row(image.height, [&](int y) {
        glm::dvec3* color = &side.colors[static_cast<std::size_t>(y) * image.width];
        for (int x = 0; x < image.width; ++x)
            color[x] = lab_of({as_seen[0].row(y)[x], as_seen[1].row(y)[x], as_seen[2].row(y)[x]});
    });
    return side;
}

FlipReference::FlipReference(const render::Image& reference, double pixels_per_degree)
    : pixels_per_degree_(pixels_per_degree), reference_(side_of(reference, pixels_per_degree)) {}

std::vector<float> FlipReference::errors(const render::Image& test) const {
    assert(std::size_t{3} * reference_.colors.size() == test.pixels.size());
    const Side side = side_of(test, pixels_per_degree_);
    std::vector<float> errors(side.colors.size());
    for_each_row(test.height, [&](int y) {
        const std::size_t first = static_cast<std::size_t>(y) * test.width;
        for (std::size_t i = first; i < first + test.width; ++i) {
            const double feature = std::max(std::abs(reference_.edges[i] - side.edges[i]),
                                            std::abs(reference_.points[i] - side.points[i]));
            const double feature_error = std::sqrt(feature / std::numbers::sqrt2);
            const double color = color_error(reference_.colors[i], side.colors[i]);
            errors[i] = static_cast<float>(std::pow(color, 1 - feature_error));
        }
    });
    return errors;
}

std::vector<float> flip_errors(const render::Image& reference, const render::Image& test, double pixels_per_degree) {
    return FlipReference(reference, pixels_per_degree).errors(test);
}

double mean_flip_error(const render::Image& reference, const render::Image& test, double pixels_per_degree) {
    const std::vector<float> errors = flip_errors(reference, test, pixels_per_degree);
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

}  // namespace bench
