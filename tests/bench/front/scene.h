// The rows of a front by where they were measured: one crowd in one view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/front/error_kind.h"
#include "tests/bench/front/row.h"

namespace bench::front {

struct Scene {
    std::int64_t people = 0;
    std::string view;
    bool is_preset = false;
    std::vector<Row> rows;            // in the front's order
    std::vector<std::size_t> places;  // of each: into Front::rows

    std::string name() const;  // "20,000 people, still"
};

// First of 20,000 people, or else of the fewest, then of the others from few to many; each crowd's presets before the
// path's moments, in the front's order.
std::vector<Scene> scenes_of(const Front& front);

// Rows of one scene, as indices from fast to slow: settings (no marks) that no other beats, by being nowhere worse in
// time and loss and better in one. Rows whose time isn't finite and over 0 or whose error is NaN take no part.
std::vector<std::size_t> front_of(std::span<const Row> rows, const ErrorKind& error);

// A count with commas; a time [ms] with three figures or so.
std::string count_text(std::int64_t count);
std::string time_text(double ms);

// A target [ms] as short as it was given: "4", "16.6".
std::string target_text(double ms);

// How it was drawn: "native points, S = 1.4", whose parts no line break tears apart.
std::string setting_text(const Row& row);

}  // namespace bench::front
