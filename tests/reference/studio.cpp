#include "tests/reference/studio.h"

#include <algorithm>
#include <cmath>

namespace reference {

Model::Model(model::Character from, std::vector<int> played, std::size_t point_count)
    : character(std::move(from)), clips(std::move(played)), figure(character, clips, &points) {
    constexpr std::size_t poses_to_cover = 4, byte_budget = std::size_t{1} << 27;
    const std::vector<pointsample::PosedMesh> spread = pointsample::spread_poses(character, clips, poses_to_cover);
    points = pointsample::sample(character.mesh, spread, {.count = point_count});
    poses = motion::bake_poses(character, clips, points.surface, byte_budget);
}

render::Selection selection_of(std::span<const Person> people, std::span<const Model* const> models,
                               const render::View& view) {
    constexpr double snorm = 32767;
    render::Selection selection;
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
        selection.batches.push_back({character, pose, static_cast<std::uint32_t>(person.points),
                                     static_cast<std::uint32_t>(selection.instances.size()), 1});
        selection.instances.push_back(instance);
    }
    return selection;
}

}  // namespace reference
