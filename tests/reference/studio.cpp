#include "tests/reference/studio.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "figures/way.h"

namespace reference {

Model::Model(model::Character from, std::vector<int> played, std::size_t point_count)
    : character(std::move(from)), clips(std::move(played)), figure(character, clips, &points) {
    constexpr std::size_t poses_to_cover = 4, byte_budget = std::size_t{1} << 27;
    const std::vector<pointsample::PosedMesh> spread = pointsample::spread_poses(character, clips, poses_to_cover);
    points = pointsample::sample(character.mesh, spread, {.count = point_count});
    poses = motion::bake_poses(character, clips, points.surface, byte_budget);
}

namespace {

// The level that a person of so many points is drawn at; of none, triangles.
std::pair<std::uint32_t, figures::Level> level_of(const figures::Figure& figure, std::size_t points) {
    const auto all = figures::by_opengl().representations;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        for (const figures::Level& level : all[i].levels(figure))
            if (points == 0 ? all[i].is_mesh : !all[i].is_mesh && level.count == points) return {i, level};
    }
    throw std::logic_error("no level of " + std::to_string(points) + " points");
}

}  // namespace

render::Frame frame_of(std::span<const Person> people, std::span<const Model* const> models, const render::View& view,
                       double splat_size) {
    constexpr double snorm = 32767;
    render::Frame frame;
    frame.view = view;
    frame.splat_size = splat_size;
    for (const Person& person : people) {
        render::Instance instance;
        instance.position = glm::vec3(person.origin - view.position);
        instance.scale = static_cast<float>(person.scale);
        instance.sin_yaw = static_cast<std::int16_t>(std::lround(snorm * std::sin(person.yaw)));
        instance.cos_yaw = static_cast<std::int16_t>(std::lround(snorm * std::cos(person.yaw)));
        instance.palette = person.palette;
        const auto of = std::find_if(models.begin(), models.end(),
                                     [&](const Model* model) { return &model->figure == person.figure; });
        const auto character = static_cast<std::uint32_t>(of - models.begin());
        const auto pose = static_cast<std::uint32_t>((*of)->poses.pose_at(person.slot, person.tick));
        const auto [representation, level] = level_of((*of)->product(), person.points);
        const std::uint32_t batch = frame.batch_numbers++;
        frame.people.push_back({instance, character, representation, level.first, level.count, 1.0f, pose, batch,
                                view.depth(instance.position)});
    }
    return frame;
}

}  // namespace reference
