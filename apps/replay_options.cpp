#include "apps/replay_options.h"

#include <algorithm>

#include "apps/contestants.h"
#include "apps/places.h"
#include "apps/program.h"
#include "sfsm/replay.h"
#include "sfsm/target.h"

namespace apps {
namespace {

const std::string examples = R"(Examples:
  replay game.csv --report game.html                    how a game ran and why it stuttered, as a page to look at:
                                                        of what PresentMon, OCAT, CapFrameX, FrameView, MangoHud,
                                                        FRAPS, Afterburner or Unreal recorded
  replay before.csv after.csv                           is the second really faster?
  replay game.csv --process game.exe --target-ms 8.3    how many frames took longer
  replay bench.csv.gz --column "GPU frame" --unit us    any table with a column of times
  replay out/stadium.csv --law paper,predictive --report laws.html
                                                        what control laws would have made of it
  replay game.csv --law predictive --json -             the same of a game, as the load of our reference crowd
  replay out/stadium.csv --open-loop --csv decisions.csv
  replay out/stadium.csv --fit                          what each kind of work cost
  replay out/stadium.csv --verify                       is every recorded decision reproduced to the bit?
  replay out/stadium.csv --explain 120                  why frame 120 is drawn as it is, in words
)" + std::string(simulate_examples) +
                             R"(

A recording holds the load under the decisions of its own. Closed loop: the time of another decision is what a cost model
makes of it, times that load. Open loop: each recorded time is taken for the time of the law's own decision.
With --verify, failed is also what is not reproduced.)";

void check_count(const ReplayOptions& options) {
    const std::size_t count = options.recordings.size();
    if (count == 0) throw std::invalid_argument("found no RECORDING, expected the recording of a run or --simulate");
    if (std::count(options.recordings.begin(), options.recordings.end(), "-") > 1)
        throw std::invalid_argument("found - twice, expected standard input once");
    if (count == 1) return;
    const bool needs_one = options.verify || options.explained || options.fit || options.open_loop;
    if (needs_one || !options.laws.empty()) {
        throw std::invalid_argument("found " + std::to_string(count) +
                                    " recordings, expected one with --law, --open-loop, --verify, --explain or --fit");
    }
}

}  // namespace

void add_replay_options(CLI::App& app, ReplayOptions& options) {
    describe(app, examples);
    auto* trace = app.add_option("RECORDING", options.recordings,
                                 "Files that stadium --trace or other tools recorded, or folders of them; may be "
                                 "gzipped (- = stdin)")
                      ->take_all();
    auto* law = app.add_option("--law", options.laws, "Law to feed, LAW[,LAW ...], or all; default: none");
    auto* target =
        app.add_option("--target-ms", options.target_ms,
                       "Target, MS[,MS@FRAME ...] in milliseconds; default: the trace's, frame by frame, or 16.6 "
                       "of a law");
    auto* delay = app.add_option("--delay", options.delay,
                                 "Frames that a time arrives late; default: the trace's, or 2 of another recording")
                      ->check(whole_number(0, sfsm::max_delay));
    auto* process = app.add_option("--process", options.process,
                                   "Name (with .exe or without), id or swap chain of which to take; default: the one "
                                   "with most frames, but not the desktop's compositor");
    auto* chain = app.add_option("--swap-chain", options.swap_chain,
                                 "Swap chain to take alone; default: all of a process that follow one another");
    auto* column =
        app.add_option("--column", options.column,
                       "Column of any table that has the frame times: its name, or number where it has none");
    auto* unit = app.add_option("--unit", options.unit, "Unit of these times; default: the column's name or a guess")
                     ->check(CLI::IsMember({"ms", "us", "s", "fps"}));
    auto* open = app.add_flag("--open-loop", options.open_loop,
                              "Only what the law would decide; default law: the trace's, or predictive");
    auto* json = app.add_option("--json", options.json, "Write the figures as JSON (- = stdout)");
    auto* csv = app.add_option("--csv", options.csv,
                               "Write the frames as a table, or what one law made of them as a trace (- = "
                               "stdout)");
    auto* report = app.add_option("--report", options.report, "Write a page to look at, HTML (- = stdout)");
    auto* svg = app.add_option("--svg", options.svg, "Write the picture of it, SVG (- = stdout)");
    auto* fit =
        app.add_flag("--fit", options.fit, "Only what each kind of work cost in the trace, and how sure that is")
            ->excludes(law, target, delay, process, chain, column, unit, open, csv, report, svg);
    auto* verify =
        app.add_flag("--verify", options.verify, "Only check that the trace's law reproduces the recorded decisions")
            ->excludes(law, target, delay, process, chain, column, unit, open, json, csv, report, svg, fit);
    auto* explain =
        app.add_option("--explain", options.explained,
                       "Only say what was asked, believed and foreseen for this frame, and why the law decides so")
            ->type_name("FRAME")
            ->excludes(target, delay, process, chain, column, unit, open, json, csv, report, svg, fit, verify);
    add_simulate_options(app, options.simulated)
        ->excludes(trace, law, target, delay, process, chain, column, unit, open, report, svg, fit, verify, explain);
}

std::vector<Place> outputs_of(const ReplayOptions& options) {
    return {{"--json", options.json}, {"--csv", options.csv}, {"--report", options.report}, {"--svg", options.svg}};
}

void check(ReplayOptions& options) {
    options.simulated.csv = options.csv;
    options.simulated.json = options.json;
    std::vector<Place> inputs;
    for (const std::string& path : options.recordings) inputs.push_back({"RECORDING", path == "-" ? "" : path});
    check_places(inputs, outputs_of(options));
    if (!options.simulated.scenario.empty()) return check(options.simulated);
    check_count(options);
    if (!options.target_ms.empty()) sfsm::TargetSchedule::parse(options.target_ms);
    if (options.laws.empty()) return;
    const std::vector<sfsm::simulate::Contestant> laws = chosen_laws("--law", options.laws);
    if (!options.csv.empty() && laws.size() != 1)
        throw wrong_argument("--csv", std::to_string(laws.size()) + " laws", "one law with it");
    const bool is_open = options.open_loop || options.explained;
    if (!is_open || options.laws == "all") return;  // all that can
    for (const sfsm::simulate::Contestant& law : laws) {
        if (needs_course(law))
            throw wrong_argument("--law", law.name, "a law that decides without knowing costs, over recorded times");
    }
}

}  // namespace apps
