#include "apps/review.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <future>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/output.h"
#include "apps/places.h"
#include "apps/progress.h"
#include "apps/recorded_files.h"
#include "apps/recording_text.h"
#include "apps/rerun_text.h"
#include "apps/session.h"
#include "sfsm/frame_times/differences.h"
#include "sfsm/report/report.h"

namespace apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t seed = 1;  // of the draws that say what a difference is worth

// A recording, and what it comes to.
struct Reviewed {
    std::string path, name;
    Session session;
    sfsm::Figures figures;
    std::vector<sfsm::Stutter> stutters;
    sfsm::Over over_target;  // limit_ms: NaN where the target changes; share: NaN where there is none

    const std::vector<sfsm::FrameRecord>& frames() const { return session.recording.frames; }
    bool has_laws() const { return !session.laws.empty(); }
};

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

sfsm::Over over_target(const Session& session) {
    if (!session.has_targets) return sfsm::over_targets(session.recording.frames, {});
    const sfsm::RunRows rows = rows_of(session);
    return sfsm::over_targets(session.recording.frames, [&](std::size_t i) { return rows.at(i).target_ms; });
}

Reviewed reviewed(const ReplayOptions& options, const std::string& path) {
    Reviewed one{path, {}, open_session(options, path), {}, {}, {}};
    const sfsm::Recording& recording = one.session.recording;
    one.figures =
        sfsm::figures_of(recording.frames, recording.streams.at(recording.chosen).generated, sfsm::usual_limits_ms);
    if (one.figures.timed == 0) {
        throw std::runtime_error(path + ": found no time in " + std::to_string(one.figures.frames) +
                                 " frames, expected at least one");
    }
    one.stutters = sfsm::stutters_of(recording.frames);
    one.over_target = over_target(one.session);
    return one;
}

// None may be a file that is read, of a folder neither.
void check_outputs(const ReplayOptions& options, const std::vector<RecordedFile>& files) {
    std::vector<Place> inputs;
    for (const RecordedFile& file : files) inputs.push_back({"RECORDING", file.path == "-" ? "" : file.path});
    check_places(inputs, outputs_of(options));
}

// Of a folder, files that are no recordings are named and passed over.
std::vector<Reviewed> read_all(const ReplayOptions& options, const std::vector<RecordedFile>& files) {
    std::vector<Reviewed> all;
    for (const RecordedFile& file : files) {
        try {
            all.push_back(reviewed(options, file.path));
        } catch (const std::runtime_error& error) {
            if (!file.is_of_folder) throw;
            std::cerr << "replay: passed over: " << error.what() << '\n';
        }
    }
    if (all.empty()) throw std::runtime_error(options.recordings.front() + ": found no recording in the folder");
    std::vector<std::string> paths;
    for (const Reviewed& one : all) paths.push_back(one.path);
    const std::vector<std::string> names = short_names(paths);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].name = names[i];
    if (all.size() > 1 && all.front().has_laws()) {
        throw std::runtime_error(all[1].path + ": found " + std::to_string(all.size()) +
                                 " recordings, expected one with --law or --open-loop");
    }
    return all;
}

// Of each but the first against the first.
std::vector<sfsm::Comparison> comparisons_of(const std::vector<Reviewed>& all) {
    std::vector<sfsm::Comparison> comparisons;
    for (std::size_t i = 1; i < all.size(); ++i)
        comparisons.push_back({0, i, sfsm::differences_of(all.front().frames(), all[i].frames(), seed)});
    return comparisons;
}

// The recorded run, where it is one of a law or laws are compared with it, and those of the laws.
std::vector<Rerun> reruns_of(const Reviewed& one) {
    std::vector<Rerun> reruns;
    if (one.has_laws() || one.session.recording.has_work()) reruns.push_back(recorded_run(one.session));
    ProgressBar bar("Replaying");
    for (const sfsm::simulate::Contestant& law : one.session.laws) {
        reruns.push_back(rerun(one.session, law));
        bar(static_cast<double>(reruns.size() - 1) / static_cast<double>(one.session.laws.size()));
    }
    return reruns;
}

Json recorded_json(const Reviewed& one, const std::vector<Rerun>& reruns) {
    Json json = reruns.empty() ? Json{{"frames", one.figures.timed}, {"mean_ms", one.figures.mean_ms}}
                               : rerun_json(reruns.front());
    if (std::isfinite(one.over_target.share)) {
        json["over_target_frames"] = one.over_target.frames;
        json["over_target_share"] = one.over_target.share;
    }
    json["figures"] = figures_json(one.figures, one.stutters);
    return json;
}

Json recording_json(const Reviewed& one, const std::vector<Rerun>& reruns) {
    Json json{{"name", one.name}};
    for (const auto& [key, value] : facts_of(one.session, one.path)) json[key] = value;
    if (one.has_laws()) json["delay"] = one.session.delay;  // [frames]
    Json& facts = json["facts"] = Json::object();
    for (const auto& [name, value] : one.session.recording.facts) facts[name] = value;
    json["settings"] = one.session.recording.trace.settings;
    json["notes"] = one.session.recording.notes;
    json["generated"] = one.figures.generated;  // presents, not rendered
    json["recorded"] = recorded_json(one, reruns);
    return json;
}

// Of one recording with its laws; of several each, and how they differ.
Json json_of(const std::vector<Reviewed>& all, const std::vector<Rerun>& reruns,
             const std::vector<sfsm::Comparison>& comparisons) {
    if (all.size() == 1) {
        Json json = recording_json(all.front(), reruns);
        Json& runs = json["runs"] = Json::array();
        for (std::size_t i = 1; i < reruns.size(); ++i) runs.push_back(rerun_json(reruns[i]));
        return json;
    }
    Json json;
    for (const Reviewed& one : all) json["recordings"].push_back(recording_json(one, {}));
    for (const sfsm::Comparison& comparison : comparisons) {
        json["comparisons"].push_back({{"first", all[comparison.first].name},
                                       {"second", all[comparison.second].name},
                                       {"differences", differences_json(comparison.differences)}});
    }
    return json;
}

sfsm::ReportedRecording reported(const Reviewed& one) {
    const sfsm::Recording& recording = one.session.recording;
    return {one.name, recording.facts, recording.notes, one.frames(), one.figures, one.stutters, one.over_target};
}

constexpr const char* law_words =
    "A controller decides before each frame how finely it is drawn, so that it takes as long as the target asks. ";
constexpr const char* closed_words =
    "It never drew this run: what its decisions would have taken is what a model says of their work, times the load "
    "of the recorded frame. Below are the recorded run and what each law would have made of it.";
constexpr const char* open_words =
    "Here each recorded time is taken for the time of its own decision: the times stay as they are, and only what it "
    "would decide is shown.";

void add_runs(sfsm::Report& report, const Reviewed& one, const std::vector<Rerun>& reruns) {
    const bool is_own = one.session.recording.has_work();
    if (!one.has_laws() && !is_own) return;
    report.runs = report_runs(reruns);
    report.facts = loop_facts(one.session);
    report.runs_title = one.has_laws() ? "What a controller would have made of it" : "What the controller decided";
    report.runs_words = one.has_laws() ? law_words + std::string(one.session.course ? closed_words : open_words)
                                       : std::string(sfsm::decision_words);
}

std::string title_of(const std::vector<Reviewed>& all) {
    constexpr std::size_t most_named = 3;
    if (all.size() > most_named) return std::to_string(all.size()) + " recordings";
    std::string title = all.front().name;
    for (std::size_t i = 1; i < all.size(); ++i) title += (i + 1 == all.size() ? " and " : ", ") + all[i].name;
    return title;
}

sfsm::Report report_of(const std::vector<Reviewed>& all, const std::vector<Rerun>& reruns,
                       std::vector<sfsm::Comparison> comparisons) {
    sfsm::Report report;
    report.title = title_of(all);
    for (const Reviewed& one : all) report.recordings.push_back(reported(one));
    report.comparisons = std::move(comparisons);
    add_runs(report, all.front(), reruns);
    return report;
}

void write_csv(std::ostream& out, const std::vector<Reviewed>& all, const std::vector<Rerun>& reruns) {
    if (all.front().has_laws()) return write_trace(out, all.front().session, reruns.at(1));
    for (const Reviewed& one : all) write_frames_csv(out, one.name, one.frames(), &one == &all.front());
}

void print(const std::vector<Reviewed>& all, const std::vector<sfsm::Comparison>& comparisons,
           const sfsm::Report& report) {
    for (const Reviewed& one : all) {
        const std::int64_t untimed = one.figures.frames - one.figures.timed;
        std::cout << one.path << ": " << one.session.recording.format << ", " << one.figures.timed << " frames"
                  << (untimed > 0 ? " and " + std::to_string(untimed) + " without a time" : "") << '\n';
    }
    write_figures(std::cout, report.recordings);
    for (const sfsm::Comparison& comparison : comparisons) {
        std::cout << '\n';
        write_differences(std::cout, all[comparison.first].name, all[comparison.second].name, comparison.differences);
    }
    const Reviewed& first = all.front();
    if (report.runs.empty()) return;
    std::cout << '\n';
    if (first.has_laws()) {
        std::cout << (first.session.course ? "closed" : "open") << " loop, delay " << first.session.delay << ", ";
    }
    std::cout << "target " << first.session.recording.trace.settings.at("target_ms") << " ms\n";
    write_scores(std::cout, report.runs);
}

}  // namespace

void review(const ReplayOptions& options) {
    const std::vector<RecordedFile> files = recorded_files(options.recordings);
    check_outputs(options, files);
    Outputs outputs(options);
    const std::vector<Reviewed> all = read_all(options, files);
    const std::vector<sfsm::Comparison> comparisons = comparisons_of(all);
    const std::vector<Rerun> reruns = all.size() == 1 ? reruns_of(all.front()) : std::vector<Rerun>{};
    // Of a million frames each takes its time, and there are two cores.
    std::future<sfsm::Report> reported =
        std::async(std::launch::async, [&] { return report_of(all, reruns, comparisons); });
    if (outputs.json) {
        outputs.json->stream() << json_of(all, reruns, comparisons).dump(2, ' ', false, Json::error_handler_t::replace)
                               << '\n';
    }
    const sfsm::Report report = reported.get();
    if (outputs.csv) write_csv(outputs.csv->stream(), all, reruns);
    if (outputs.report) sfsm::write_report_html(outputs.report->stream(), report);
    if (outputs.svg) sfsm::write_report_svg(outputs.svg->stream(), report);
    outputs.commit();
    for (const std::string* path : {&options.json, &options.csv, &options.report, &options.svg})
        if (*path == "-") return;
    print(all, comparisons, report);
}

}  // namespace apps
