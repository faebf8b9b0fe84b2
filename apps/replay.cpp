// replay: any recorded run through any law: what the law would have made of it, or only decided, or whether it decided
// so; what the frames of a trace cost; and what laws are worth on simulated renderers.
#include "sfsm/replay.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/contestants.h"
#include "apps/explain.h"
#include "apps/output.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/replay_options.h"
#include "apps/rerun_text.h"
#include "apps/session.h"
#include "apps/simulate.h"
#include "sfsm/number_text.h"
#include "sfsm/report/report.h"
#include "sfsm/simulate/recorded.h"

namespace apps {
namespace {

using Json = nlohmann::ordered_json;

// The setting, which a check of the run cannot do without.
const std::string& required(const sfsm::Trace& trace, const std::string& path, const char* key) {
    const auto found = trace.settings.find(key);
    if (found != trace.settings.end()) return found->second;
    throw std::runtime_error(path + ": found no setting '" + key + "', expected a line '# " + key + "=...'");
}

void verify(const std::string& path) {
    const sfsm::Trace trace = read_own_trace(path);
    const std::string& state = required(trace, path, "state");
    if (state != "auto") {
        throw std::runtime_error(path + ": found state=" + state +
                                 ", decisions that were forced, expected state=auto: nothing to verify");
    }
    required(trace, path, "delay");
    required(trace, path, "law");
    const auto law = make_law(law_of(trace, false), sfsm::trace_drawing(trace));
    const std::vector<sfsm::Replayed> replayed = sfsm::replay(*law, trace.rows, sfsm::trace_delay(trace));
    const auto difference = sfsm::first_difference(trace.rows, replayed);
    if (difference) {
        throw std::runtime_error(path + ": frame " + std::to_string(difference->frame) + ": found " +
                                 difference->field + " " + sfsm::number_text(difference->recorded) + ", expected " +
                                 sfsm::number_text(difference->decided) + " of law " + trace.settings.at("law") +
                                 ": the trace is damaged, or the law has changed since");
    }
    std::cout << path << ": all " << replayed.size() << " decisions of law " << trace.settings.at("law")
              << " reproduced to the bit\n";
}

void explain(const ReplayOptions& options) {
    const sfsm::Trace trace = read_own_trace(options.trace);
    if (options.laws.empty()) {
        required(trace, options.trace, "law");
        return write_explanation(std::cout, trace, *options.explained, law_of(trace, false));
    }
    std::string gap;
    for (const sfsm::simulate::Contestant& law : chosen_laws("--law", options.laws)) {
        if (needs_course(law)) continue;
        std::cout << std::exchange(gap, "\n");
        write_explanation(std::cout, trace, *options.explained, law);
    }
}

void fit(const ReplayOptions& options) {
    std::optional<OutputFile> json;
    if (!options.json.empty()) json.emplace(options.json);
    const sfsm::Trace trace = read_own_trace(options.trace);
    const auto fitted =
        made_of(options.trace, [&] { return sfsm::simulate::fit_costs(trace.rows, sfsm::trace_drawing(trace)); });
    if (json) {
        json->stream() << fit_json(fitted).dump(2) << '\n';
        json->commit();
    }
    if (options.json != "-") write_fit(std::cout, fitted);
}

// Everything is opened before anything is written: a place that cannot be written leaves nothing.
struct Outputs {
    std::optional<OutputFile> json, csv, report, svg;

    explicit Outputs(const ReplayOptions& options) {
        if (!options.json.empty()) json.emplace(options.json);
        if (!options.csv.empty()) csv.emplace(options.csv);
        if (!options.report.empty()) report.emplace(options.report);
        if (!options.svg.empty()) svg.emplace(options.svg);
    }

    void commit() {
        for (std::optional<OutputFile>* file : {&json, &csv, &report, &svg})
            if (*file) (*file)->commit();
    }
};

std::string frames_text(const std::vector<sfsm::FrameRecord>& frames) {
    const auto without =
        std::count_if(frames.begin(), frames.end(), [](const auto& frame) { return std::isnan(frame.frame_ms); });
    const std::string text = std::to_string(std::ssize(frames) - without) + " frames";
    return without == 0 ? text : text + " and " + std::to_string(without) + " without a time";
}

void replay(const ReplayOptions& options) {
    Outputs outputs(options);
    const Session session = open_session(options);
    const auto facts = facts_of(session, options.trace);
    sfsm::Report report{options.trace, facts, {}};
    Json json;
    for (const auto& [key, value] : facts) json[key] = value;
    json["delay"] = session.delay;  // [frames]
    json["notes"] = session.recording.notes;
    json["generated"] = session.recording.streams.at(session.recording.chosen).generated;  // presents, not rendered
    const Rerun recorded = recorded_run(session);
    json["recorded"] = rerun_json(recorded);
    Json& runs = json["runs"] = Json::array();
    report.runs.push_back(report_run(recorded));
    ProgressBar bar("Replaying");
    for (const sfsm::simulate::Contestant& law : session.laws) {
        const Rerun run = rerun(session, law);
        runs.push_back(rerun_json(run));
        report.runs.push_back(report_run(run));
        if (outputs.csv) write_trace(outputs.csv->stream(), session, run);
        bar(static_cast<double>(report.runs.size() - 1) / static_cast<double>(session.laws.size()));
    }
    if (outputs.json) outputs.json->stream() << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    if (outputs.report) sfsm::write_report_html(outputs.report->stream(), report);
    if (outputs.svg) sfsm::write_report_svg(outputs.svg->stream(), report);
    outputs.commit();
    for (const std::string* path : {&options.json, &options.csv, &options.report, &options.svg})
        if (*path == "-") return;
    std::cout << options.trace << ": " << session.recording.format << ", " << frames_text(session.recording.frames)
              << ", " << (session.course ? "closed" : "open") << " loop, delay " << session.delay << ", target "
              << session.recording.trace.settings.at("target_ms") << " ms\n";
    write_scores(std::cout, report.runs);
}

void run(const ReplayOptions& options) {
    if (!options.simulated.scenario.empty()) return simulate(options.simulated);
    if (options.verify) return verify(options.trace);
    if (options.explained) return explain(options);
    if (options.fit) return fit(options);
    replay(options);
}

}  // namespace
}  // namespace apps

int main(int argc, char** argv) {
    CLI::App app("Feeds a recorded or a simulated run through control laws, and says what becomes of it.", "replay");
    apps::ReplayOptions options;
    apps::add_replay_options(app, options);
    return apps::run_program(
        app, argc, argv, [&] { check(options); }, [&] { apps::run(options); });
}
