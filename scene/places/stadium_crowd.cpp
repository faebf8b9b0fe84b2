// populate: who is where.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "scene/gathering.h"
#include "scene/places/stadium_layout.h"
#include "scene/random.h"

namespace scene {

namespace {

// In [-1, 1), more often near 0.
float draw_triangle(std::uint64_t bits) {
    return unit(bits) + unit(mix(bits)) - 1.0f;
}

// How far around the stands somebody sits, in [0, 1) from the start of the straight at +z, evenly along straights
// and nearly so in bends.
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
            const float slot = static_cast<float>(i / files) + unit(mix(file_bits)) +
                               (1 - clear_share) * unit(gathering.bits(salt_place, i));
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
                   .yaw = seat.yaw + yaw_jitter * draw_triangle(hash(own, salt_yaw)),
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

// Smooth noise in [0, 1] over the plane: people cluster.
float clustering(const Gathering& gathering, glm::vec2 xz) {
    constexpr float wavelength = 9.0f;  // [m]
    const glm::vec2 cell = glm::floor(xz / wavelength);
    const glm::vec2 t = xz / wavelength - cell;
    const glm::vec2 ease = t * t * (3.0f - 2.0f * t);
    const auto corner = [&](int i, int j) {
        const std::uint64_t x = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x) + i);
        const std::uint64_t z = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y) + j);
        return unit(hash(gathering.bits(salt_density, x), z));
    };
    return glm::mix(glm::mix(corner(0, 0), corner(1, 0), ease.x), glm::mix(corner(0, 1), corner(1, 1), ease.x), ease.y);
}

// Places on the ground come in square cells, each of which becomes a block.
constexpr int cell_places = 16;  // a side

float cell_size(const StadiumPlan& plan) {
    return static_cast<float>(cell_places) * standing_pitch(plan.room);
}

struct Cell {
    std::int32_t x, z;
};

// Where people may stand: free of the track and of what is built.
enum class Ground { infield, plaza };

bool is_free(const StadiumPlan& plan, Ground ground, glm::vec2 xz, float offset) {
    if (ground == Ground::infield) return offset < -infield_margin;
    if (offset < plan.outer_offset + plaza_margin) return false;
    constexpr float mast_clearance = 2.0f;  // [m]
    for (int light = 0; light < floodlight_count; ++light) {
        if (glm::distance(xz, floodlight_foot(plan, light)) < mast_clearance) return false;
    }
    return true;
}

// A place somebody stands at: where, how far out, and random bits of its own.
struct StandingPlace {
    glm::vec2 xz;
    float offset;
    std::uint64_t bits;
};

// Calls `visit` for each taken place of a cell.
template <typename Visit>
void for_each_place(const Gathering& gathering, const StadiumPlan& plan, Ground ground, Cell cell, Visit visit) {
    constexpr float share_swing = 0.2f;  // clusters take up to so much more or less of the places than on average
    const float pitch = standing_pitch(plan.room);
    for (int place = 0; place < cell_places * cell_places; ++place) {
        const int column = cell.x * cell_places + place % cell_places;
        const int row = cell.z * cell_places + place / cell_places;
        const std::uint64_t bits =
            hash(gathering.bits(salt_place, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
        const glm::vec2 jitter(2.0f * unit(bits) - 1.0f, 2.0f * unit(mix(bits)) - 1.0f);
        const glm::vec2 xz = pitch * (glm::vec2(column, row) + 0.5f) + standing_jitter * jitter;
        const float share = standing_share + share_swing * (2.0f * clustering(gathering, xz) - 1.0f);
        if (unit(hash(bits, salt_density)) >= share) continue;
        const float offset = plan.oval.offset_of(xz);
        if (is_free(plan, ground, xz, offset)) visit(StandingPlace{xz, offset, bits});
    }
}

// The cells that reach between two parallels of the oval.
std::vector<Cell> cells_between(const StadiumPlan& plan, float inner, float outer) {
    const Oval& oval = plan.oval;
    const float size = cell_size(plan);
    const float reach = size;  // more than from a cell's centre to its corners, and jitter
    const int columns = static_cast<int>((oval.half_straight + oval.radius + outer + reach) / size) + 1;
    const int rows = static_cast<int>((oval.radius + outer + reach) / size) + 1;
    std::vector<Cell> cells;
    for (int z = -rows; z < rows; ++z) {
        for (int x = -columns; x < columns; ++x) {
            const float offset = oval.offset_of(size * (glm::vec2(x, z) + 0.5f));
            if (offset > inner - reach && offset < outer + reach) cells.push_back({x, z});
        }
    }
    return cells;
}

// How far out people stand if the innermost places are taken: all bins below `bin`, and `in_bin` places of that one.
struct Cut {
    std::size_t bin = 0;
    std::int64_t in_bin = 0;
};

constexpr float bin_width = 0.25f;  // [m] of distance

std::size_t bin_of(const Oval& oval, float offset) {
    return static_cast<std::size_t>(std::fmax(offset + oval.radius, 0.0f) / bin_width);
}

// The cut that leaves at most `wanted` of the cells' places. Two passes over places, each a function of its number,
// take less than sorting them.
Cut cut_after(const Gathering& gathering, const StadiumPlan& plan, Ground ground, const std::vector<Cell>& cells,
              std::int64_t wanted) {
    std::vector<std::int64_t> bins;
    for (const Cell& cell : cells) {
        for_each_place(gathering, plan, ground, cell, [&](const StandingPlace& place) {
            const std::size_t bin = bin_of(plan.oval, place.offset);
            if (bin >= bins.size()) bins.resize(bin + 1, 0);
            ++bins[bin];
        });
    }
    Cut cut{0, wanted};
    while (cut.bin < bins.size() && bins[cut.bin] <= cut.in_bin) cut.in_bin -= bins[cut.bin++];
    return cut;
}

void stand(Gathering& gathering, const Oval& oval, const StandingPlace& place) {
    constexpr float yaw_jitter = 0.6f;  // [rad]
    const float to_center = std::atan2(-place.xz.x, -place.xz.y);
    const glm::vec3 feet(place.xz.x, 0, place.xz.y);
    gathering.add({.position = feet,
                   .yaw = to_center + yaw_jitter * draw_triangle(hash(place.bits, salt_yaw)),
                   .height = draw_height(hash(place.bits, salt_height)),
                   .character = gathering.draw_character(hash(place.bits, salt_looks)),
                   .role = Role::standing,
                   .around = lap_fraction(oval, feet),
                   .fans = {0.3f, 0.1f}});
}

// Puts up to `wanted` people on the innermost places between two parallels; returns how many found one.
std::int64_t fill_ground(Gathering& gathering, const StadiumPlan& plan, Ground ground, float inner, float outer,
                         std::int64_t wanted) {
    if (wanted == 0) return 0;
    const Oval& oval = plan.oval;
    const std::vector<Cell> cells = cells_between(plan, inner, outer);
    Cut cut = cut_after(gathering, plan, ground, cells, wanted);
    const std::size_t before = gathering.crowd.size();
    for (const Cell& cell : cells) {
        gathering.open_block();
        for_each_place(gathering, plan, ground, cell, [&](const StandingPlace& place) {
            const std::size_t bin = bin_of(oval, place.offset);
            if (bin < cut.bin || (bin == cut.bin && cut.in_bin-- > 0)) stand(gathering, oval, place);
        });
        gathering.close_block();
    }
    return static_cast<std::int64_t>(gathering.crowd.size() - before);
}

void add_standing(Gathering& gathering, const StadiumPlan& plan, std::int64_t left) {
    left -= fill_ground(gathering, plan, Ground::infield, -plan.oval.radius, -infield_margin, left);
    if (left == 0) return;
    // Some more than the plan's estimate, which knows densities only on average.
    constexpr float spare = 30.0f;  // [m]
    left -= fill_ground(gathering, plan, Ground::plaza, plan.outer_offset, plan.crowd_offset + spare, left);
    assert(left == 0);
}

}  // namespace

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
