// The simulate mode of replay: laws closed in a loop with simulated renderers, and the scorecard of it.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace apps {

struct SimulateOptions {
    std::string scenario;      // a name or "all"; empty: not this mode
    std::string laws = "all";  // names with commas between
    int seeds = 30;            // >= 1
    int frames = 0;            // of one long run of each, instead of the scorecard; 0: the scorecard
    std::string json;          // empty: none
    std::string csv;           // a trace of the first seed's run; empty: none
};

inline const char* const simulate_examples =
    R"(  replay --simulate toy --laws predictive,filament      a scorecard of two laws and one simulated renderer
  replay --simulate all --json docs/scorecard.json      of all of them: a minute or two
  replay --simulate toy --laws predictive --frames 2000000   what creeps in a long run
  replay --simulate paper-1 --laws paper --csv run.csv  and the first run as a trace)";

// All but --csv and --json, which are replay's too. Gives the option that asks for this mode.
CLI::Option* add_simulate_options(CLI::App& app, SimulateOptions& options);

// Throws std::invalid_argument naming what there is.
void check(const SimulateOptions& options);

void simulate(const SimulateOptions& options);

}  // namespace apps
