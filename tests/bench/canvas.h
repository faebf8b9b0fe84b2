// A small software renderer, for pictures of a mesh and of its points under the same light: orthographic, with a depth
// buffer, sixteen samples a pixel. Made to be read, not to be fast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "pointsample/point_model.h"
#include "render/image.h"
#include "tests/bench/closeness.h"
#include "tests/bench/subject.h"

namespace bench {

// Where the eye is, infinitely far away.
struct View {
    glm::vec3 right, up, toward;  // the picture's axes and the way to the eye: orthonormal
    glm::vec3 center;             // what is in the picture's middle [units]
    float pixels_per_unit;
    int width, height;  // [px]
};

// From `azimuth` [rad] (0: from +z, pi / 2: from +x) and `elevation` [rad] above the ground; the picture holds the box
// and `margin` [px] around it.
View view_of(const motion::Bounds& box, float azimuth, float elevation, float pixels_per_unit, int margin);

class Canvas {
public:
    explicit Canvas(const View& view, glm::vec3 background = glm::vec3(1));  // linear light

    // With `flat`, in that one colour [linear light], unlit.
    void draw_mesh(const Subject& subject, std::optional<glm::vec3> flat = {});

    // The first `count` of the model's points as discs that face the eye, `lift` [units] nearer to it than they are.
    // A disc's radius [units] that is the points' covering radius leaves no hole.
    void draw_points(const Subject& subject, const pointsample::PointModel& model, std::size_t count, float radius,
                     float lift = 0);

    // Whether the mesh's triangle is in front where the spot is drawn, and not seen at a grazing angle, where a sample
    // is long.
    bool shows(const Subject& subject, std::uint32_t triangle, const glm::vec3& spot) const;

    render::Image image() const;

private:
    glm::vec3 to_samples(const glm::vec3& position) const;  // x right, y down [samples], z toward the eye [units]
    void put(int x, int y, float depth, const glm::vec3& color, std::uint32_t triangle);
    glm::vec3 surface_color(const Subject& subject, std::size_t triangle, const glm::vec3& shares) const;
    glm::vec3 lit(const glm::vec3& color, glm::vec3 normal, bool double_sided) const;

    View view_;
    int width_, height_;  // [samples]
    std::vector<glm::vec3> colors_;
    std::vector<float> depths_;
    std::vector<std::uint32_t> triangles_;  // or no_triangle
};

// Those of the spots of the subject's surface that are seen from one of many directions all around, in their order.
std::vector<glm::vec3> seen_spots(const Subject& subject, const Spots& spots);

// Copies `part` into `sheet` at (x, y) [px]; it must fit.
void paste(render::Image& sheet, const render::Image& part, int x, int y);

}  // namespace bench
