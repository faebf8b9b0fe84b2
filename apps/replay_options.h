// The replay program's command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/places.h"
#include "apps/simulate.h"

namespace apps {

struct ReplayOptions {
    std::vector<std::string> recordings;  // files and folders; "-": stdin
    std::string laws;          // names with commas between, or all; empty: none, or the trace's where one is needed
    std::string target_ms;     // empty: the trace's, or the default of a law
    std::optional<int> delay;  // [frames]; empty: the trace's, or a timer query's
    std::string process;       // empty: the stream with most frames
    std::string swap_chain;    // empty: all of the process that follow one another
    std::string column, unit;  // of the times; empty: as the format says
    std::optional<std::int64_t> explained;  // frame
    bool open_loop = false, fit = false, verify = false;
    std::string json, csv, report, svg;  // paths; empty: none; "-": stdout
    SimulateOptions simulated;
};

// Adds the options to `app`; parsing fills `options`, which must stay where it is.
void add_replay_options(CLI::App& app, ReplayOptions& options);

// All that may be asked for; those that aren't have an empty path.
std::vector<Place> outputs_of(const ReplayOptions& options);

// The rules between options. Throws std::invalid_argument with one line.
void check(ReplayOptions& options);

}  // namespace apps
