#include "sfsm/recordings/recording.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sfsm/line_reader.h"
#include "sfsm/recordings/capframex_json.h"
#include "sfsm/recordings/csv_recording.h"
#include "sfsm/recordings/formats.h"
#include "sfsm/recordings/mangohud.h"
#include "sfsm/recordings/row_splitter.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Whether the first line that is no setting is the header of one of ours.
bool is_our_trace(std::string_view head) {
    while (head.starts_with('#')) {
        const std::size_t newline = head.find('\n');
        head.remove_prefix(newline == std::string_view::npos ? head.size() : newline + 1);
    }
    const std::vector<std::string> fields = split_fields(head.substr(0, head.find_first_of("\r\n")), ',');
    const auto has = [&](std::string_view name) {
        return std::find(fields.begin(), fields.end(), name) != fields.end();
    };
    return has("frame_ms") && has("target_ms");
}

bool is_json(std::string_view head) {
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && (head[first] == '{' || head[first] == '[');
}

void refuse_other_bytes(const LineReader& lines) {
    const std::string_view head = lines.head();
    const char* found = nullptr;
    if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF")) {
        found = "found UTF-16 text, expected UTF-8: save it so, as ";
    } else if (head.find('\0') != std::string_view::npos) {
        found = "found a binary file, expected ";
    }
    if (found) lines.fail(found + readable_formats());
}

Recording our_recording(LineReader& lines) {
    Recording recording;
    recording.format = "trace";
    recording.trace = read_trace(lines);
    if (recording.trace.is_cut) recording.notes.push_back(cut_line_note(lines));
    if (recording.trace.rows.empty())
        lines.fail("found no whole row behind the header of a trace, expected at least one");
    Stream& stream = recording.streams.emplace_back();
    stream.frames = static_cast<std::int64_t>(recording.trace.rows.size());
    for (const TraceRow& row : recording.trace.rows) {
        if (!std::isnan(row.frame_ms)) stream.seconds += row.frame_ms / 1000;
    }
    return recording;
}

Stream summed_up(const StreamFrames& stream) {
    return {stream.process, stream.process_id, stream.swap_chain, static_cast<std::int64_t>(stream.frames.size()),
            stream.seconds()};
}

// As PresentMon and its kin call it; empty: nothing to call it by.
std::string called(const Stream& stream) {
    std::string text = shown(stream.process);
    if (!stream.process_id.empty()) text += ", id " + shown(stream.process_id);
    if (!stream.swap_chain.empty()) text += ", swap chain " + shown(stream.swap_chain);
    return text + ": " + std::to_string(stream.frames) + " frames";
}

[[noreturn]] void fail_without_match(const Recording& recording, const std::string& name, const std::string& wanted) {
    constexpr std::size_t most_listed = 8;
    std::string message = name + ": found no process, process id or swap chain " + shown(wanted) + ", expected ";
    if (recording.streams.size() == 1 && recording.streams[0].process.empty()) {
        throw std::runtime_error(message + "none: " + recording.format + " does not tell them");
    }
    for (std::size_t i = 0; i < std::min(recording.streams.size(), most_listed); ++i) {
        message += (i == 0 ? "one of " : "; ") + called(recording.streams[i]);
    }
    const std::size_t more = recording.streams.size() - std::min(recording.streams.size(), most_listed);
    throw std::runtime_error(message + (more > 0 ? "; and " + std::to_string(more) + " more" : ""));
}

std::size_t choose(const Recording& recording, const std::string& name, const std::string& wanted) {
    if (wanted.empty()) return 0;
    const auto is_wanted = [&](const Stream& stream) {
        return same_name(stream.process, wanted) || same_name(stream.process_id, wanted) ||
               same_name(stream.swap_chain, wanted);
    };
    const auto found = std::find_if(recording.streams.begin(), recording.streams.end(), is_wanted);
    if (found == recording.streams.end()) fail_without_match(recording, name, wanted);
    return static_cast<std::size_t>(found - recording.streams.begin());
}

std::vector<TraceRow> to_rows(const std::vector<FrameTimes>& frames) {
    std::vector<TraceRow> rows(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        rows[i].frame = static_cast<std::int64_t>(i);
        rows[i].target_ms = unknown;
        rows[i].frame_ms = frames[i].frame_ms;
        rows[i].cpu_ms = frames[i].cpu_ms;
        rows[i].gpu_ms = frames[i].gpu_ms;
    }
    return rows;
}

// Of what a tool has recorded: the chosen stream as a trace.
Recording to_recording(Collected collected, const std::string& name, const RecordingOptions& options) {
    std::vector<StreamFrames>& streams = collected.streams;
    for (StreamFrames& stream : streams) {
        spread_samples(stream, name);
        merge_generated_presents(stream);
    }
    std::stable_sort(streams.begin(), streams.end(),
                     [](const StreamFrames& a, const StreamFrames& b) { return a.frames.size() > b.frames.size(); });
    Recording recording;
    recording.format = collected.format;
    for (const StreamFrames& stream : streams) recording.streams.push_back(summed_up(stream));
    recording.chosen = choose(recording, name, options.process);
    const StreamFrames& chosen = streams[recording.chosen];
    if (chosen.frames.empty()) {
        throw std::runtime_error(name + ": found no frame of " + recording.format + ", expected at least one");
    }
    recording.trace.name = name;
    recording.trace.rows = to_rows(chosen.frames);
    recording.trace.settings = std::move(collected.settings);
    recording.trace.settings["format"] = recording.format;
    recording.trace.settings["process"] = chosen.process;
    recording.trace.settings["process_id"] = chosen.process_id;
    recording.trace.settings["swap_chain"] = chosen.swap_chain;
    recording.notes = all_notes(chosen, collected.place);
    recording.notes.insert(recording.notes.end(), collected.notes.begin(), collected.notes.end());
    return recording;
}

}  // namespace

Recording read_recording(std::istream& in, const std::string& name, const RecordingOptions& options) {
    LineReader lines(in, name);
    refuse_other_bytes(lines);
    if (is_our_trace(lines.head())) {
        Recording recording = our_recording(lines);
        recording.chosen = choose(recording, name, options.process);
        return recording;
    }
    return to_recording(is_json(lines.head()) ? read_capframex_json(lines) : read_csv_recording(lines), name, options);
}

}  // namespace sfsm
