// The stadium program's command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/point_cache.h"
#include "apps/troupe.h"
#include "sfsm/controller.h"
#include "sfsm/decision.h"
#include "sfsm/drawing.h"
#include "sfsm/target.h"

namespace CLI {
class App;  // its header takes four seconds to compile
}

namespace apps {

struct StadiumOptions {
    std::int64_t people = 20000;  // [1, 1'000'000]
    std::vector<CharacterFile> characters;
    sfsm::TargetSchedule target = sfsm::TargetSchedule::parse(sfsm::default_target);
    std::optional<sfsm::Drawing> draw;  // empty: whatever is faster
    std::string law = std::string(sfsm::law_names().front());
    std::optional<sfsm::State> state;               // empty: the law decides
    std::optional<double> splat_size;               // [px] of a fixed state 2
    std::optional<double> motion_distance;          // [m] of a fixed state 1 or 2
    std::optional<double> max_error;                // [px] of motion and of splats, whatever time it takes
    double pour_in = 0;                             // [s] in which people come in; 0: all are there
    std::filesystem::path cache = default_cache();  // of point models; empty: none
    std::string camera = "roam";                    // a preset or a path file
    std::optional<std::int64_t> frames;             // empty: 300 without a window, until it is closed with one
    int width = 1280, height = 720;                 // [px]
    std::uint64_t seed = 1;
    bool headless = false;
    bool fixed_step = false;
    bool strict = false;                                     // refuse characters of which anything would be lost
    bool verbose = false;                                    // say which clips characters play
    bool gallery = false;                                    // a sheet of the characters instead of a run
    std::string trace, png, png_directory, summary, report;  // paths; empty: none; "-": stdout
    std::int64_t png_every = 0;                              // [frames] 0: none
};

// Adds the options to `app`; parsing fills `options`, which must stay where it is.
void add_stadium_options(CLI::App& app, StadiumOptions& options);

// Characters as they follow --character: "A.glb:3 --turn 90 --act walk=Run --character B.glb", without what isn't asked
// for.
std::string text_of(const std::vector<CharacterFile>& characters);

// The rules between options. Throws std::invalid_argument with one line.
void check(const StadiumOptions& options);

}  // namespace apps
