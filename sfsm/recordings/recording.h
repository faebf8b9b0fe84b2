// A recorded run of any of the tools people use, frame by frame: our own traces, PresentMon 1.x, 2.x and the
// current console columns, OCAT, CapFrameX CSV and JSON, FrameView, MangoHud (per frame and sampled), FRAPS, MSI
// Afterburner, Unreal's CSV profiler, and any table with a column of times.
// docs/recordings.md lists what each one's columns become and how their quirks are read.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sfsm/recordings/facts.h"
#include "sfsm/recordings/frame_record.h"
#include "sfsm/recordings/raw_times.h"
#include "sfsm/trace.h"

namespace sfsm {

// What one process presented, through one swap chain or several made one after the other; of CapFrameX JSON with
// several runs one run, as swap chain "run 1" ...
struct Stream {
    std::string process, process_id, swap_chain;  // empty where the tool doesn't say; joined chains with blanks between
    std::int64_t frames = 0;
    std::int64_t generated = 0;  // presents besides, that the application did not render
    double seconds = 0;          // sum of the frame times
};

struct Recording {
    std::string format;  // "trace", "CapFrameX JSON" or a name of formats.cpp: "PresentMon 1.x", "OCAT" ...

    std::vector<FrameRecord> frames;  // of the chosen stream

    // One of ours as it is. Else without rows; its settings are format, process, process_id, swap_chain (empty: not
    // told), and what the file says of itself before its header.
    Trace trace;

    Facts facts;                     // of the run and the machine
    std::vector<Stream> streams;     // all in the file, most frames first; one nameless where the tool has no processes
    std::size_t chosen = 0;          // of them
    std::vector<std::string> notes;  // what was left out or put together, a line each, with counts and line numbers
    bool has_work() const { return format == "trace"; }
};

struct RecordingOptions {
    // Which stream: a process name (any case, with ".exe" or without), a process id or a swap chain; of several that
    // match the one with most frames. Empty: of all but the desktop's compositor, if there are others.
    std::string process = {};

    // One swap chain alone, not joined with those before and after it. Empty: as `process` says.
    std::string swap_chain = {};

    // Of a table the column that has the times: its name in any case, or its number from 1 where columns have no names.
    // Empty: as the format says. Its unit where neither the name nor the format tells it; nothing: guessed.
    std::string column = {};
    std::optional<Unit> unit = {};
};

// Told of the frames of the file's first stream while it is read, some thousand at a time, where they are known as soon
// as their rows are. The last aren't told, or none: who hears them must compare them with Recording::frames, as another
// stream may be chosen. Of a frame only the times are meant.
using HearFrames = std::function<void(std::span<const FrameRecord>)>;

// The file may be packed by gzip, and be UTF-16. Reads in pieces: memory grows with the frames, not with the bytes.
// Columns are found by name. Throws std::runtime_error: one line with `name`, the line number, what was found and what
// was expected.
Recording read_recording(std::istream& in, const std::string& name, const RecordingOptions& options = {},
                         const HearFrames& hear = {});

}  // namespace sfsm
