#include "tests/bench/loss/shares.h"

#include <algorithm>

#include "render/crowding.h"

namespace bench::loss {

namespace {

constexpr float large = 4000;  // [px^2] surfaces of whom it counts how much is beside the picture
constexpr float breadth = 0.4f;

// Of a length around `at`, told from the middle of a picture.
float overlap(float at, float side, float picture) {
    const float low = std::max(at - 0.5f * side, -0.5f * picture), end = std::min(at + 0.5f * side, 0.5f * picture);
    return std::max(end - low, 0.0f) / side;
}

float on_screen(const render::Person& person, const motion::PoseTable& poses, const render::View& view) {
    const float scale = person.instance.scale, pixels = view.pixels_per_metre(person.depth);
    const glm::vec3 middle = person.instance.position + scale * glm::vec3(0.0f, poses.box.center().y, 0.0f);
    const float high = scale * poses.rest_height * pixels;
    return overlap(pixels * glm::dot(view.right, middle), breadth * high, static_cast<float>(view.width)) *
           overlap(pixels * glm::dot(view.up, middle), high, static_cast<float>(view.height));
}

}  // namespace

std::vector<float> visible_shares(const apps::Stage& stage, const render::View& view) {
    const scene::Crowd& crowd = stage.place.crowd;
    std::vector<float> shares;
    for (const scene::CrowdBlock& block : crowd.blocks) {
        render::Crowding crowding;
        float silhouettes = 0;
        bool stays = true;
        for (std::size_t i = block.first; i < block.first + block.count; ++i) {
            const motion::PoseTable& poses = stage.poses[crowd.character[i]];
            const float scale = crowd.height[i] / poses.rest_height;
            crowding.add(crowd.position[i] + scale * glm::vec3(0.0f, poses.box.center().y, 0.0f), crowd.height[i]);
            silhouettes += 0.25f * poses.area * scale * scale;
            stays &= !scene::follows_path(crowd.role[i]);
        }
        const glm::vec3 away = render::relative(block.box.center(), view.position - block.origin);
        shares.push_back(stays ? crowding.visible_share(away, silhouettes / static_cast<float>(block.count)) : 1);
    }
    return shares;
}

double shown_of(const render::Person& person, const apps::Stage& stage, const render::View& view, float share) {
    const motion::PoseTable& poses = stage.poses[person.character];
    const float pixels = person.instance.scale * view.pixels_per_metre(person.depth);
    const float surface = poses.area * pixels * pixels;
    return static_cast<double>(0.25f * surface * share * (surface > large ? on_screen(person, poses, view) : 1));
}

}  // namespace bench::loss
