#include "apps/replay_options.h"

#include "apps/contestants.h"
#include "apps/places.h"
#include "apps/program.h"
#include "sfsm/replay.h"
#include "sfsm/target.h"

namespace apps {
namespace {

const std::string examples = R"(Examples:
  replay out/stadium.csv                                the run again, with decisions of its law
  replay game.csv --process game.exe --target-ms 8.3    what PresentMon, OCAT, CapFrameX, FrameView, MangoHud,
                                                        FRAPS, Afterburner or Unreal recorded, as the load of our
                                                        reference crowd
  replay bench.csv.gz --column "GPU frame" --unit us    any table with a column of times
  replay out/stadium.csv --law paper,predictive --report laws.html
  replay out/stadium.csv --open-loop --csv decisions.csv --json -
  replay out/stadium.csv --fit                          what each kind of work cost
  replay out/stadium.csv --verify                       is every recorded decision reproduced to the bit?
  replay out/stadium.csv --explain 120                  why frame 120 is drawn as it is, in words
)" + std::string(simulate_examples) +
                             R"(

A recording holds the load under the decisions of its own. Closed loop: the time of another decision is what a cost model
makes of it, times that load. Open loop: each recorded time is taken for the time of the law's own decision.
With --verify, failed is also what is not reproduced.)";

}  // namespace

void add_replay_options(CLI::App& app, ReplayOptions& options) {
    describe(app, examples);
    auto* trace = app.add_option("TRACE", options.trace,
                                 "What stadium --trace or another tool recorded; may be gzipped (- = stdin)");
    auto* law = app.add_option("--law", options.laws, "Law to feed, LAW[,LAW ...], or all; default: the trace's");
    auto* target =
        app.add_option("--target-ms", options.target_ms,
                       "Target, MS[,MS@FRAME ...] in milliseconds; default: the trace's, frame by frame, or 16.6");
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
    auto* open = app.add_flag("--open-loop", options.open_loop, "Only what the law would decide");
    auto* json = app.add_option("--json", options.json, "Write the figures as JSON (- = stdout)");
    auto* csv = app.add_option("--csv", options.csv, "Write the run as a trace (- = stdout); of one law");
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

void check(ReplayOptions& options) {
    options.simulated.csv = options.csv;
    options.simulated.json = options.json;
    const Place outputs[] = {
        {"--json", options.json}, {"--csv", options.csv}, {"--report", options.report}, {"--svg", options.svg}};
    const Place inputs[] = {{"TRACE", options.trace == "-" ? "" : options.trace}};
    check_places(inputs, outputs);
    if (!options.simulated.scenario.empty()) return check(options.simulated);
    if (options.trace.empty()) throw std::invalid_argument("found no TRACE, expected the trace of a run or --simulate");
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
