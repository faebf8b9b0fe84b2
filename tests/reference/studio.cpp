#include "tests/reference/studio.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "model/io/mesh_file.h"
#include "model/sides.h"
#include "scene/cast.h"

namespace reference {

namespace {

model::Character with_sides_split(model::Character character) {
    model::split_sides(character.mesh);
    return character;
}

}  // namespace

Model::Model(model::Character from, std::vector<int> played, std::size_t point_count)
    : character(with_sides_split(std::move(from))), clips(std::move(played)), figure(character, clips, &points) {
    constexpr std::size_t poses_to_cover = 4, byte_budget = std::size_t{1} << 27;
    const std::vector<pointsample::PosedMesh> spread = pointsample::spread_poses(character, clips, poses_to_cover);
    points = pointsample::sample(character.mesh, spread, {.count = point_count});
    poses = motion::bake_poses(character, clips, points.surface, byte_budget);
}

namespace {

// The level that a person of so many points is drawn at; of none, triangles.
std::pair<std::uint32_t, figures::Level> level_of(const figures::Figure& figure, std::size_t points,
                                                  const figures::Way& way) {
    const auto all = way.representations;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        for (figures::Level level : all[i].levels(figure)) {
            if (level.by_ones && points <= level.count && points > 0) level.count = static_cast<std::uint32_t>(points);
            if (points == 0 ? all[i].is_mesh : !all[i].is_mesh && level.count == points) return {i, level};
        }
    }
    throw std::logic_error("no level of " + std::to_string(points) + " points");
}

}  // namespace

render::Frame frame_of(std::span<const Person> people, std::span<const Model* const> models, const render::View& view,
                       double splat_size, const figures::Way& way) {
    constexpr double snorm = 32767;
    render::Frame frame;
    frame.view = view;
    frame.splat_size = splat_size;
    for (const Person& person : people) {
        render::Instance instance;
        instance.position = glm::vec3(person.origin - view.position);
        instance.scale = static_cast<float>(person.scale);
        instance.turn.sin_yaw = static_cast<std::int16_t>(std::lround(snorm * std::sin(person.yaw)));
        instance.turn.cos_yaw = static_cast<std::int16_t>(std::lround(snorm * std::cos(person.yaw)));
        instance.palette = person.palette;
        const auto of = std::find_if(models.begin(), models.end(),
                                     [&](const Model* model) { return &model->figure == person.figure; });
        const auto character = static_cast<std::uint32_t>(of - models.begin());
        const auto pose = static_cast<std::uint32_t>((*of)->poses.pose_at(person.slot, person.tick));
        const auto [representation, level] = level_of((*of)->product(), person.points, way);
        const std::uint32_t batch = frame.batch_numbers++;
        frame.people.push_back({instance, character, representation, level.first, level.count, 1.0f, pose, batch,
                                view.depth(instance.position), static_cast<float>(person.shade)});
    }
    return frame;
}

std::unique_ptr<Model> model_of_file(const std::string& name, const figures::Way& way, std::vector<int> clips) {
    const std::filesystem::path file = std::filesystem::path(GRANDSTAND_SHARED) / "assets" / name;
    if (!std::filesystem::exists(file)) return nullptr;
    model::Character character = model::load_mesh(file);
    if (clips.empty()) {
        const scene::Casting casting = scene::cast(character);
        scene::add_stills(character, casting);
        clips = casting.clips;
    }
    const std::size_t triangles = character.mesh.triangle_count();
    const bool natively = way.drawing == sfsm::Drawing::native;
    const std::size_t points = natively ? figures::points_worth(triangles, way) : triangles / 2;
    return std::make_unique<Model>(std::move(character), std::move(clips), points);
}

std::unique_ptr<render::Renderer> make_renderer(const figures::Way& way, const scene::StaticMesh& structure,
                                                const scene::Ground& ground, std::span<const figures::Figure> figures,
                                                int width, int height) {
    if (way.drawing == sfsm::Drawing::native)
        return std::make_unique<render::native::Renderer>(structure, ground, scene::Light{}, figures, width, height);
    return std::make_unique<render::gl::Renderer>(structure, ground, scene::Light{}, figures, width, height);
}

int samples_of(const figures::Way& way, double splat_size) {
    constexpr int of_triangles = 2, of_areas = 4;
    if (way.drawing != sfsm::Drawing::native) return 1;
    return splat_size > 0 ? of_areas : of_triangles;
}

Person sitter(const Model& model, int slot, std::int64_t tick) {
    Person person;
    person.figure = &model.figure;
    person.slot = slot;
    person.tick = tick;
    person.origin = {31.5, 4.25, -47};
    person.yaw = 0.7;
    person.scale = 1.7 / model.figure.height();
    person.palette = motley;
    return person;
}

scene::CameraPose camera(const Person& person, double azimuth, double elevation, double distance) {
    const double turn = person.yaw + azimuth;
    scene::CameraPose pose;
    pose.target = person.origin + glm::dvec3(0, 0.85, 0);
    pose.position = pose.target + distance * glm::dvec3(std::sin(turn) * std::cos(elevation), std::sin(elevation),
                                                        std::cos(turn) * std::cos(elevation));
    return pose;
}

std::vector<Sitting> all_around(const Model& model, std::initializer_list<double> distances) {
    std::vector<Sitting> all;
    const int last = std::max(0, static_cast<int>(model.clips.size()) - 1);
    for (const Person& person : {sitter(model, 0, 0), sitter(model, last, 17)})
        for (const double distance : distances)
            for (int side = 0; side < 6; ++side)
                all.push_back({person,
                               camera(person, side * std::numbers::pi / 3 + 0.1, 0.4 * std::sin(7 * side), distance),
                               model.character.name + " from " + std::to_string(distance) + " m, side " +
                                   std::to_string(side) + ", clip " + std::to_string(person.slot)});
    return all;
}

}  // namespace reference
