// A character of several colours, textures and slots that can be made to shine by itself, and pictures of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>

#include "tests/reference/harlequin.h"
#include "tests/reference/studio.h"

namespace reference {

enum class Shine { no, unlit, glowing };

inline model::Character make_shining_harlequin(Shine shine) {
    model::Character harlequin = make_harlequin(true);
    harlequin.name = shine == Shine::no ? "dull harlequin" : shine == Shine::unlit ? "unlit harlequin" : "glowworm";
    std::vector<model::Material>& materials = harlequin.mesh.materials;
    for (model::Material& material : materials) material.unlit = shine == Shine::unlit;
    if (shine != Shine::glowing) return harlequin;
    materials[0].emissive = {0.2f, 0.05f, 0.4f};
    materials[1].emissive = {0.4f, 0.4f, 0.1f};
    materials[1].emissive_texture = 0;
    materials[2].emissive = {0.1f, 0.4f, 0.3f};
    materials[2].emissive_texture = 1 - materials[2].texture;
    return harlequin;
}

// Before a black sky.
inline scene::Light before_black(const glm::vec3& from_above, const glm::vec3& from_below, const glm::vec3& sun) {
    scene::Light light;
    light.glare = light.haze = light.zenith = glm::vec3(0);
    light.from_above = from_above;
    light.from_below = from_below;
    light.sun = sun;
    return light;
}
// That shows everything in its own colour; that doesn't; that does even less; and none.
inline scene::Light plain_light() {
    return before_black(glm::vec3(1), glm::vec3(1), glm::vec3(0));
}
inline scene::Light odd_light() {
    return before_black({0.2f, 0.3f, 0.7f}, {0.1f, 0, 0}, {1.3f, 0.4f, 0.1f});
}
inline scene::Light weak_light() {
    return before_black({0.1f, 0.2f, 0.3f}, {0.2f, 0.1f, 0}, {0.2f, 0.1f, 0.1f});
}
inline scene::Light no_light() {
    return before_black(glm::vec3(0), glm::vec3(0), glm::vec3(0));
}

// Where one model is seen in one light.
template <typename Renderer>
class Booth {
public:
    Booth(const Model& model, const scene::Light& light, const figures::Way& way)
        : model_(model),
          way_(way),
          renderer_(scene::StaticMesh{}, scene::Ground{}, light, std::vector{model.product()}, width, height) {}

    // By so many points (0: triangles), from one of several sides.
    render::Image shoot(std::size_t points, int side) { return shoot(points, side, points == 0 ? 3 : 12); }
    render::Image shoot(std::size_t points, int side, double distance) {  // [m]
        Person person = sitter(model_, side % 2, 7 * side);
        person.points = points;
        const scene::CameraPose pose = camera(person, 1.3 * side, 0.2, distance);
        const render::View view = render::make_view(pose, width, height);
        const Model* const models[] = {&model_};
        renderer_.begin(view);
        renderer_.draw(frame_of({&person, 1}, models, view, points == 0 ? 0 : 2, way_));
        return renderer_.read_image();
    }

private:
    static constexpr int width = 120, height = 100;  // [px]

    const Model& model_;
    const figures::Way& way_;
    Renderer renderer_;
};

// [of 255] in any channel of any pixel.
inline int worst_difference(const render::Image& a, const render::Image& b) {
    int worst = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) worst = std::max(worst, std::abs(a.pixels[i] - b.pixels[i]));
    return worst;
}

// Of the light of two.
inline render::Image sum_of(const render::Image& a, const render::Image& b) {
    render::Image sum = a;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        sum.pixels[i] = static_cast<std::uint8_t>(std::lround(std::min(std::hypot(a.pixels[i], b.pixels[i]), 255.0)));
    return sum;
}

inline glm::dvec3 light_of(const render::Image& image) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        sum[static_cast<int>(i % 3)] += std::pow(image.pixels[i] / 255.0, 2);
    return sum;
}

inline int brightest(const render::Image& image) {
    return *std::ranges::max_element(image.pixels);
}

// Who is unlit shows in any light, and in none, what the dull show in plain light; they show something else in others.
//   counts  of points; 0: triangles
//   sides   from which they are seen, from the first on
//   off     [of 255] at most, in any channel
template <typename Renderer>
void expect_own_colors(const Model& dull, const Model& unlit, const figures::Way& way,
                       std::span<const std::size_t> counts, int sides, int off) {
    Booth<Renderer> plain(dull, plain_light(), way), lit(dull, odd_light(), way);
    Booth<Renderer> shining(unlit, odd_light(), way), in_the_dark(unlit, no_light(), way);
    for (const std::size_t points : counts)
        for (int side = 0; side < sides; ++side) {
            const render::Image expected = plain.shoot(points, side);
            EXPECT_GT(brightest(expected), 100);
            EXPECT_GT(worst_difference(expected, lit.shoot(points, side)), 20);
            for (Booth<Renderer>* booth : {&shining, &in_the_dark})
                EXPECT_LE(worst_difference(expected, booth->shoot(points, side)), off)
                    << points << " points from side " << side;
        }
}

}  // namespace reference
