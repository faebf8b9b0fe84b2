// populate: athletes on the track, spectators on their seats.
#include "scene/places/stadium_crowd.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "scene/places/stadium_layout.h"
#include "sfsm/random.h"

namespace scene {

namespace {

using sfsm::hash;
using sfsm::mix;
using sfsm::triangle;
using sfsm::upper_unit;

// Athletes run in files, two a lane. A file has one character and one height, hence one speed, so that nobody ever
// runs through anybody. Runners have the inner lanes.
void add_athletes(Gathering& gathering, const Oval& track, std::uint32_t count) {
    constexpr std::uint32_t files = 2 * lane_count, runner_files = 10;
    constexpr std::uint32_t stride = 5;  // coprime to the number of files: few athletes spread over all lanes
    constexpr float inner_file = 0.32f, outer_file = 0.90f;  // [m] from the lane's inner line
    constexpr float clear_share = 0.3f;                      // of the distance to the next that is kept
    for (const Role role : {Role::runner, Role::walker}) {
        gathering.open_block();
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t file = i * stride % files;
            if ((file < runner_files) != (role == Role::runner)) continue;
            const std::uint64_t file_bits = gathering.bits(salt_lane, file);
            const std::uint32_t in_file = (count - i % files + files - 1) / files;
            const float offset = static_cast<float>(file / 2) * lane_width + (file % 2 == 0 ? inner_file : outer_file);
            const float slot = static_cast<float>(i / files) + upper_unit(mix(file_bits)) +
                               (1 - clear_share) * upper_unit(gathering.bits(salt_place, i));
            const float length = track.length(offset);
            const float arc = std::fmod(slot / static_cast<float>(in_file) * length, length);
            gathering.add({.position = {offset, 0, arc},
                           .height = draw_height(hash(file_bits, salt_height)),
                           .character = gathering.draw_character(file_bits),
                           .role = role,
                           .fans = {0.4f, 0.4f}});
        }
        gathering.close_block();
    }
}

// Marks the `count` elements with the smallest keys, ties by index: the same set on every machine.
template <typename Key>
std::vector<std::uint32_t> smallest(const std::vector<std::uint32_t>& of, std::size_t count, Key key) {
    std::vector<std::pair<decltype(key(0u)), std::uint32_t>> order;
    order.reserve(of.size());
    for (const std::uint32_t element : of) order.emplace_back(key(element), element);
    if (count < order.size())
        std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    std::vector<std::uint32_t> result;
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) result.push_back(order[i].second);
    return result;
}

// Which seats are taken: at random if most are, else those around the middle of the main straight's stand, with a
// few left free, so that a small crowd looks like one.
std::vector<std::uint32_t> choose_seats(const Gathering& gathering, const StadiumPlan& plan, std::size_t count) {
    constexpr float dense = 0.92f;  // of the seats of a small crowd's part of the stand are taken
    std::vector<std::uint32_t> seats(plan.seats.size());
    std::iota(seats.begin(), seats.end(), 0u);
    const std::size_t wanted = static_cast<std::size_t>(std::ceil(static_cast<float>(count) / dense));
    if (wanted < seats.size()) {
        const Row& row = plan.rows[plan.rows.size() / 3];
        const glm::vec3 focus(0, row.floor, plan.oval.radius + row.offset);
        seats = smallest(seats, wanted, [&](std::uint32_t seat) {
            const glm::vec3 away = plan.seats[seat].position - focus;
            return glm::dot(away, away);
        });
    }
    return smallest(seats, count, [&](std::uint32_t seat) { return gathering.bits(salt_seat, seat); });
}

// Who can't sit stands in front of the seat.
void take_seat(Gathering& gathering, const StadiumPlan& plan, std::uint32_t which) {
    constexpr float yaw_jitter = 0.12f;  // [rad]
    const Seat& seat = plan.seats[which];
    const std::uint64_t own = gathering.bits(salt_seat, which);
    const std::uint8_t character = gathering.draw_character(hash(own, salt_looks));
    const float height = draw_height(hash(own, salt_height));
    glm::vec3 position = seat.position;
    position.y += gathering.seat_lift(character, height);
    if (plan.room.seats && !gathering.audience.cast[character].sits)
        position += (hips_depth - stander_depth) * glm::vec3(std::sin(seat.yaw), 0, std::cos(seat.yaw));
    gathering.add({.position = position,
                   .yaw = seat.yaw + yaw_jitter * triangle(hash(own, salt_yaw)),
                   .height = height,
                   .character = character,
                   .role = Role::spectator,
                   .around = lap_fraction(plan.oval, position),
                   .fans = fans_at(plan.oval, {seat.position.x, seat.position.z})});
}

// Blocks are a section wide and up to `band_rows` rows deep: 150 to 400 people.
void add_spectators(Gathering& gathering, const StadiumPlan& plan, std::size_t count) {
    constexpr std::uint32_t band_rows = 12;
    const std::size_t bands = (plan.rows.size() + band_rows - 1) / band_rows;
    const std::vector<std::uint32_t> chosen = choose_seats(gathering, plan, count);
    // Counting sort by block; within one, seats keep their order only if they come in it.
    std::vector<std::uint32_t> first(plan.spokes.size() * bands + 1, 0);
    const auto block_of = [&](std::uint32_t seat) {
        return plan.seats[seat].section * bands + plan.seats[seat].row / band_rows;
    };
    for (const std::uint32_t seat : chosen) ++first[block_of(seat) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> sorted(chosen.size()), next(first.begin(), first.end() - 1);
    for (const std::uint32_t seat : chosen) sorted[next[block_of(seat)]++] = seat;
    for (std::size_t block = 0; block + 1 < first.size(); ++block) {
        std::sort(sorted.begin() + first[block], sorted.begin() + first[block + 1]);
        gathering.open_block();
        for (std::uint32_t i = first[block]; i < first[block + 1]; ++i) {
            take_seat(gathering, plan, sorted[i]);
        }
        gathering.close_block();
    }
}

}  // namespace

float lap_fraction(const Oval& oval, glm::vec3 position) {
    constexpr float typical_offset = 28.0f;  // [m] of a seat
    const float straight = 2.0f * oval.half_straight;
    const float half_lap = straight + pi * (oval.radius + typical_offset);
    const bool second_half = position.x < -oval.half_straight || (position.x < oval.half_straight && position.z < 0);
    const float x = second_half ? -position.x : position.x, z = second_half ? -position.z : position.z;
    float arc = x + oval.half_straight;
    if (x >= oval.half_straight) {
        const float beyond = x - oval.half_straight;
        const float turn = 0.5f - 0.5f * z / std::fmax(beyond + std::fabs(z), 1e-3f);
        arc = straight + turn * (half_lap - straight);
    }
    const float half = 0.5f * std::clamp(arc / half_lap, 0.0f, 0x1.fffffep-1f);
    return second_half ? 0.5f + half : half;
}

// Home fans own the bend at +x, away fans a part of the one at -x, and both are guests elsewhere.
Fans fans_at(const Oval& oval, glm::vec2 xz) {
    constexpr Fans home_end{0.78f, 0.01f}, away_end{0.04f, 0.8f}, elsewhere{0.24f, 0.06f};
    if (xz.x > oval.half_straight) return home_end;
    if (xz.x < -oval.half_straight && xz.y < 0) return away_end;
    return elsewhere;
}

Crowd populate(const StadiumPlan& plan, const Audience& audience) {
    Gathering gathering(audience, std::make_shared<Oval>(plan.oval));
    const std::int64_t athletes = athlete_count(audience.people);
    const std::int64_t seated = std::min(audience.people - athletes, static_cast<std::int64_t>(plan.seats.size()));
    add_athletes(gathering, plan.oval, static_cast<std::uint32_t>(athletes));
    add_spectators(gathering, plan, static_cast<std::size_t>(seated));
    add_standing(gathering, plan, audience.people - athletes - seated);
    return std::move(gathering.crowd);
}

}  // namespace scene
