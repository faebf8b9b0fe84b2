// populate: who is where. place and act: what they do, as arithmetic on their number and the tick.
#include "scene/crowd.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "motion/schedule.h"
#include "scene/layout.h"
#include "scene/random.h"

namespace scene {

namespace {

// ---------------------------------------------------------------------------------------------------- looks

// What a random number is for. Distinct values keep choices independent of each other.
enum Salt : std::uint64_t {
    salt_person = 1,
    salt_seat,
    salt_lane,
    salt_place,
    salt_density,
    salt_looks,
    salt_height,
    salt_yaw,
    salt_phase,
    salt_act,
    salt_mood,
    salt_wave,
};

constexpr glm::u8vec4 rgb(int red, int green, int blue) {
    return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue), 255};
}

constexpr std::array skins{rgb(255, 222, 200), rgb(241, 200, 172), rgb(226, 180, 148), rgb(203, 152, 116),
                           rgb(172, 118, 84),  rgb(138, 90, 62),   rgb(104, 66, 46),   rgb(74, 48, 36)};
// From black to white; who is darker than the first `fair_skins` has one of the first `dark_hairs`.
constexpr std::array hairs{rgb(24, 20, 18),    rgb(38, 28, 22),   rgb(58, 40, 28),    rgb(84, 58, 38),
                           rgb(112, 80, 50),   rgb(168, 130, 78), rgb(206, 172, 112), rgb(140, 66, 34),
                           rgb(150, 148, 144), rgb(214, 212, 208)};
constexpr std::uint32_t fair_skins = 4, dark_hairs = 4;
constexpr std::array casual_shirts{rgb(240, 240, 236), rgb(34, 36, 40),    rgb(98, 104, 112), rgb(30, 52, 96),
                                   rgb(70, 120, 176),  rgb(150, 190, 220), rgb(44, 94, 66),   rgb(122, 146, 84),
                                   rgb(236, 196, 84),  rgb(224, 124, 54),  rgb(150, 42, 50),  rgb(204, 150, 160),
                                   rgb(110, 70, 120),  rgb(196, 178, 150), rgb(120, 86, 62),  rgb(62, 132, 140)};
constexpr std::array home_shirts{rgb(200, 28, 44), rgb(182, 20, 36), rgb(214, 50, 58), rgb(244, 242, 240)};
constexpr std::array away_shirts{rgb(248, 206, 40), rgb(238, 190, 24), rgb(252, 222, 92), rgb(26, 70, 150)};
constexpr std::array trousers{rgb(44, 62, 96), rgb(58, 82, 122),   rgb(30, 40, 62),   rgb(28, 28, 32),
                              rgb(66, 68, 74), rgb(172, 150, 112), rgb(134, 112, 82), rgb(84, 92, 70)};

template <std::size_t N>
glm::u8vec4 pick(const std::array<glm::u8vec4, N>& from, std::uint64_t bits) {
    return from[below(bits, static_cast<std::uint32_t>(N))];
}

// How many of those around wear a team's colours, in [0, 1].
struct Fans {
    float home, away;
};

// Home fans own the bend at +x, away fans a part of the one at -x, and both are guests elsewhere.
Fans fans_at(const Oval& oval, glm::vec2 xz) {
    constexpr Fans home_end{0.78f, 0.01f}, away_end{0.04f, 0.8f}, elsewhere{0.24f, 0.06f};
    if (xz.x > oval.half_straight) return home_end;
    if (xz.x < -oval.half_straight && xz.y < 0) return away_end;
    return elsewhere;
}

Palette dress(Fans fans, std::uint64_t bits) {
    const auto next = [&] { return bits = mix(bits); };
    Palette palette;
    // The lesser of two draws: fair skins are more frequent than dark ones, as in many places.
    constexpr std::uint32_t skin_count = static_cast<std::uint32_t>(skins.size());
    const std::uint32_t skin = std::min(below(next(), skin_count), below(next(), skin_count));
    const std::uint32_t hair = below(next(), skin < fair_skins ? static_cast<std::uint32_t>(hairs.size()) : dark_hairs);
    palette.skin = skins[skin];
    palette.hair = hairs[hair];
    const float team = unit(next());
    if (team < fans.home) {
        palette.shirt = pick(home_shirts, next());
    } else if (team < fans.home + fans.away) {
        palette.shirt = pick(away_shirts, next());
    } else {
        palette.shirt = pick(casual_shirts, next());
    }
    palette.trousers = pick(trousers, next());
    return palette;
}

// [m] of a standing adult: normal about the mean, by the sum of four uniforms (of variance 1/3), clamped.
float draw_height(std::uint64_t bits) {
    constexpr float mean = 1.70f, deviation = 0.09f, low = 1.5f, high = 2.0f;
    float sum = 0;
    for (int i = 0; i < 4; ++i) sum += unit(bits = mix(bits));
    return std::clamp(mean + deviation * std::numbers::sqrt3_v<float> * (sum - 2.0f), low, high);
}

// In [-1, 1), more often near 0.
float draw_triangle(std::uint64_t bits) {
    return unit(bits) + unit(mix(bits)) - 1.0f;
}

// ---------------------------------------------------------------------------------------------------- populate

// Room for rounding when a shader scales and turns a person in another order [m].
constexpr float box_margin = 0.01f;

void include(motion::Bounds& box, const motion::Bounds& other) {
    box.min = glm::min(box.min, other.min);
    box.max = glm::max(box.max, other.max);
}

// What somebody with this pose box touches who stands at the origin, turned by `yaw`.
motion::Bounds turned(const motion::Bounds& box, float scale, float yaw) {
    const float c = std::cos(yaw), s = std::sin(yaw);
    const glm::vec3 center = scale * box.center(), half = 0.5f * scale * box.size();
    const glm::vec3 middle(c * center.x + s * center.z, center.y, c * center.z - s * center.x);
    const glm::vec3 reach(std::fabs(c) * half.x + std::fabs(s) * half.z, half.y,
                          std::fabs(s) * half.x + std::fabs(c) * half.z);
    return {middle - reach - box_margin, middle + reach + box_margin};
}

// What somebody touches who may be turned any way.
motion::Bounds turned_any_way(const motion::Bounds& box, float scale) {
    const glm::vec3 far = glm::max(glm::abs(box.min), glm::abs(box.max));
    const float reach = scale * std::hypot(far.x, far.z) + box_margin;
    return {{-reach, scale * box.min.y - box_margin, -reach}, {reach, scale * box.max.y + box_margin, reach}};
}

motion::Bounds moved(const motion::Bounds& box, glm::vec3 by) {
    return {box.min + by, box.max + by};
}

// Fills a crowd block by block.
struct Gathering {
    const StadiumPlan& plan;
    std::span<const CastMember> cast;
    std::span<const motion::PoseTable> poses;
    std::uint64_t seed;
    Crowd crowd;

    std::uint64_t bits(Salt salt, std::uint64_t which) const { return hash(hash(seed, salt), which); }
    std::uint8_t draw_character(std::uint64_t from) const {
        return static_cast<std::uint8_t>(below(from, static_cast<std::uint32_t>(cast.size())));
    }

    // Grows the open block by one person of these looks.
    void add(glm::vec3 position, float yaw, float height, std::uint8_t character, Role role, Fans fans) {
        const std::uint64_t own = bits(salt_person, crowd.size());
        crowd.position.push_back(position);
        crowd.yaw.push_back(yaw);
        crowd.height.push_back(height);
        crowd.character.push_back(character);
        crowd.role.push_back(role);
        crowd.hash.push_back(static_cast<std::uint32_t>(own >> 32));
        crowd.palette.push_back(dress(fans, hash(own, salt_looks)));
        ++crowd.blocks.back().count;
    }

    void open_block() { crowd.blocks.push_back({static_cast<std::uint32_t>(crowd.size()), 0, {}}); }

    void close_block() {
        CrowdBlock& block = crowd.blocks.back();
        if (block.count == 0) {
            crowd.blocks.pop_back();
            return;
        }
        for (std::size_t i = block.first; i < block.first + block.count; ++i) {
            const motion::Bounds reach = reach_of(i);
            if (i == block.first) block.box = reach;
            include(block.box, reach);
        }
    }

    motion::Bounds reach_of(std::size_t person) const {
        const motion::PoseTable& table = poses[crowd.character[person]];
        const float scale = crowd.height[person] / table.rest_height;
        const glm::vec3 position = crowd.position[person];
        if (crowd.role[person] == Role::spectator || crowd.role[person] == Role::standing) {
            return moved(turned(table.box, scale, crowd.yaw[person]), position);
        }
        const float radius = crowd.oval.radius + position.x;
        const glm::vec3 lane(crowd.oval.half_straight + radius, 0, radius);
        const motion::Bounds reach = turned_any_way(table.box, scale);
        return {reach.min - lane, reach.max + lane};
    }
};

// Athletes run in files, two a lane. A file has one character and one height, hence one speed, so that nobody ever
// runs through anybody. Runners have the inner lanes.
void add_athletes(Gathering& gathering, std::uint32_t count) {
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
            const float length = gathering.crowd.oval.length(offset);
            const float arc = std::fmod(slot / static_cast<float>(in_file) * length, length);
            gathering.add({offset, 0, arc}, 0, draw_height(hash(file_bits, salt_height)),
                          gathering.draw_character(file_bits), role, {0.4f, 0.4f});
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
std::vector<std::uint32_t> choose_seats(const Gathering& gathering, std::size_t count) {
    const StadiumPlan& plan = gathering.plan;
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

// Blocks are a section wide and up to `band_rows` rows deep: 150 to 400 people.
void add_spectators(Gathering& gathering, std::size_t count) {
    constexpr std::uint32_t band_rows = 12;
    const StadiumPlan& plan = gathering.plan;
    const std::size_t bands = (plan.rows.size() + band_rows - 1) / band_rows;
    const std::vector<std::uint32_t> chosen = choose_seats(gathering, count);
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
            const Seat& seat = plan.seats[sorted[i]];
            const std::uint64_t own = gathering.bits(salt_seat, sorted[i]);
            const std::uint8_t character = gathering.draw_character(hash(own, salt_looks));
            const float forward = gathering.cast[character].sits ? 0.0f : hips_depth - stander_depth;
            const glm::vec3 facing(std::sin(seat.yaw), 0, std::cos(seat.yaw));
            constexpr float yaw_jitter = 0.12f;  // [rad]
            gathering.add(seat.position + forward * facing, seat.yaw + yaw_jitter * draw_triangle(hash(own, salt_yaw)),
                          draw_height(hash(own, salt_height)), character, Role::spectator,
                          fans_at(plan.oval, {seat.position.x, seat.position.z}));
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
constexpr float cell_size = static_cast<float>(cell_places) * standing_pitch;

struct Cell {
    std::int32_t order;  // where it comes in the filling: its distance, quantised
    std::int32_t x, z;   // [cells]
};

bool is_free_ground(const StadiumPlan& plan, glm::vec2 xz, bool infield) {
    const float offset = plan.oval.offset_of(xz);
    if (infield) return offset < -infield_margin;
    if (offset < plan.outer_offset + plaza_margin) return false;
    constexpr float mast_clearance = 2.0f;  // [m]
    for (int light = 0; light < floodlight_count; ++light) {
        if (glm::distance(xz, floodlight_foot(plan, light)) < mast_clearance) return false;
    }
    return true;
}

// Fills one cell with up to `left` people; returns how many.
std::int64_t fill_cell(Gathering& gathering, const Cell& cell, bool infield, std::int64_t left) {
    constexpr float share_swing = 0.2f;  // clusters take up to so much more or less of the places than on average
    constexpr float yaw_jitter = 0.6f;   // [rad]
    gathering.open_block();
    std::int64_t placed = 0;
    for (int place = 0; place < cell_places * cell_places && placed < left; ++place) {
        const std::int64_t column = std::int64_t{cell.x} * cell_places + place % cell_places;
        const std::int64_t row = std::int64_t{cell.z} * cell_places + place / cell_places;
        const std::uint64_t own =
            hash(gathering.bits(salt_place, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
        const glm::vec2 jitter(2.0f * unit(own) - 1.0f, 2.0f * unit(mix(own)) - 1.0f);
        const glm::vec2 xz = standing_pitch * (glm::vec2(column, row) + 0.5f) + standing_jitter * jitter;
        const float share = standing_share + share_swing * (2.0f * clustering(gathering, xz) - 1.0f);
        if (unit(hash(own, salt_density)) >= share || !is_free_ground(gathering.plan, xz, infield)) continue;
        const float yaw = std::atan2(-xz.x, -xz.y) + yaw_jitter * draw_triangle(hash(own, salt_yaw));
        gathering.add({xz.x, 0, xz.y}, yaw, draw_height(hash(own, salt_height)),
                      gathering.draw_character(hash(own, salt_looks)), Role::standing, {0.3f, 0.1f});
        ++placed;
    }
    gathering.close_block();
    return placed;
}

// The cells whose centres lie at an offset in [from, to), nearest first.
std::vector<Cell> cells_between(const Oval& oval, float from, float to) {
    const int columns = static_cast<int>((oval.half_straight + oval.radius + to) / cell_size) + 2;
    const int rows = static_cast<int>((oval.radius + to) / cell_size) + 2;
    std::vector<Cell> cells;
    for (int z = -rows; z < rows; ++z) {
        for (int x = -columns; x < columns; ++x) {
            const glm::vec2 center = cell_size * (glm::vec2(x, z) + 0.5f);
            const float offset = oval.offset_of(center);
            if (offset >= from && offset < to) cells.push_back({static_cast<std::int32_t>(std::lround(offset)), x, z});
        }
    }
    std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.order < b.order; });
    return cells;
}

void add_standing(Gathering& gathering, std::int64_t left) {
    const StadiumPlan& plan = gathering.plan;
    const float cell_reach = cell_size;  // a cell whose centre is so far out of a region has none of its places
    for (const Cell& cell : cells_between(plan.oval, -plan.oval.radius - 1.0f, cell_reach)) {
        if (left > 0) left -= fill_cell(gathering, cell, true, left);
    }
    // The plan's extent is an estimate: further rings follow until everybody has a place.
    constexpr float ring = 100.0f;  // [m]
    float from = plan.outer_offset - cell_reach, to = plan.crowd_offset + cell_reach;
    while (left > 0) {
        for (const Cell& cell : cells_between(plan.oval, from, to)) {
            if (left > 0) left -= fill_cell(gathering, cell, false, left);
        }
        from = to;
        to += ring;
    }
}

void reserve(Crowd& crowd, std::size_t people) {
    crowd.position.reserve(people);
    crowd.yaw.reserve(people);
    crowd.height.reserve(people);
    crowd.character.reserve(people);
    crowd.role.reserve(people);
    crowd.hash.reserve(people);
    crowd.palette.reserve(people);
}

// ---------------------------------------------------------------------------------------------------- acts

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

// How far around the stands somebody sits, in [0, 1) from the start of the straight at +z, evenly along straights
// and nearly so in bends; without transcendental functions, since it is asked of everybody in every frame.
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

// Mexican waves. Between two of them everybody goes through periods of one clip's length at a phase of their own.
constexpr std::int64_t wave_interval = 45 * motion::ticks_per_second;
constexpr std::int64_t wave_lap = 20 * motion::ticks_per_second;  // once around the stadium
constexpr std::int64_t wave_first = 6 * motion::ticks_per_second;
constexpr float wave_share = 0.85f;       // of the spectators who take part
constexpr std::int64_t wave_jitter = 15;  // [ticks] of reaction time

// The tick at which the wave's front reaches somebody; nobody's two waves overlap.
std::int64_t wave_start(std::int64_t wave, float lap, std::uint32_t own) {
    return wave * wave_interval + wave_first + static_cast<std::int64_t>(lap * static_cast<float>(wave_lap)) +
           below(hash(own, salt_wave), wave_jitter);
}

bool takes_part(std::int64_t wave, std::uint32_t own) {
    return unit(hash(hash(own, salt_wave), static_cast<std::uint64_t>(wave))) < wave_share;
}

// Chance that somebody is excited in a period that starts at `tick`: each part of the stands has moods of its own.
float excitement(float lap, std::int64_t tick) {
    constexpr float parts = 20;
    constexpr std::int64_t mood_length = 15 * motion::ticks_per_second;
    constexpr float calmest = 0.04f, swing = 0.7f;
    const std::uint64_t part = static_cast<std::uint64_t>(lap * parts);
    const std::uint64_t mood = static_cast<std::uint64_t>(floor_div(tick, mood_length));
    const float level = unit(hash(hash(salt_mood, part), mood));
    return calmest + swing * level * level * level;  // mostly calm
}

std::uint8_t choose(const std::vector<std::uint8_t>& clips, std::uint64_t bits) {
    return clips[below(bits, static_cast<std::uint32_t>(clips.size()))];
}

std::int64_t length_of(const motion::PoseTable& poses, std::uint8_t clip) {
    return poses.clips[clip].ticks();
}

// Clips follow one another only if they take equally long.
bool acts_alternate(const Acts& acts, const motion::PoseTable& poses) {
    if (acts.excited.empty()) return false;
    const std::int64_t length = length_of(poses, acts.calm.front());
    const auto same = [&](std::uint8_t clip) { return length_of(poses, clip) == length; };
    return std::all_of(acts.calm.begin(), acts.calm.end(), same) &&
           std::all_of(acts.excited.begin(), acts.excited.end(), same);
}

// One act for ever, at a phase of one's own.
Action keep_acting(const Acts& acts, const motion::PoseTable& poses, std::uint32_t own, std::int64_t tick) {
    constexpr float excited_share = 0.25f;
    const std::uint64_t bits = hash(own, salt_act);
    const bool excited = !acts.excited.empty() && unit(bits) < excited_share;
    const std::uint8_t clip = choose(excited ? acts.excited : acts.calm, mix(bits));
    const std::int64_t length = length_of(poses, clip);
    const std::int64_t time = tick + below(hash(own, salt_phase), static_cast<std::uint32_t>(length));
    return {clip, time - floor_div(time, length) * length};
}

// An act a period. The clips begin and end in one pose, so whoever waits between periods holds it.
Action alternate(const Acts& acts, const motion::PoseTable& poses, std::uint32_t own, float lap, bool waves,
                 std::int64_t tick) {
    const std::int64_t length = length_of(poses, acts.calm.front());
    const std::int64_t phase = below(hash(own, salt_phase), static_cast<std::uint32_t>(length));
    const std::int64_t period = floor_div(tick + phase, length);
    const std::int64_t start = period * length - phase;
    if (waves && 3 * length < wave_interval) {
        const std::int64_t wave = floor_div(tick - wave_start(0, lap, own), wave_interval);
        const std::int64_t last = wave_start(wave, lap, own), next = last + wave_interval;
        const bool in_last = takes_part(wave, own), in_next = takes_part(wave + 1, own);
        if (in_last && tick < last + length) return {acts.excited.front(), tick - last};
        if ((in_last && start < last + length) || (in_next && start + length > next)) return {acts.calm.front(), 0};
    }
    const std::uint64_t bits = hash(hash(own, salt_act), static_cast<std::uint64_t>(period));
    const bool excited = unit(bits) < excitement(lap, start);
    return {choose(excited ? acts.excited : acts.calm, mix(bits)), tick - start};
}

bool is_athlete(Role role) {
    return role == Role::walker || role == Role::runner;
}

}  // namespace

Crowd populate(const StadiumPlan& plan, std::int64_t people, std::span<const CastMember> cast,
               std::span<const motion::PoseTable> poses, std::uint64_t seed) {
    assert(people >= 1 && people <= 10'000'000);
    assert(!cast.empty() && cast.size() <= 256 && cast.size() == poses.size());
    Gathering gathering{plan, cast, poses, seed, {}};
    gathering.crowd.oval = plan.oval;
    reserve(gathering.crowd, static_cast<std::size_t>(people));
    const std::int64_t athletes = athlete_count(people);
    const std::int64_t seated = std::min(people - athletes, static_cast<std::int64_t>(plan.seats.size()));
    add_athletes(gathering, static_cast<std::uint32_t>(athletes));
    add_spectators(gathering, static_cast<std::size_t>(seated));
    add_standing(gathering, people - athletes - seated);
    return std::move(gathering.crowd);
}

Placement place(const Crowd& crowd, std::size_t person, const CastMember& member, std::int64_t tick) {
    const glm::vec3 at = crowd.position[person];
    const Role role = crowd.role[person];
    if (!is_athlete(role)) return {at, crowd.yaw[person]};
    constexpr double reference_height = 1.75;  // [m] that gait speeds are given at
    const double speed = static_cast<double>(member.gait_speed[static_cast<std::size_t>(role)]) *
                         static_cast<double>(crowd.height[person]) / reference_height;
    const double run = static_cast<double>(at.z) + speed * static_cast<double>(tick) / motion::ticks_per_second;
    const float arc = static_cast<float>(std::fmod(run, static_cast<double>(crowd.oval.length(at.x))));
    const glm::vec2 xz = crowd.oval.position(arc, at.x), ahead = crowd.oval.tangent(arc, at.x);
    return {{xz.x, 0.0f, xz.y}, std::atan2(ahead.x, ahead.y)};
}

Action act(const Crowd& crowd, std::size_t person, const CastMember& member, const motion::PoseTable& poses,
           std::int64_t tick) {
    const Role role = crowd.role[person];
    const Acts& acts = member.acts[static_cast<std::size_t>(role)];
    const std::uint32_t own = crowd.hash[person];
    if (is_athlete(role) || !acts_alternate(acts, poses)) return keep_acting(acts, poses, own, tick);
    return alternate(acts, poses, own, lap_fraction(crowd.oval, crowd.position[person]), role == Role::spectator, tick);
}

}  // namespace scene
