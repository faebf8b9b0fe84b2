// Dimensions that seating, structure, crowd and cameras have to agree on. Internal to the stadium.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

#include "scene/places/stadium.h"

namespace scene {

inline constexpr float pi = std::numbers::pi_v<float>;

// Track. World Athletics' lanes, measured outward from the inner line.
inline constexpr int lane_count = 8;
inline constexpr float lane_width = 1.22f;  // [m]
inline constexpr float track_width = static_cast<float>(lane_count) * lane_width;

// Stands.
inline constexpr float wall_offset = 13.0f;  // [m] face of the wall between track and stands: 3 m of run-off
inline constexpr float first_row_offset = 14.0f;
inline constexpr float first_floor = 1.2f;      // [m] height of the walkway and the first row
inline constexpr float parapet_height = 0.45f;  // [m] above the walkway behind it
inline constexpr float parapet_depth = 0.2f;    // [m]
inline constexpr float hips_depth = 0.61f;      // [m] from the tread's front edge: backs lean 0.15 m, toes reach 0.56 m
inline constexpr float stander_depth = 0.18f;   // [m] the same for who stands in front of the seat
inline constexpr float aisle_width = 1.2f;      // [m]
inline constexpr float concourse_depth = 2.4f;  // [m] walkway between the tiers
inline constexpr float concourse_height = 2.6f;    // [m] from that walkway to the first row above it
inline constexpr float rim_above_last_row = 1.4f;  // [m] the outer wall shields the last row's back
inline constexpr float back_walkway = 1.6f;        // [m] from the last tread's back to the outer wall

// Masts of the floodlights, on the plaza.
inline constexpr int floodlight_count = 4;
inline constexpr float floodlight_distance = 7.0f;  // [m] beyond the outer wall
inline constexpr float floodlight_height = 20.0f;   // [m] above the rim

// How tightly people stand outside their seats: a jittered grid of which a part is left free.
inline constexpr float standing_jitter = 0.15f;  // [m] each way and axis: neighbours stay 0.45 m apart
inline constexpr float standing_share = 0.8f;    // of the grid's places taken, on average
inline constexpr float infield_margin = 1.5f;    // [m] inside the track's inner line
inline constexpr float plaza_margin = 2.5f;      // [m] outside the outer wall

// [m] between the grid's places: three quarters of a metre, or what the crowd's own kind needs.
inline float standing_pitch(const Room& room) {
    return std::fmax(0.75f, 0.5f * (room.width + room.depth));
}

// One in a hundred is an athlete, as long as the track has room to run.
inline std::int64_t athlete_count(std::int64_t people) {
    return people / 100 < 200 ? people / 100 : 200;
}

// The four floodlights stand on the diagonals of the bends.
inline glm::vec2 floodlight_foot(const StadiumPlan& plan, int light) {
    const float x = light % 2 == 0 ? 1.0f : -1.0f, z = light < 2 ? 1.0f : -1.0f;
    const float reach = (plan.oval.radius + plan.outer_offset + floodlight_distance) * std::numbers::sqrt2_v<float> / 2;
    return {x * (plan.oval.half_straight + reach), z * reach};
}

}  // namespace scene
