#include "scene/places/oval.h"

#include <cmath>
#include <numbers>

namespace scene {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Where on the oval an arc lies: on a straight (bend = 0) `along` its middle, or in the bend at bend = +1 (+x) or
// -1, `angle` after its start.
struct Station {
    int bend = 0;
    float along = 0;  // [m] from the middle of the straight, in the direction of running
    float side = 1;   // +1: the straight at +z, -1: at -z
    float angle = 0;  // [rad] in [0, pi]
};

Station station(const Oval& oval, float arc, float offset) {
    const float straight = 2.0f * oval.half_straight;
    const float bend_radius = oval.radius + offset;
    const float half_lap = straight + pi * bend_radius;
    float rest = std::fmod(arc, 2.0f * half_lap);
    if (rest < 0) rest += 2.0f * half_lap;
    const bool second_half = rest >= half_lap;
    if (second_half) rest -= half_lap;
    Station result;
    result.side = second_half ? -1.0f : 1.0f;
    if (rest <= straight) {
        result.along = rest - oval.half_straight;
    } else {
        result.bend = second_half ? -1 : 1;
        result.angle = (rest - straight) / bend_radius;
    }
    return result;
}

glm::vec2 outward_at(const Station& at) {
    if (at.bend == 0) return {0.0f, at.side};
    return static_cast<float>(at.bend) * glm::vec2(std::sin(at.angle), std::cos(at.angle));
}

}  // namespace

float Oval::length(float offset) const {
    return 4.0f * half_straight + 2.0f * pi * (radius + offset);
}

glm::vec2 Oval::position(float arc, float offset) const {
    const Station at = station(*this, arc, offset);
    const float centre = at.bend == 0 ? at.side * at.along : static_cast<float>(at.bend) * half_straight;
    return glm::vec2(centre, 0.0f) + (radius + offset) * outward_at(at);
}

glm::vec2 Oval::outward(float arc, float offset) const {
    return outward_at(station(*this, arc, offset));
}

glm::vec2 Oval::tangent(float arc, float offset) const {
    const glm::vec2 out = outward(arc, offset);
    return {out.y, -out.x};
}

float Oval::turning(float offset) const {
    return 1.0f / (radius + offset);
}

motion::Bounds Oval::bounds(float offset) const {
    const float bend_radius = radius + offset;
    const glm::vec3 reach(half_straight + bend_radius, 0, bend_radius);
    return {-reach, reach};
}

float Oval::offset_of(glm::vec2 xz) const {
    const float beyond = std::fmax(std::fabs(xz.x) - half_straight, 0.0f);
    return std::hypot(beyond, xz.y) - radius;
}

}  // namespace scene
