#include "sfsm/recordings/recording.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sfsm/line_reader.h"
#include "sfsm/recordings/capframex_json.h"
#include "sfsm/recordings/csv_recording.h"
#include "sfsm/recordings/formats.h"
#include "sfsm/recordings/row_splitter.h"
#include "sfsm/recordings/swap_chains.h"
#include "sfsm/recordings/text_source.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

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

void refuse_binary(const LineReader& lines) {
    if (lines.head().find('\0') != std::string_view::npos)
        lines.fail("found a binary file, expected " + readable_formats());
}

Recording our_recording(LineReader& lines) {
    Recording recording;
    recording.format = "trace";
    recording.trace = read_trace(lines);
    recording.facts = facts_of_trace(recording.trace.settings);
    if (recording.trace.is_cut) recording.notes.push_back(cut_line_note(lines));
    if (recording.trace.rows.empty())
        lines.fail("found no whole row behind the header of a trace, expected at least one");
    Stream& stream = recording.streams.emplace_back();
    stream.frames = static_cast<std::int64_t>(recording.trace.rows.size());
    recording.frames.reserve(recording.trace.rows.size());
    for (const TraceRow& row : recording.trace.rows) {
        recording.frames.push_back(frame_record(row));
        if (!std::isnan(row.frame_ms)) stream.seconds += row.frame_ms / 1000;
    }
    return recording;
}

Stream summed_up(const StreamFrames& stream) {
    return {stream.process,           stream.process_id,
            stream.swap_chain,        static_cast<std::int64_t>(stream.frames.size()),
            stream.generated.count(), stream.seconds()};
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

std::string_view without_exe(std::string_view process) {
    constexpr std::string_view exe = ".exe";
    const bool has_exe = process.size() > exe.size() && same_name(process.substr(process.size() - exe.size()), exe);
    return has_exe ? process.substr(0, process.size() - exe.size()) : process;
}

// It presents for all, but it is no game.
bool is_compositor(const Stream& stream) {
    return same_name(without_exe(stream.process), "dwm");
}

bool is_process(const Stream& stream, const std::string& wanted) {
    return same_name(without_exe(stream.process), without_exe(wanted)) || same_name(stream.process_id, wanted);
}

bool is_wanted(const Stream& stream, const RecordingOptions& options) {
    if (!options.swap_chain.empty() && !is_same_chain(stream.swap_chain, options.swap_chain)) return false;
    if (options.process.empty()) return !options.swap_chain.empty() || !is_compositor(stream);
    return is_process(stream, options.process) || is_same_chain(stream.swap_chain, options.process);
}

std::size_t choose(const Recording& recording, const std::string& name, const RecordingOptions& options) {
    const auto found = std::find_if(recording.streams.begin(), recording.streams.end(),
                                    [&](const Stream& stream) { return is_wanted(stream, options); });
    if (found != recording.streams.end()) return static_cast<std::size_t>(found - recording.streams.begin());
    if (options.process.empty() && options.swap_chain.empty()) return 0;
    fail_without_match(recording, name, options.swap_chain.empty() ? options.process : options.swap_chain);
}

// Who asks for a swap chain gets it alone.
bool asks_for_chain(const std::vector<StreamFrames>& streams, const RecordingOptions& options) {
    if (!options.swap_chain.empty()) return true;
    if (options.process.empty()) return false;
    const auto is_named = [&](const StreamFrames& stream) { return is_process(summed_up(stream), options.process); };
    const auto has_chain = [&](const StreamFrames& stream) {
        return is_same_chain(stream.swap_chain, options.process);
    };
    return std::none_of(streams.begin(), streams.end(), is_named) &&
           std::any_of(streams.begin(), streams.end(), has_chain);
}

Told told_of(const Collected& collected, const StreamFrames& stream) {
    Told told{collected.format,  stream.process, stream.runtime, stream.resolution, stream.present_modes.text(),
              collected.settings};
    told.settings.insert(collected.told.begin(), collected.told.end());
    return told;
}

// Of what a tool has recorded: the chosen stream.
Recording to_recording(Collected collected, const std::string& name, const RecordingOptions& options) {
    std::vector<StreamFrames>& streams = collected.streams;
    if (!asks_for_chain(streams, options)) join_swap_chains(streams);
    std::stable_sort(streams.begin(), streams.end(),
                     [](const StreamFrames& a, const StreamFrames& b) { return a.frames.size() > b.frames.size(); });
    Recording recording;
    recording.format = collected.format;
    for (const StreamFrames& stream : streams) recording.streams.push_back(summed_up(stream));
    recording.chosen = choose(recording, name, options);
    StreamFrames& chosen = streams[recording.chosen];
    if (chosen.frames.empty()) {
        const std::string type = chosen.generated.type;
        throw std::runtime_error(name + ": found no frame of " + recording.format +
                                 (type.empty() ? "" : " but those of FrameType " + type) + ", expected at least one");
    }
    recording.facts = facts_of(told_of(collected, chosen));
    recording.trace.name = name;
    recording.trace.settings = std::move(collected.settings);
    recording.trace.settings["format"] = recording.format;
    recording.trace.settings["process"] = chosen.process;
    recording.trace.settings["process_id"] = chosen.process_id;
    recording.trace.settings["swap_chain"] = chosen.swap_chain;
    recording.notes = all_notes(chosen, collected.place);
    recording.frames = std::move(chosen.frames);
    recording.notes.insert(recording.notes.end(), collected.notes.begin(), collected.notes.end());
    return recording;
}

}  // namespace

Recording read_recording(std::istream& in, const std::string& name, const RecordingOptions& options,
                         const HearFrames& hear) {
    TextSource source(in, name);
    LineReader lines(source.stream(), name);
    refuse_binary(lines);
    Recording recording;
    if (is_our_trace(lines.head())) {
        recording = our_recording(lines);
        recording.chosen = choose(recording, name, options);
    } else {
        recording =
            to_recording(is_json(lines.head()) ? read_capframex_json(lines)
                                               : read_csv_recording(lines, {options.column, options.unit}, hear),
                         name, options);
    }
    recording.notes.insert(recording.notes.end(), source.notes().begin(), source.notes().end());
    return recording;
}

}  // namespace sfsm
