// replay: a recorded run through a law again, to see what it would decide, or to prove that it decided so; or, closed
// in a loop with a simulated renderer, what laws are worth.
#include "sfsm/replay.h"

#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/output.h"
#include "apps/places.h"
#include "apps/program.h"
#include "apps/simulate.h"
#include "sfsm/controller.h"
#include "sfsm/number_text.h"
#include "sfsm/summary.h"
#include "sfsm/target.h"
#include "sfsm/trace.h"

namespace {

struct Options {
    std::string trace;
    std::string law;        // empty: the trace's, or the first there is
    std::string target_ms;  // empty: the trace's
    std::string csv;
    std::string summary;
    bool verify = false;
    apps::SimulateOptions simulated;
};

const std::string examples = R"(Examples:
  replay out/stadium.csv                                what the trace's law would decide, summed up
  replay out/stadium.csv --target-ms 1000,300@30 --csv decisions.csv --summary -
  replay out/stadium.csv --verify                       is every recorded decision reproduced to the bit?
)" + std::string(apps::simulate_examples) +
                             R"(

Replaying is open loop: each recorded time is taken for the time of the law's own decision.
With --verify, failed is also what is not reproduced.)";

void add_options(CLI::App& app, Options& options) {
    apps::describe(app, examples);
    auto* trace = app.add_option("TRACE", options.trace, "Trace of a run, as stadium --trace writes it");
    auto* law = app.add_option("--law", options.law, "Law to feed; default: the trace's")
                    ->check(apps::one_of(sfsm::law_names()));
    auto* target = app.add_option("--target-ms", options.target_ms,
                                  "Target, MS[,MS@FRAME ...] in milliseconds; default: the trace's, frame by frame");
    auto* csv = app.add_option("--csv", options.csv, "Write the decisions as a trace (- = stdout)");
    auto* summary = app.add_option("--summary", options.summary, "Write the summary as JSON (- = stdout, the default)");
    auto* verify =
        app.add_flag("--verify", options.verify, "Only check that the trace's law reproduces the recorded decisions")
            ->excludes(law, target, csv, summary);
    apps::add_simulate_options(app, options.simulated)->excludes(trace, law, target, summary, verify);
}

sfsm::Trace read(const std::string& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path + ": " + std::strerror(errno) + ", expected a trace");
    return sfsm::read_trace(file, path);
}

// The setting, which a check of the run cannot do without.
const std::string& required(const sfsm::Trace& trace, const std::string& path, const char* key) {
    const auto found = trace.settings.find(key);
    if (found != trace.settings.end()) return found->second;
    throw std::runtime_error(path + ": found no setting '" + key + "', expected a line '# " + key + "=...'");
}

void verify(const std::string& path) {
    const sfsm::Trace trace = read(path);
    const std::string& state = required(trace, path, "state");
    if (state != "auto") {
        throw std::runtime_error(path + ": found state=" + state +
                                 ", decisions that were forced, expected state=auto: nothing to verify");
    }
    required(trace, path, "delay");
    const auto law = sfsm::make_controller(required(trace, path, "law"));
    const std::vector<sfsm::Decision> decisions = sfsm::replay_decisions(*law, trace.rows, sfsm::trace_delay(trace));
    const auto difference = sfsm::first_difference(trace.rows, decisions);
    if (difference) {
        throw std::runtime_error(path + ": frame " + std::to_string(difference->frame) + ": found " +
                                 difference->field + " " + sfsm::number_text(difference->recorded) + ", expected " +
                                 sfsm::number_text(difference->decided) + " of law " + trace.settings.at("law"));
    }
    std::cout << path << ": all " << decisions.size() << " decisions of law " << trace.settings.at("law")
              << " reproduced to the bit\n";
}

// The trace as the law would have had it: its decisions in place of the recorded ones.
void redecide(sfsm::Trace& trace, const Options& options) {
    if (!options.target_ms.empty()) {
        const sfsm::TargetSchedule targets = sfsm::TargetSchedule::parse(options.target_ms);
        for (sfsm::TraceRow& row : trace.rows) row.target_ms = targets.at(row.frame);
        trace.settings["target_ms"] = targets.text();
    }
    if (!options.law.empty()) trace.settings["law"] = options.law;
    trace.settings.try_emplace("law", sfsm::law_names().front());
    const auto law = sfsm::make_controller(trace.settings["law"]);
    const std::vector<sfsm::Decision> decisions = sfsm::replay_decisions(*law, trace.rows, sfsm::trace_delay(trace));
    for (std::size_t i = 0; i < decisions.size(); ++i) trace.rows[i].decision = decisions[i];
    trace.settings["state"] = "auto";
    trace.settings["version"] = GRANDSTAND_VERSION;
}

void replay(const Options& options) {
    sfsm::Trace trace = read(options.trace);
    redecide(trace, options);
    const std::string summary_path = options.summary.empty() && options.csv != "-" ? "-" : options.summary;
    // Both are opened before either is written: a place that cannot be written leaves neither.
    std::optional<apps::OutputFile> csv, summary;
    if (!options.csv.empty()) csv.emplace(options.csv);
    if (!summary_path.empty()) summary.emplace(summary_path);
    if (csv) {
        sfsm::write_trace_header(csv->stream(), trace.settings);
        for (const sfsm::TraceRow& row : trace.rows) sfsm::write_trace_row(csv->stream(), row);
        csv->commit();
    }
    if (summary) {
        summary->stream() << sfsm::summary_json(sfsm::summarize(trace.rows), trace.settings);
        summary->commit();
    }
}

// What CLI11 cannot see; throws std::invalid_argument.
void check(Options& options) {
    options.simulated.csv = options.csv;
    if (!options.simulated.scenario.empty()) return apps::check(options.simulated);
    if (options.trace.empty()) {
        throw std::invalid_argument("found no TRACE, expected the trace of a run or --simulate");
    }
    const apps::Place inputs[] = {{"TRACE", options.trace}};
    const apps::Place outputs[] = {{"--csv", options.csv}, {"--summary", options.summary}};
    apps::check_places(inputs, outputs);
    if (!options.target_ms.empty()) sfsm::TargetSchedule::parse(options.target_ms);
}

void run(const Options& options) {
    if (!options.simulated.scenario.empty()) return apps::simulate(options.simulated);
    if (options.verify) return verify(options.trace);
    replay(options);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Feeds a recorded or a simulated run through control laws, and says what they decide.", "replay");
    Options options;
    add_options(app, options);
    return apps::run_program(
        app, argc, argv, [&] { check(options); }, [&] { run(options); });
}
