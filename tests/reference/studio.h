// A character and a renderer, for pictures of people who stand where a test puts them.
#pragma once

#include <algorithm>
#include <vector>

#include "pointsample/sample.h"
#include "render/gl/renderer.h"
#include "tests/reference/picture.h"

namespace reference {

// Everything a renderer needs of one character, and the reference's own idea of it.
struct Model {
    model::Character character;
    std::vector<int> clips;
    pointsample::PointModel points;
    motion::PoseTable poses;
    Figure figure;

    Model(model::Character from, std::vector<int> played, std::size_t point_count);
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    figures::Figure product() const { return {&character.mesh, &poses, &points}; }
};

// Whom a renderer is to draw, as it takes it: one batch a person, in their order. Each is of one of the models, whose
// places are the characters' numbers.
render::Frame frame_of(std::span<const Person> people, std::span<const Model* const> models, const render::View& view,
                       double splat_size);

// Colours of which no two could be taken for one another.
inline const scene::Palette motley = [] {
    const glm::u8vec4 some[] = {{230, 60, 50, 255},  {40, 200, 70, 255},  {60, 80, 240, 255}, {240, 220, 60, 255},
                                {220, 50, 230, 255}, {60, 220, 230, 255}, {250, 140, 40, 255}};
    scene::Palette palette;
    std::copy_n(std::begin(some), palette.colors.size(), palette.colors.begin());
    return palette;
}();

}  // namespace reference
