#include "tests/bench/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/bench/closeness.h"
#include "tests/pointsample/shapes.h"

namespace {

bench::Subject subject_of(model::Mesh mesh) {
    bench::Subject subject;
    subject.pose = {mesh.positions, mesh.normals};
    subject.bounds = motion::bounds_of(mesh.positions);
    subject.palette.fill(glm::u8vec4(255));
    subject.character.mesh = std::move(mesh);
    return subject;
}

std::uint8_t red_at(const render::Image& image, int x, int y) {
    return image.pixels[std::size_t{3} * (static_cast<std::size_t>(y) * image.width + x)];
}

TEST(Canvas, ShowsTheWorldUprightAndTheNearSide) {
    model::Mesh cube = tests::make_cube();
    for (std::size_t i = 0; i < cube.vertex_count(); ++i) {  // black below, and behind
        const bool dark = cube.positions[i].y < 0.5f || cube.normals[i].z < -0.5f;
        cube.colors[i] = dark ? glm::u8vec4(0, 0, 0, 255) : glm::u8vec4(255);
    }
    const bench::Subject subject = subject_of(cube);
    const bench::View view = bench::view_of(subject.bounds, 0, 0, 100, 10);
    ASSERT_EQ(view.width, 120);
    bench::Canvas canvas(view);
    canvas.draw_mesh(subject);
    const render::Image image = canvas.image();
    EXPECT_EQ(red_at(image, 60, 5), 255);   // the paper
    EXPECT_GT(red_at(image, 60, 15), 150);  // the top
    EXPECT_LT(red_at(image, 60, 105), 60);  // the bottom
}

TEST(Canvas, DiscsAsWideAsTheCoveringRadiusLeaveNoHole) {
    const bench::Subject subject = subject_of(tests::make_sphere(1, 4));
    pointsample::PointModel model;
    model.positions = bench::random_spots(subject.character.mesh, subject.pose.positions, 300, 1).positions;
    model.normals = model.positions;
    model.colors.resize(300, glm::u8vec4(0, 0, 0, 255));
    model.slots.resize(300, model::no_slot);
    const std::vector<glm::vec3> spots =
        bench::random_spots(subject.character.mesh, subject.pose.positions, 50'000, 2).positions;
    const double between_spots = 0.02;  // they are so far from one another
    const double radius = bench::covering_of(spots, model.positions).largest + between_spots;
    bench::Canvas points(bench::view_of(subject.bounds, 0.7f, 0.3f, 50, 4)), mesh = points;
    points.draw_points(subject, model, 300, static_cast<float>(radius));
    mesh.draw_mesh(subject, glm::vec3(0));
    const render::Image covered = points.image(), wanted = mesh.image();
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i) ASSERT_LE(covered.pixels[i], wanted.pixels[i]);
}

TEST(Canvas, SeesTheOuterOfTwoSpheres) {
    model::Mesh nested = tests::make_sphere(1, 3);
    const std::size_t outer = nested.triangle_count();
    tests::append(nested, tests::make_sphere(0.97f, 3));  // nearly touches it
    const bench::Subject subject = subject_of(nested);
    const bench::Spots spots = bench::random_spots(nested, nested.positions, 5000, 4);
    const std::vector<glm::vec3> seen = bench::seen_spots(subject, spots);
    const auto on_outer = std::count_if(spots.triangles.begin(), spots.triangles.end(),
                                        [&](std::uint32_t triangle) { return triangle < outer; });
    EXPECT_GT(seen.size(), 0.99 * static_cast<double>(on_outer));
    constexpr float between = 0.975f;  // of the faces of both, as none is as far out as its corners
    for (const glm::vec3& spot : seen) EXPECT_GT(glm::length(spot), between);
}

}  // namespace
