#include "scene/openness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/light.h"

namespace scene {

namespace {

constexpr int places = 4, directions = 48;  // on the surface; equally much light comes from each
// What hides the sky is lit by what lies below it.
constexpr float light_of_cover = 0.3f;  // of the sky's
// What is so far off sends half of what it would in the open: nearer, one keeps the light from the other.
constexpr float half_light_distance = 0.5f;  // [m]

constexpr float nowhere = std::numeric_limits<float>::infinity();

float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// [m] along the unit ray to the line.
float distance_to(const SectionLine& line, glm::vec2 from, glm::vec2 ray) {
    const glm::vec2 along = line.to - line.from, there = line.from - from;
    const float turn = cross(ray, along);
    if (turn == 0) return nowhere;
    const float distance = cross(there, along) / turn, share = cross(there, ray) / turn;
    return distance > 0 && share >= 0 && share <= 1 ? distance : nowhere;
}

// Of what would come from there in the open.
float light_from(glm::vec2 from, glm::vec2 ray, std::span<const SectionLine> lines) {
    float open = 1, nearest = nowhere;
    for (const SectionLine& line : lines) {
        const float distance = distance_to(line, from, ray);
        if (distance == nowhere) continue;
        open *= 1 - line.stops;
        nearest = std::min(nearest, distance);
    }
    if (nearest == nowhere) return 1;
    const float sent = nearest / (nearest + half_light_distance);
    return open + (1 - open) * sent * (ray.y > 0 ? light_of_cover : 1.0f);
}

}  // namespace

float openness(glm::vec2 from, glm::vec2 to, std::span<const SectionLine> lines) {
    constexpr float off = 1e-3f;  // [m] the surface doesn't hide itself
    constexpr glm::vec3 luminance(0.2126f, 0.7152f, 0.0722f);
    const Light daylight;
    const float above = glm::dot(luminance, daylight.from_above), below = glm::dot(luminance, daylight.from_below);
    const glm::vec2 along = glm::normalize(to - from), normal(-along.y, along.x);
    float got = 0, in_the_open = 0;
    for (int place = 0; place < places; ++place) {
        const glm::vec2 at = glm::mix(from, to, (static_cast<float>(place) + 0.5f) / places) + off * normal;
        for (int i = 0; i < directions; ++i) {
            const float sine = (2 * static_cast<float>(i) + 1) / directions - 1;
            const glm::vec2 ray = sine * along + std::sqrt(1 - sine * sine) * normal;
            const float light = ray.y > 0 ? above : below;
            got += light * light_from(at, ray, lines);
            in_the_open += light;
        }
    }
    return got / in_the_open;
}

}  // namespace scene
