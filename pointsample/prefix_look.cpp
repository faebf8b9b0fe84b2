#include "pointsample/prefix_look.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointsample {

float squared_distance(const PointModel& model, std::size_t a, std::size_t b) {
    constexpr float opposed = 2.0f * 2.0f;  // distances are squared
    const glm::vec3 apart = model.positions[a] - model.positions[b];
    const bool faces_away = glm::dot(model.normals[a], model.normals[b]) < 0.0f;
    return glm::dot(apart, apart) * (faces_away ? opposed : 1.0f);
}

std::size_t nearest_of_prefix(const PointModel& model, std::size_t point, std::size_t count) {
    std::size_t best = 0;
    float best_distance = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        const float distance = squared_distance(model, i, point);
        if (distance >= best_distance) continue;
        best_distance = distance;
        best = i;
    }
    return best;
}

namespace {

struct Sum {
    glm::vec3 light{0.0f};                             // the shaders' linear: sRGB squared, each in [0, 1]
    std::array<float, 1 + model::slot_count> slots{};  // points of each, no_slot first
    glm::vec3 emitted{0.0f};
    float seen_anyway = 0;  // of the light's channels together, what is seen in any light and shade
    float points = 0;
};

std::uint8_t unorm8(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0f * value));
}

PrefixLook mean(const Sum& sum) {
    const glm::vec3 color = glm::sqrt(sum.light / sum.points);
    PrefixLook look{{unorm8(color.r), unorm8(color.g), unorm8(color.b), 255}, {}, {}};
    for (std::size_t i = 0; i < look.shares.size(); ++i) look.shares[i] = unorm8(sum.slots[i + 1] / sum.points);
    const glm::vec3 emitted = glm::sqrt(sum.emitted / sum.points);
    look.own_light = {unorm8(emitted.r), unorm8(emitted.g), unorm8(emitted.b), 0};
    const float light = sum.light.r + sum.light.g + sum.light.b;
    if (light > 0.0f) look.own_light.a = unorm8(std::min(sum.seen_anyway / light, 1.0f));
    return look;
}

}  // namespace

std::vector<PrefixLook> prefix_looks(const PointModel& model, std::size_t count) {
    std::vector<Sum> sums(count);
    for (std::size_t point = 0; point < model.size(); ++point) {
        // A prefix point is its own nearest, so that no sum stays empty.
        Sum& sum = sums[point < count ? point : nearest_of_prefix(model, point, count)];
        const glm::vec3 color = glm::vec3(model.colors[point]) / 255.0f;
        const glm::vec3 light = color * color;
        sum.light += light;
        if (!model.own_lights.empty()) {
            const glm::vec4 own = glm::vec4(model.own_lights[point]) / 255.0f;
            sum.emitted += glm::vec3(own * own);
            sum.seen_anyway += (light.r + light.g + light.b) * own.a;
        }
        sum.slots[model.slots[point]] += 1.0f;
        sum.points += 1.0f;
    }
    std::vector<PrefixLook> looks;
    looks.reserve(count);
    for (const Sum& sum : sums) looks.push_back(mean(sum));
    return looks;
}

}  // namespace pointsample
