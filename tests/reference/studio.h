// A character and a renderer, for pictures of people who stand where a test puts them.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "figures/way.h"
#include "pointsample/sample.h"
#include "render/gl/renderer.h"
#include "render/native/renderer.h"
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

// From a file of ../shared/assets, in some of its clips, or in those that it is cast in; null if it isn't there.
std::unique_ptr<Model> model_of_file(const std::string& name, const figures::Way& way, std::vector<int> clips = {});

// The one that draws in this way, by daylight.
std::unique_ptr<render::Renderer> make_renderer(const figures::Way& way, const scene::StaticMesh& structure,
                                                const scene::Ground& ground, std::span<const figures::Figure> figures,
                                                int width, int height);

// How many a pixel has across and down, for whoever is drawn: what is more than triangles' is there to be averaged.
int samples_of(const figures::Way& way, double splat_size);

// Whom a renderer is to draw, as it takes it: one batch a person, in their order. Each is of one of the models, whose
// places are the characters' numbers.
render::Frame frame_of(std::span<const Person> people, std::span<const Model* const> models, const render::View& view,
                       double splat_size, const figures::Way& way = figures::by_opengl());

// Somebody in a world that is not around the origin, turned a little.
Person sitter(const Model& model, int slot, std::int64_t tick);

// From `azimuth` [rad] around the person, 0 = before them, `distance` [m] from their middle.
scene::CameraPose camera(const Person& person, double azimuth, double elevation, double distance);

struct Sitting {
    Person person;
    scene::CameraPose pose;
    std::string what;
};

// From six sides, in two poses, as triangles, from each distance [m].
std::vector<Sitting> all_around(const Model& model, std::initializer_list<double> distances);

// Colours of which no two could be taken for one another.
inline const scene::Palette motley = [] {
    const glm::u8vec4 some[] = {{230, 60, 50, 255},  {40, 200, 70, 255},  {60, 80, 240, 255}, {240, 220, 60, 255},
                                {220, 50, 230, 255}, {60, 220, 230, 255}, {250, 140, 40, 255}};
    scene::Palette palette;
    std::copy_n(std::begin(some), palette.colors.size(), palette.colors.begin());
    return palette;
}();

}  // namespace reference
