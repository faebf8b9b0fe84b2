// plan_stadium: rows high enough to see over the row in front, cut into sections by aisles.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/places/stadium_layout.h"

namespace scene {

namespace {

constexpr int min_rows = 8, max_rows = 60;
constexpr int max_rows_in_one_tier = 18;
constexpr float lower_tier_share = 0.45f;  // of the rows, when there are two tiers
constexpr int min_rows_under_roof = 14;    // smaller stadiums have a rim
constexpr float roofed_share = 0.32f;      // of the stand's depth
constexpr float roof_clearance = 5.5f;     // [m] from the last row to the roof's outer edge
constexpr float roof_slope = 0.08f;        // rising inward
constexpr float section_length = 12.0f;    // [m] about 20 seats between aisles, halfway up
constexpr float filled_share = 0.975f;     // of the seats at most, by the people planned for

// Sightlines: everybody sees the middle of the track over the head in front. The riser that gives a clearance C is
// N = (R + C)(D + T) / D - R with the eye R above and D behind the focus and treads of depth T (Green Guide, 6th ed.).
constexpr float c_value = 0.09f;    // [m] over the head in front: "good"
constexpr float eye_height = 1.2f;  // [m] of a seated spectator
constexpr float focus_offset = track_width / 2;
constexpr float min_riser = 0.35f, max_riser = 0.55f;  // [m] shallower wastes height, steeper is unsafe

float riser_above(const Row& row, float row_depth) {
    const float eye = row.floor + eye_height;
    const float distance = row.offset + hips_depth - focus_offset;
    const float riser = (eye + c_value) * (distance + row_depth) / distance - eye;
    return std::clamp(riser, min_riser, max_riser);
}

std::uint32_t lower_tier_rows(int rows) {
    if (rows <= max_rows_in_one_tier) return static_cast<std::uint32_t>(rows);
    return static_cast<std::uint32_t>(std::lround(lower_tier_share * static_cast<float>(rows)));
}

std::vector<Row> stack_rows(int count, std::uint32_t lower_rows, float row_depth) {
    std::vector<Row> rows{{first_row_offset, first_floor, 0, 0}};
    while (rows.size() < static_cast<std::size_t>(count)) {
        Row next = rows.back();
        next.offset += row_depth;
        if (rows.size() == lower_rows) {
            next.offset += concourse_depth;
            next.floor += concourse_height;
        } else {
            next.floor += riser_above(rows.back(), row_depth);
        }
        rows.push_back(next);
    }
    return rows;
}

// Spokes at equal steps along each straight and around each bend, so that sections are about section_length long
// at `offset`.
std::vector<Spoke> lay_spokes(const Oval& oval, float offset) {
    const float straight = 2.0f * oval.half_straight, bend = pi * (oval.radius + offset);
    const int on_straight = static_cast<int>(std::lround(straight / section_length));
    const int in_bend = 2 * static_cast<int>(std::lround(bend / section_length / 2));
    std::vector<Spoke> spokes;
    const auto add = [&](float arc) { spokes.push_back({oval.position(arc, 0), oval.outward(arc, 0)}); };
    const float half_lap = oval.length(0) / 2;
    for (int half = 0; half < 2; ++half) {
        const float start = static_cast<float>(half) * half_lap;
        for (int i = 0; i < on_straight; ++i) {
            add(start + straight * static_cast<float>(i) / static_cast<float>(on_straight));
        }
        for (int i = 0; i < in_bend; ++i) {
            add(start + straight + pi * oval.radius * static_cast<float>(i) / static_cast<float>(in_bend));
        }
    }
    return spokes;
}

// The seats of one row between two spokes, an aisle's half width away from both.
void seat_section(StadiumPlan& plan, std::size_t row, std::size_t section) {
    const float offset = plan.rows[row].offset + (plan.room.seats ? hips_depth : plan.room.depth / 2);
    const float seat_pitch = plan.room.width;
    const glm::vec2 from = plan.spokes[section].at(offset);
    const glm::vec2 to = plan.spokes[(section + 1) % plan.spokes.size()].at(offset);
    const float length = glm::distance(from, to);
    const glm::vec2 along = (to - from) / length;
    const float yaw = std::atan2(along.y, -along.x);  // inward: the tangent turned left
    const int count = static_cast<int>((length - aisle_width) / seat_pitch);
    const float margin = (length - static_cast<float>(count - 1) * seat_pitch) / 2;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 xz = from + (margin + static_cast<float>(i) * seat_pitch) * along;
        plan.seats.push_back({{xz.x, plan.rows[row].floor, xz.y},
                              yaw,
                              static_cast<std::uint16_t>(row),
                              static_cast<std::uint16_t>(section)});
    }
}

void seat_rows(StadiumPlan& plan) {
    for (std::size_t row = 0; row < plan.rows.size(); ++row) {
        plan.rows[row].first_seat = static_cast<std::uint32_t>(plan.seats.size());
        for (std::size_t section = 0; section < plan.spokes.size(); ++section) seat_section(plan, row, section);
        plan.rows[row].seat_count = static_cast<std::uint32_t>(plan.seats.size()) - plan.rows[row].first_seat;
    }
}

Roof cover(const StadiumPlan& plan) {
    const Row& last = plan.rows.back();
    Roof roof{plan.outer_offset, plan.outer_offset, 0, last.floor + rim_above_last_row};
    if (plan.rows.size() >= min_rows_under_roof) {
        const float depth = roofed_share * (plan.outer_offset - plan.stand_offset);
        roof.inner_offset -= depth;
        roof.outer_height = last.floor + roof_clearance;
        roof.inner_height = roof.outer_height + roof_slope * depth;
    } else {
        roof.inner_height = roof.outer_height;
    }
    return roof;
}

// [m^2] between two parallels of the oval.
float area_between(const Oval& oval, float inner, float outer) {
    const float a = oval.radius + inner, b = oval.radius + outer;
    return pi * (b * b - a * a) + 4.0f * oval.half_straight * (b - a);
}

// Solves area_between(plaza's edge, x) = what those who find neither seat nor grass need.
float extent_of_crowd(const StadiumPlan& plan) {
    const float pitch = standing_pitch(plan.room);
    const float people_per_m2 = standing_share / (pitch * pitch);
    const Oval& oval = plan.oval;
    const float infield = people_per_m2 * area_between(oval, -oval.radius, -infield_margin);
    const double standing = static_cast<double>(plan.people - athlete_count(plan.people)) -
                            static_cast<double>(plan.seats.size()) - static_cast<double>(infield);
    if (standing <= 0) return plan.outer_offset;
    const double inner = oval.radius + plan.outer_offset + plaza_margin;
    const double half_b = 2.0 * oval.half_straight / pi;
    const double target = inner * inner + 2.0 * half_b * inner + standing / people_per_m2 / pi;
    return static_cast<float>(std::sqrt(target + half_b * half_b) - half_b) - oval.radius;
}

StadiumPlan plan_with_rows(int rows, const Room& room) {
    StadiumPlan plan;
    plan.room = room;
    plan.lower_rows = lower_tier_rows(rows);
    plan.rows = stack_rows(rows, plan.lower_rows, room.depth);
    plan.stand_offset = plan.rows.front().offset;
    const float stand_back = plan.rows.back().offset + room.depth;
    plan.outer_offset = stand_back + back_walkway;
    plan.spokes = lay_spokes(plan.oval, (plan.stand_offset + stand_back) / 2);
    seat_rows(plan);
    plan.roof = cover(plan);
    plan.rim_height = std::max(plan.roof.inner_height, plan.roof.outer_height);
    return plan;
}

}  // namespace

StadiumPlan plan_stadium(std::int64_t people, const Room& room) {
    assert(people >= 1);
    const double wanted = static_cast<double>(people - athlete_count(people)) / filled_share;
    int rows = min_rows;
    StadiumPlan plan = plan_with_rows(rows, room);
    while (rows < max_rows && static_cast<double>(plan.seats.size()) < wanted) plan = plan_with_rows(++rows, room);
    plan.people = people;
    plan.crowd_offset = extent_of_crowd(plan);
    return plan;
}

}  // namespace scene
