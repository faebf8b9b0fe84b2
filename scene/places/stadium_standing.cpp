// add_standing: a jittered grid over pitch and plaza, taken from the middle outward.
#include <tbb/parallel_for.h>

#include <cassert>
#include <cmath>
#include <vector>

#include "scene/places/stadium_crowd.h"
#include "scene/places/stadium_layout.h"
#include "sfsm/random.h"

namespace scene {

namespace {

using sfsm::hash;
using sfsm::mix;
using sfsm::triangle;
using sfsm::upper_unit;

// Smooth noise in [0, 1] over the plane: people cluster.
float clustering(const Gathering& gathering, glm::vec2 xz) {
    constexpr float wavelength = 9.0f;  // [m]
    const glm::vec2 cell = glm::floor(xz / wavelength);
    const glm::vec2 t = xz / wavelength - cell;
    const glm::vec2 ease = t * t * (3.0f - 2.0f * t);
    const auto corner = [&](int i, int j) {
        const std::uint64_t x = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x) + i);
        const std::uint64_t z = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y) + j);
        return upper_unit(hash(gathering.bits(salt_density, x), z));
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
enum class Area { infield, plaza };

bool is_free(const StadiumPlan& plan, Area area, glm::vec2 xz, float offset) {
    if (area == Area::infield) return offset < -infield_margin;
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

// The taken places of a cell.
std::vector<StandingPlace> places_of(const Gathering& gathering, const StadiumPlan& plan, Area area, Cell cell) {
    constexpr float share_swing = 0.2f;  // clusters take up to so much more or less of the places than on average
    const float pitch = standing_pitch(plan.room);
    std::vector<StandingPlace> places;
    for (int place = 0; place < cell_places * cell_places; ++place) {
        const int column = cell.x * cell_places + place % cell_places;
        const int row = cell.z * cell_places + place / cell_places;
        const std::uint64_t bits =
            hash(gathering.bits(salt_place, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
        const glm::vec2 jitter(2.0f * upper_unit(bits) - 1.0f, 2.0f * upper_unit(mix(bits)) - 1.0f);
        const glm::vec2 xz = pitch * (glm::vec2(column, row) + 0.5f) + standing_jitter * jitter;
        const float share = standing_share + share_swing * (2.0f * clustering(gathering, xz) - 1.0f);
        if (upper_unit(hash(bits, salt_density)) >= share) continue;
        const float offset = plan.oval.offset_of(xz);
        if (is_free(plan, area, xz, offset)) places.push_back({xz, offset, bits});
    }
    return places;
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

// The cut that leaves at most `wanted` of the cells' places.
Cut cut_after(const Oval& oval, const std::vector<std::vector<StandingPlace>>& cells, std::int64_t wanted) {
    std::vector<std::int64_t> bins;
    for (const auto& places : cells) {
        for (const StandingPlace& place : places) {
            const std::size_t bin = bin_of(oval, place.offset);
            if (bin >= bins.size()) bins.resize(bin + 1, 0);
            ++bins[bin];
        }
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
                   .yaw = to_center + yaw_jitter * triangle(hash(place.bits, salt_yaw)),
                   .height = draw_height(hash(place.bits, salt_height)),
                   .character = gathering.draw_character(hash(place.bits, salt_looks)),
                   .role = Role::standing,
                   .around = lap_fraction(oval, feet),
                   .fans = {0.3f, 0.1f}});
}

// Puts up to `wanted` people on the innermost places between two parallels; returns how many found one.
std::int64_t fill_ground(Gathering& gathering, const StadiumPlan& plan, Area area, float inner, float outer,
                         std::int64_t wanted) {
    if (wanted == 0) return 0;
    const Oval& oval = plan.oval;
    const std::vector<Cell> cells = cells_between(plan, inner, outer);
    std::vector<std::vector<StandingPlace>> places(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(),
                      [&](std::size_t i) { places[i] = places_of(gathering, plan, area, cells[i]); });
    Cut cut = cut_after(oval, places, wanted);
    const std::size_t before = gathering.crowd.size();
    for (std::vector<StandingPlace>& cell : places) {
        gathering.open_block();
        for (const StandingPlace& place : cell) {
            const std::size_t bin = bin_of(oval, place.offset);
            if (bin < cut.bin || (bin == cut.bin && cut.in_bin-- > 0)) stand(gathering, oval, place);
        }
        gathering.close_block();
        cell = {};
    }
    return static_cast<std::int64_t>(gathering.crowd.size() - before);
}

}  // namespace

void add_standing(Gathering& gathering, const StadiumPlan& plan, std::int64_t wanted) {
    // Some more than the plan's estimate, which knows densities only on average.
    constexpr float spare = 30.0f;  // [m]
    std::int64_t left = wanted;
    left -= fill_ground(gathering, plan, Area::infield, -plan.oval.radius, -infield_margin, left);
    left -= fill_ground(gathering, plan, Area::plaza, plan.outer_offset, plan.crowd_offset + spare, left);
    assert(left == 0);
}

}  // namespace scene
