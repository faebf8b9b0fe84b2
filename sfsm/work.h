// What a frame draws, counted kind by kind. What it costs is prices times counts (prices.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sfsm/drawing.h"

namespace sfsm {

// A new kind is a name here and a row of work_table. Append it: old traces know kinds by their place.
enum class WorkKind : int { person, triangle, point, motion_update, structure_triangle, pixel, single };

// What a kind's count depends on.
enum class WorkAxis : int {
    frame,   // the view alone: no decision changes it, and it is known before one is made
    motion,  // the motion distance D
    shape,   // the splat size S
};

// What is believed of a kind's price before a frame was timed. A piece is the time of one triangle of a person, drawn
// by the same: no kind's price is believed to follow from another's, or from its own in another way of drawing.
struct WorkPrior {
    double pieces;  // [pieces] one is believed to cost, > 0
    double spread;  // 1 sigma of that belief, in shares of it, > 0
    double least;   // the lowest price that is believed, in shares of it, [0, 1)

    // The same for a fit of recorded frames (simulate/cost_fit.h). By OpenGL a law must expect the dearest update, one
    // that skins a person, until it has timed some; a fit expects the cheap one of our baked poses, and is unsure.
    double fit_pieces;
    double fit_spread;
};

struct WorkEntry {
    WorkKind kind;
    std::string_view name;     // for people to read, of one
    std::string_view column;   // of a trace
    std::string_view meaning;  // of that column
    WorkAxis axis;
    std::array<WorkPrior, drawings> priors;  // in the order of Drawing

    constexpr const WorkPrior& prior(Drawing drawing) const { return priors[index_of(drawing)]; }
};

// Measured on two cores: by llvmpipe a piece is some 80 ns, natively some 9 ns.
inline constexpr auto work_table = std::to_array<WorkEntry>({
    {WorkKind::person,
     "person",
     "visible",
     "people drawn",
     WorkAxis::frame,
     {{/* gl */ {2, 1, 0, 2, 1}, /* native */ {1, 1, 0, 1, 1}}}},
    {WorkKind::triangle,
     "triangle",
     "triangles",
     "triangles of people",
     WorkAxis::shape,
     {{/* gl */ {1, 0.6, 0.02, 1, 1}, /* native */ {1, 0.6, 0.02, 1, 1}}}},
    {WorkKind::point,
     "point",
     "points",
     "points of people",
     WorkAxis::shape,
     {{/* gl */ {2, 0.8, 0.05, 2, 1}, /* native */ {0.17, 0.8, 0.05, 0.17, 1}}}},
    {WorkKind::motion_update,
     "motion update",
     "motion_updates",
     "people moved",
     WorkAxis::motion,
     {{/* gl */ {300, 2, 0, 4, 75}, /* native */ {1.2, 2, 0, 1.2, 4}}}},
    {WorkKind::structure_triangle,
     "structure triangle",
     "structure_triangles",
     "triangles of structure and ground",
     WorkAxis::frame,
     {{/* gl */ {1.1, 1, 0, 1.1, 1}, /* native */ {3.3, 1, 0, 3.3, 1}}}},
    {WorkKind::pixel,
     "pixel",
     "pixels",
     "pixels of the background that were painted",
     WorkAxis::frame,
     {{/* gl */ {0.075, 1, 0, 0.075, 1}, /* native */ {0.16, 1, 0, 0.16, 1}}}},
    {WorkKind::single,
     "single person",
     "singles",
     "people who are drawn one by one, not block by block",
     WorkAxis::shape,
     {{/* gl */ {48, 1, 0, 48, 1}, /* native */ {9, 1, 0, 9, 1}}}},
});

inline constexpr std::size_t work_kinds = work_table.size();

constexpr std::size_t index_of(WorkKind kind) {
    return static_cast<std::size_t>(kind);
}

constexpr const WorkEntry& entry_of(WorkKind kind) {
    return work_table[index_of(kind)];
}

static_assert([] {
    for (std::size_t i = 0; i < work_kinds; ++i)
        if (index_of(work_table[i].kind) != i) return false;
    return true;
}());

// The kinds of an axis, in the order of the table.
template <WorkAxis axis>
inline constexpr auto work_on = [] {
    constexpr auto is_on_axis = [](const WorkEntry& entry) { return entry.axis == axis; };
    std::array<WorkKind, std::count_if(work_table.begin(), work_table.end(), is_on_axis)> kinds{};
    std::size_t count = 0;
    for (const WorkEntry& entry : work_table)
        if (is_on_axis(entry)) kinds[count++] = entry.kind;
    return kinds;
}();

// Counts of each kind; in the order of the table: Work{people, triangles, points, motion updates, ...}.
struct Work {
    std::array<std::int64_t, work_kinds> counts{};

    constexpr std::int64_t operator[](WorkKind kind) const { return counts[index_of(kind)]; }
    constexpr std::int64_t& operator[](WorkKind kind) { return counts[index_of(kind)]; }
    bool operator==(const Work&) const = default;

    constexpr Work& operator+=(const Work& other) {
        for (std::size_t i = 0; i < work_kinds; ++i) counts[i] += other.counts[i];
        return *this;
    }
};

constexpr Work operator*(Work work, std::int64_t times) {
    for (std::int64_t& count : work.counts) count *= times;
    return work;
}

// The counts of an axis' own kinds; the others are 0.
template <WorkAxis axis>
constexpr Work only_on(const Work& work) {
    Work part;
    for (const WorkKind kind : work_on<axis>) part[kind] = work[kind];
    return part;
}

// More of any kind than a frame can draw.
inline constexpr std::int64_t most_count = 1'000'000'000'000'000;

// A count to calculate with, in [0, most_count]; a file may hold any number.
constexpr double counted(std::int64_t count) {
    return static_cast<double>(std::clamp<std::int64_t>(count, 0, most_count));
}

}  // namespace sfsm
