// A character whose surfaces have two sides, as points: a bent sheet covers as much and sends the same light as its
// triangles do, from whichever side it is seen, and if it is full of holes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "figures/way.h"
#include "pointsample/sample.h"
#include "render/native/renderer.h"
#include "tests/native/lone_person.h"
#include "tests/render/stiff_mesh.h"

namespace {

constexpr int side = 240;                                     // [px] of the picture
constexpr double distance = 100, height = 1.6, radius = 0.5;  // [m] to the sheet, and of it: half a pipe
constexpr int around = 24;                                    // strips of it
constexpr int most_points = 2000;

// Open towards -z: its outer side faces +z.
model::Character make_sheet(bool has_holes) {
    model::Character sheet;
    sheet.name = "sheet";
    model::Mesh& mesh = sheet.mesh;
    model::Material cloth;
    cloth.double_sided = true;
    if (has_holes) {
        constexpr int texels = 32, strip = 4;  // two of five strips are open
        cloth.texture = 0;
        cloth.alpha_cutoff = 0.5f;
        mesh.textures.push_back({texels, texels, {}});
        for (int i = 0; i < texels * texels; ++i)
            mesh.textures[0].texels.emplace_back(255, 255, 255, i % texels / strip % 5 < 3 ? 255 : 0);
    }
    mesh.materials.push_back(cloth);
    for (int i = 0; i <= around; ++i)
        for (const double y : {0.0, height}) {
            const double turn = std::numbers::pi * (static_cast<double>(i) / around - 0.5);
            const glm::vec3 normal(std::sin(turn), 0, std::cos(turn));
            tests::add_vertex(mesh, {radius * std::sin(turn), y, radius * std::cos(turn)}, normal);
            mesh.uvs.back() = glm::vec2(static_cast<double>(i) / around, y / height);
        }
    for (std::uint32_t i = 0; i < around; ++i)
        for (const std::uint32_t corner : {0, 2, 1, 1, 2, 3}) mesh.indices.push_back(2 * i + corner);
    tests::add_only_joint(sheet);
    return sheet;
}

struct Sheet {
    model::Character character;
    pointsample::PointModel points = sample();
    motion::PoseTable poses = motion::bake_poses(character, {}, points.surface, std::size_t{1} << 20);

    explicit Sheet(bool has_holes) : character(make_sheet(has_holes)) {}

    pointsample::PointModel sample() const {
        pointsample::SampleOptions options;
        options.count = most_points;
        return pointsample::sample(character.mesh, pointsample::spread_poses(character, {}, 1), options);
    }
    std::vector<figures::Figure> figures() const { return {{&character.mesh, &poses, &points}}; }
};

const Sheet& sheet(bool has_holes) {
    static const Sheet whole(false), holed(true);
    return has_holes ? holed : whole;
}

scene::Light before_black(float from_around, float from_sun) {
    scene::Light light;
    light.glare = light.haze = light.zenith = glm::vec3(0);
    light.from_above = light.from_below = glm::vec3(from_around);
    light.sun = glm::vec3(from_sun);
    light.to_sun = glm::vec3(0, 0, 1);
    return light;
}

// Light from everywhere alike, so that what is sent is what is covered; and from +z alone, which half of it is in.
scene::Light even() {
    return before_black(1, 0);
}
scene::Light from_outside() {
    return before_black(0.1f, 0.8f);
}

class Stage {
public:
    explicit Stage(const scene::Light& light, bool has_holes = false)
        : sheet_(sheet(has_holes)),
          renderer_(scene::StaticMesh{}, scene::Ground{}, light, sheet_.figures(), side, side) {}

    // [px] of white that as many points send as are to be drawn there, towards an eye `azimuth` around from +z.
    double of_points(double azimuth, int points) { return light_sent(azimuth, pixels_a_metre(points), points); }
    double of_triangles(double azimuth, int points) {
        constexpr double finer = 4;  // than pixels, across and down
        return light_sent(azimuth, finer * pixels_a_metre(points), 0) / (finer * finer);
    }

private:
    double pixels_a_metre(int points) const {
        constexpr double points_a_pixel = 1.2;
        return std::sqrt(points / (points_a_pixel * static_cast<double>(sheet_.poses.area)));
    }

    // 0 points: as triangles.
    double light_sent(double azimuth, double scale, int points) {
        const glm::dvec3 middle(0, height / 2, 0);
        const glm::dvec3 eye = middle + distance * glm::dvec3(std::sin(azimuth), 0.1, std::cos(azimuth));
        const render::View view =
            render::make_view({eye, middle, 2 * std::atan(0.5 * side / (scale * distance))}, side, side);
        const render::Frame frame = tests::frame_of_one(view, static_cast<std::size_t>(points));
        renderer_.begin(view);
        renderer_.draw(frame);
        double sum = 0;
        for (const std::uint8_t value : renderer_.read_image().pixels) sum += std::pow(value / 255.0, 2) / 3;
        return sum;
    }

    const Sheet& sheet_;
    render::native::Renderer renderer_;
};

constexpr int azimuths = 16;
// More and fewer than what stands for both sides by itself, and than what is summed up.
constexpr int counts[] = {12, 17, 40, 200, 513, most_points};

TEST(NativeDoubleSided, CoversWhatItsTrianglesDoFromEverySide) {
    constexpr double near_enough = 0.12;  // of what is covered: points are gathered into pixels, and few are uneven
    Stage stage(even());
    for (const int points : counts)
        for (int i = 0; i < azimuths; ++i) {
            const double azimuth = 2 * std::numbers::pi * i / azimuths;
            const double covered = stage.of_points(azimuth, points), truth = stage.of_triangles(azimuth, points);
            EXPECT_NEAR(covered / truth, 1, near_enough) << points << " points, azimuth " << azimuth;
        }
}

TEST(NativeDoubleSided, CoversWhatItsTrianglesDoBesideItsHoles) {
    constexpr double near_enough = 0.15;
    Stage stage(even(), true);
    for (const int points : {40, 200, 513, most_points})
        for (int i = 0; i < azimuths; ++i) {
            const double azimuth = 2 * std::numbers::pi * i / azimuths;
            const double covered = stage.of_points(azimuth, points), truth = stage.of_triangles(azimuth, points);
            EXPECT_NEAR(covered / truth, 1, near_enough) << points << " points, azimuth " << azimuth;
        }
}

TEST(NativeDoubleSided, ShowsTheLightOfTheSideThatIsSeen) {
    constexpr double near_enough = 0.25;  // of the light, half of which an edge-on view has from one strip
    Stage stage(from_outside());
    for (const int points : counts)
        for (int i = 0; i < azimuths; ++i) {
            const double azimuth = 2 * std::numbers::pi * i / azimuths;
            const double sent = stage.of_points(azimuth, points), truth = stage.of_triangles(azimuth, points);
            EXPECT_NEAR(sent / truth, 1, near_enough) << points << " points, azimuth " << azimuth;
        }
    EXPECT_GT(stage.of_points(0, most_points), 4 * stage.of_points(std::numbers::pi, most_points));
}

}  // namespace
