// Points leave no holes in a body that its triangles don't have, whatever of it stands before what.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "figures/way.h"
#include "pointsample/sample.h"
#include "render/native/renderer.h"
#include "tests/native/lone_person.h"
#include "tests/render/stiff_mesh.h"

namespace {

constexpr int side = 80;                               // [px] of the picture
constexpr double distance = 100, pixels_a_metre = 30;  // [m], and there
constexpr double points_a_pixel = 2.4;                 // of the surface

struct Box {
    glm::vec3 middle, half;  // [m]
};

model::Character make_body(const std::vector<Box>& boxes, bool double_sided) {
    model::Character body;
    body.name = "body";
    model::Mesh& mesh = body.mesh;
    mesh.materials.emplace_back().double_sided = double_sided;
    for (const Box& box : boxes)
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {-1.0f, 1.0f}) {
                glm::vec3 normal(0), u(0), v(0);
                normal[axis] = sign;
                u[(axis + 1) % 3] = sign;
                v[(axis + 2) % 3] = 1;
                const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
                for (const auto& [a, b] : {std::array{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
                    tests::add_vertex(mesh, box.middle + box.half * (normal + a * u + b * v), normal);
                for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + corner);
            }
    tests::add_only_joint(body);
    return body;
}

// Black before white, so that what is sent tells what is open.
scene::Light dark() {
    scene::Light light;
    light.glare = light.from_above = light.from_below = light.sun = glm::vec3(0);
    light.haze = light.zenith = glm::vec3(1);
    return light;
}

using Coverage = std::vector<double>;  // [row][column], 1 = wholly

// Of squares of nine pixels that triangles fill: how much of the worst is open, and on average.
struct Holes {
    double worst = 0, mean = 0;
};

Holes find_holes(const Coverage& triangles, const Coverage& points) {
    constexpr int wide = 3;  // [px]
    Holes holes;
    int count = 0;
    for (int y = 0; y + wide <= side; ++y)
        for (int x = 0; x + wide <= side; ++x) {
            double open = 0, least_filled = 1;
            for (int i = 0; i < wide * wide; ++i) {
                const int at = (y + i / wide) * side + x + i % wide;
                least_filled = std::min(least_filled, triangles[at]);
                open += (1 - points[at]) / (wide * wide);
            }
            if (least_filled < 0.99) continue;
            ++count;
            holes.mean += open;
            holes.worst = std::max(holes.worst, open);
        }
    EXPECT_GT(count, 100) << "nobody is seen";
    holes.mean /= std::max(count, 1);
    return holes;
}

class Studio {
public:
    Studio(const std::vector<Box>& boxes, bool double_sided)
        : body_(make_body(boxes, double_sided)),
          points_(sample()),
          poses_(motion::bake_poses(body_, {}, points_.surface, std::size_t{1} << 22)),
          renderer_(scene::StaticMesh{}, scene::Ground{}, dark(),
                    std::vector{figures::Figure{&body_.mesh, &poses_, &points_}}, side, side) {}

    // Seen from so far around +z, and above.
    Holes holes(double azimuth, double elevation) {
        return find_holes(shoot(azimuth, elevation, true), shoot(azimuth, elevation, false));
    }

private:
    Coverage shoot(double azimuth, double elevation, bool as_mesh) {
        const glm::dvec3 middle(0, 0.9, 0);
        const glm::dvec3 to_eye(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                std::cos(azimuth) * std::cos(elevation));
        const double fov = 2 * std::atan(0.5 * side / (pixels_a_metre * distance));
        const render::View view = render::make_view({middle + distance * to_eye, middle, fov}, side, side);
        const render::Frame frame =
            tests::frame_of_one(view, as_mesh ? 0 : static_cast<std::size_t>(poses_.point_count));
        renderer_.begin(view);
        renderer_.draw(frame);
        const render::Image image = renderer_.read_image();
        Coverage coverage;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3)
            coverage.push_back(1 - std::pow(image.pixels[i] / 255.0, 2));
        return coverage;
    }

    pointsample::PointModel sample() const {
        double area = 0;
        const model::Mesh& mesh = body_.mesh;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
            area += 0.5 * static_cast<double>(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
        }
        pointsample::SampleOptions options;
        options.count = static_cast<std::size_t>(points_a_pixel * area * pixels_a_metre * pixels_a_metre);
        return pointsample::sample(mesh, pointsample::spread_poses(body_, {}, 1), options);
    }

    model::Character body_;
    pointsample::PointModel points_;
    motion::PoseTable poses_;
    render::native::Renderer renderer_;
};

const Box torso{{0, 0.9f, 0}, {0.25f, 0.9f, 0.15f}};
// Stretched towards +z.
const Box arm{{0, 1.4f, 0.5f}, {0.06f, 0.06f, 0.4f}};

// Whether the arm hides what is below it changes from one direction of those that were looked from to the next.
TEST(NativeHoles, AreNotBelowAnArmThatPointsAtTheEye) {
    constexpr double most_open = 0.22;  // of nine pixels; 0.39 where points show as much as those directions agree
    Studio studio({torso, arm}, false);
    for (const double elevation : {0.05, 0.1, 0.15, 0.2, 0.25})
        for (const double azimuth : {0.0, 0.1, 0.2})
            EXPECT_LT(studio.holes(azimuth, elevation).worst, most_open)
                << azimuth << " around, " << elevation << " above";
}

// Most of its points are seen edge-on, so that fewer fill it than are there.
TEST(NativeHoles, AreFewInALongBodySeenFromItsEnd) {
    constexpr double most_open = 0.022;  // 0.026 where they count as if they showed alike much
    Studio studio({{{0, 0.9f, 0}, {0.3f, 0.3f, 1.5f}}}, false);
    double sum = 0;
    for (const double azimuth : {0.05, 0.15, 0.25})
        for (const double elevation : {0.05, 0.15, 0.25}) sum += studio.holes(azimuth, elevation).mean;
    EXPECT_LT(sum / 9, most_open);
}

// Of a thin part only the side that is seen counts, or all else would be given less.
TEST(NativeHoles, AreNotBesideThinPartsOfTwoSides) {
    constexpr double most_open = 0.015;  // 0.03 where both sides count
    const Box sign{{0.55f, 0.9f, 0}, {0.3f, 0.9f, 0.005f}};
    Studio studio({torso, sign}, true);
    for (const double azimuth : {0.0, 0.2, 0.4, 3.0, 3.3})
        EXPECT_LT(studio.holes(azimuth, 0.1).mean, most_open) << azimuth << " around";
}

}  // namespace
