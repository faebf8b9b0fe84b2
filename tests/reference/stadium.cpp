#include "tests/reference/stadium.h"

#include "tests/reference/studio.h"

namespace reference {

Stadium::Stadium(const tests::SmallScene& scene, int width, int height, const figures::Way& way)
    : scene_(scene),
      width_(width),
      height_(height),
      way_(way),
      structure_(scene::build_structure(scene.plan)),
      renderer_(make_renderer(way, structure_, scene::paint_ground(scene.plan), scene.figures(), width, height)),
      selector_(scene.crowd, scene.cast, scene.figures(), options_of(way)) {
    figures_.emplace_back(scene.person, scene::cast(scene.person).clips, &scene.points);
}

Frame Stadium::shoot(const scene::CameraPose& pose, const sfsm::Decision& decision, std::int64_t tick, bool darken) {
    const render::View view = render::make_view(pose, width_, height_);
    selector_.survey(view, tick, renderer_->begin(view));
    renderer_->draw(selector_.select(decision, tick - 1));
    Scene scene{{pose, width_, height_},
                {},
                &structure_,
                scene_.plan.oval,
                scene_.plan.stand_offset,
                decision.splat_size,
                samples_of(way_, decision.splat_size),
                way_.drawing == sfsm::Drawing::opengl};
    scene.people = people_of(scene_.crowd, scene_.cast, scene_.poses, figures_, scene.camera, decision, tick);
    if (way_.drawing == sfsm::Drawing::native)
        for (Person& person : scene.people) person.points = 0;
    for (Person& person : scene.people)
        if (!darken) person.shade = 0;
    return {renderer_->read_image(), draw(scene)};
}

std::vector<scene::CameraPose> Stadium::at_feet(std::int64_t tick) const {
    constexpr std::size_t most = 3;
    std::vector<scene::CameraPose> poses;
    for (std::size_t i = 0; i < scene_.crowd.size() && poses.size() < most; ++i) {
        if (!scene::follows_path(scene_.crowd.role[i])) continue;
        const glm::dvec3 feet = scene::place(scene_.crowd, i, scene_.cast[0], tick).position;
        const double away = 3 + 2 * static_cast<double>(poses.size());  // [m]
        const glm::dvec3 inward = glm::normalize(glm::dvec3(-feet.x, 0, -feet.z));
        poses.push_back({feet + away * inward + glm::dvec3(0, 1.7, 0), feet, glm::radians(25.0)});
    }
    return poses;
}

}  // namespace reference
