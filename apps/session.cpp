#include "apps/session.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>

#include "apps/contestants.h"
#include "sfsm/controller.h"
#include "sfsm/replay.h"
#include "sfsm/simulate/recorded.h"
#include "sfsm/target.h"
#include "sfsm/text.h"

namespace apps {
namespace {

namespace sim = sfsm::simulate;

constexpr int gpu_delay = 2;  // [frames] until a timer query's time is there: of recordings that don't say

void say(const std::string& line) {
    std::fprintf(stderr, "replay: %s\n", line.c_str());
}

std::string describe(const sfsm::Stream& stream) {
    const std::string name = sfsm::presentable(stream.process);
    std::string text = name.empty() ? "unnamed" : sfsm::shown(name);
    for (const std::string& part : {stream.process_id, stream.swap_chain})
        if (!part.empty()) text += " " + sfsm::shown(part);
    return text + " (" + std::to_string(stream.frames) + " frames)";
}

// Which of several streams was taken.
std::string chosen_note(const sfsm::Recording& recording) {
    constexpr std::size_t most_named = 8;
    std::string others;
    for (std::size_t i = 0; i < recording.streams.size() && i <= most_named; ++i) {
        if (i != recording.chosen) others += (others.empty() ? "" : ", ") + describe(recording.streams[i]);
    }
    if (recording.streams.size() > most_named + 1) others += ", ...";
    return std::to_string(recording.streams.size()) +
           " streams; taken: " + describe(recording.streams[recording.chosen]) +
           "; --process takes another of: " + others;
}

sfsm::Recording read(const std::string& path, const sfsm::RecordingOptions& options,
                     const sfsm::HearFrames& hear = {}) {
    errno = 0;
    std::ifstream file;
    if (path != "-") file.open(path, std::ios::binary);
    if (path != "-" && !file)
        throw std::runtime_error("cannot read " + path + ": " + std::strerror(errno) + ", expected a recording");
    sfsm::Recording recording = sfsm::read_recording(path == "-" ? std::cin : file, path, options, hear);
    if (recording.streams.size() > 1) recording.notes.push_back(chosen_note(recording));
    for (const std::string& note : recording.notes) say(path + ": " + note);
    return recording;
}

sfsm::TargetSchedule targets_for(const std::string& asked) {
    return sfsm::TargetSchedule::parse(asked.empty() ? sfsm::default_target : std::string_view(asked));
}

void set_targets(Session& session, const std::string& asked) {
    session.has_targets = !asked.empty() || session.recording.has_work() || !session.laws.empty();
    if (!session.has_targets) return;
    session.targets = targets_for(asked);
    for (sfsm::TraceRow& row : session.recording.trace.rows) {
        if (!asked.empty() || !(std::isfinite(row.target_ms) && row.target_ms > 0))
            row.target_ms = session.targets.at(row.frame);
    }
    std::map<std::string, std::string>& settings = session.recording.trace.settings;
    if (!asked.empty() || !settings.contains("target_ms")) settings["target_ms"] = session.targets.text();
}

sim::Scenario scenario_of(const Session& session) {
    if (!session.recording.has_work()) return sim::foreign_scenario(rows_of(session), session.delay);
    return sim::recorded_scenario(session.recording.trace.rows, {session.delay, true, session.drawing});
}

// Those asked for; for an open loop else the default.
std::vector<sim::Contestant> laws_for(const ReplayOptions& options) {
    if (options.laws.empty() && !options.open_loop) return {};
    std::vector<sim::Contestant> laws =
        chosen_laws("--law", options.laws.empty() ? std::string(sfsm::law_names().front()) : options.laws);
    if (options.open_loop) std::erase_if(laws, needs_course);
    return laws;
}

// Those asked for; for an open loop else the trace's.
std::vector<sim::Contestant> laws_for(const ReplayOptions& options, const sfsm::Recording& recording) {
    const bool is_told = recording.has_work() && recording.trace.settings.contains("law");
    if (options.laws.empty() && options.open_loop && is_told) return {law_of(recording.trace, false)};
    return laws_for(options);
}

std::unique_ptr<EarlyRun> begin_early(const ReplayOptions& options) {
    const std::vector<sim::Contestant> laws = laws_for(options);
    if (laws.empty() || !options.open_loop) return nullptr;
    return std::make_unique<EarlyRun>(laws.front(), targets_for(options.target_ms), options.delay.value_or(gpu_delay));
}

}  // namespace

Session open_session(const ReplayOptions& options, const std::string& path) {
    Session session;
    session.early = begin_early(options);
    sfsm::HearFrames hear;
    if (session.early) {
        hear = [&early = *session.early](std::span<const sfsm::FrameRecord> frames) { early.add(frames); };
    }
    session.recording =
        read(path, {options.process, options.swap_chain, options.column, sfsm::unit_named(options.unit)}, hear);
    const bool has_work = session.recording.has_work();
    if (session.early && (has_work || !session.early->end_with(session.recording.frames))) session.early.reset();
    session.delay = options.delay.value_or(has_work ? sfsm::trace_delay(session.recording.trace) : gpu_delay);
    if (has_work) session.drawing = sfsm::trace_drawing(session.recording.trace);
    session.laws = laws_for(options, session.recording);
    set_targets(session, options.target_ms);
    if (!session.laws.empty() && !options.open_loop)
        session.course = made_of(path, [&] { return sim::make_course(scenario_of(session)); });
    return session;
}

sfsm::Trace read_own_trace(const std::string& path) {
    sfsm::Recording recording = read(path, {});
    if (!recording.has_work())
        throw std::runtime_error(path + ": found a recording of " + recording.format + ", expected a trace of ours");
    return std::move(recording.trace);
}

sim::Contestant law_of(const sfsm::Trace& trace, bool may_need_course) {
    const std::string& name = trace.settings.at("law");
    const std::optional<sim::Contestant> law = find_law(name);
    if (!law)
        throw std::runtime_error(trace.name + ": found setting law=" + sfsm::shown(name) +
                                 ", expected one of: " + law_list());
    if (!may_need_course && needs_course(*law))
        throw std::runtime_error(trace.name + ": found setting law=" + sfsm::shown(name) +
                                 ", which knows what frames cost, expected one that decides without");
    return *law;
}

sfsm::RunRows rows_of(const Session& session) {
    if (session.recording.has_work()) return sfsm::run_rows(session.recording.trace.rows);
    return {session.recording.frames.size(),
            [&session, row = sfsm::TraceRow()](std::size_t i) mutable -> const sfsm::TraceRow& {
                const sfsm::FrameRecord& frame = session.recording.frames[i];
                row.frame = static_cast<std::int64_t>(i);
                row.target_ms = session.targets.at(row.frame);
                row.frame_ms = frame.frame_ms;
                row.cpu_ms = frame.cpu_ms;
                row.gpu_ms = frame.gpu_ms;
                return row;
            }};
}

Rerun recorded_run(const Session& session) {
    const sfsm::RunRows rows = rows_of(session);
    Rerun rerun{"recorded", {}, {}};
    rerun.frames.reserve(rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
        const sfsm::TraceRow& row = rows.at(i);
        rerun.frames.push_back({row.target_ms, row.frame_ms, row.predicted_ms, row.decision});
    }
    return rerun;
}

Rerun rerun(const Session& session, const sim::Contestant& law) {
    if (session.early && session.early->has_result() && session.early->law() == law.name)
        return session.early->result();
    return session.course ? rerun_closed(law, *session.course)
                          : rerun_open(law, rows_of(session), session.delay, session.drawing);
}

std::vector<std::pair<std::string, std::string>> loop_facts(const Session& session) {
    if (session.laws.empty()) return {};
    std::vector<std::pair<std::string, std::string>> facts = {
        {"loop",
         session.course ? "closed: a cost model times the recorded load" : "open: the recorded times as they are"},
        {"delay", std::to_string(session.delay) + " frames"}};
    if (session.course && !session.recording.has_work()) facts.emplace_back("cost model", "the reference crowd");
    return facts;
}

std::vector<std::pair<std::string, std::string>> facts_of(const Session& session, const std::string& path) {
    const sfsm::Recording& recording = session.recording;
    std::vector<std::pair<std::string, std::string>> facts = {{"recording", path}, {"format", recording.format}};
    for (const auto& fact : loop_facts(session)) facts.push_back(fact);
    for (const char* key : {"process", "process_id", "swap_chain", "target_ms"}) {
        if (const auto found = recording.trace.settings.find(key); found != recording.trace.settings.end())
            facts.emplace_back(*found);
    }
    return facts;
}

namespace {

// What the recording has of a frame, and what the law decided.
sfsm::TraceRow redecided(const sfsm::TraceRow& recorded, const RerunFrame& rerun) {
    sfsm::TraceRow row;
    row.frame = recorded.frame;
    row.target_ms = recorded.target_ms;
    row.frame_ms = recorded.frame_ms;
    row.cpu_ms = recorded.cpu_ms;
    row.gpu_ms = recorded.gpu_ms;
    row.range = recorded.range;
    row.work = recorded.work;
    row.predicted_ms = rerun.predicted_ms;
    row.decision = rerun.decision;
    row.motion = recorded.motion;
    row.shapes = recorded.shapes;
    row.rates = recorded.rates;
    return row;
}

}  // namespace

void write_trace(std::ostream& out, const Session& session, const Rerun& rerun) {
    std::map<std::string, std::string> settings = session.recording.trace.settings;
    settings["law"] = rerun.law;
    settings["state"] = "auto";
    settings["delay"] = std::to_string(session.delay);
    settings["version"] = GRANDSTAND_VERSION;
    settings["replayed"] = session.course ? "closed loop" : "open loop";
    sfsm::write_trace_header(out, settings);
    const sfsm::RunRows recorded = rows_of(session);
    for (std::size_t i = 0; i < rerun.frames.size(); ++i) {
        const RerunFrame& frame = rerun.frames[i];
        sfsm::write_trace_row(out, session.course
                                       ? trace_row(*session.course->scenario.plant, static_cast<std::int64_t>(i), frame)
                                       : redecided(recorded.at(i), frame));
    }
}

}  // namespace apps
