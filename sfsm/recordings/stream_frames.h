// What a recording's rows become, stream by stream, before one of them is chosen.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sfsm/recordings/display_times.h"
#include "sfsm/recordings/frame_record.h"
#include "sfsm/recordings/raw_times.h"

namespace sfsm {

// How often something was met, and where first: in which line, or of JSON which entry of the arrays.
struct Tally {
    std::int64_t count = 0, first = 0;

    void add(std::int64_t place) {
        if (count++ == 0) first = place;
    }
    void add(const Tally& later) {
        if (count == 0) first = later.first;
        count += later.count;
    }
};

// Presents that the application did not render stand between its own. What they took belongs to the application's
// next frame, unless they only show a present again that the application's row tells of too.
struct GeneratedFrames {
    Tally rows, of_zero;      // those that are called so, and presents of 0 ms behind others
    std::string type;         // of the first row, as the file has it
    double waiting_ms = 0;    // of those since the application's last frame
    double last_ms = 0;       // of these, the last present's part
    std::size_t present = 0;  // hash of the last present's time, 0: unknown

    std::int64_t count() const { return rows.count + of_zero.count; }
};

// Where a stream stands in its file: lines, and the presents' times as the file has them. Line 0: not told.
struct Span {
    std::int64_t first_line = 0, last_line = 0;
    std::string first_time, last_time;

    void extend(std::int64_t line, std::string_view time) {
        if (first_line == 0) {
            first_line = line;
            first_time = time;
        }
        last_line = line;
        last_time = time;
    }
};

// Which of a few texts comes most often.
class Mostly {
public:
    void add(std::string_view text);
    void add(const Mostly& later);
    std::string text() const;  // of several the first; empty: none

private:
    std::vector<std::pair<std::string, std::int64_t>> counts_;
    std::size_t last_ = 0;
};

struct StreamFrames {
    std::string process, process_id, swap_chain;  // as the file has them
    std::string runtime, resolution;              // of the first row
    Mostly present_modes;
    std::vector<FrameRecord> frames;
    std::vector<RawTime> raw;  // times that become frames when all are known

    DisplayTimes display;

    Tally unshown, unknown_fate, untold, unusable, unusable_parts, unusable_details;
    Tally other_types;       // rows of a FrameType that we don't know
    std::string other_type;  // of the first of them
    GeneratedFrames generated;
    Span span;
    std::vector<std::string> notes;  // of what else was done to the frames

    double seconds() const;
};

// A frame of the application and one of somebody else's; `present` as in GeneratedFrames.
void add_frame(StreamFrames& stream, FrameRecord frame, std::size_t present);
void add_generated(StreamFrames& stream, double ms, std::size_t present);

// Whether a present only shows again what the one before did: it takes exactly 0 ms, and is not the stream's first,
// of which some tools know no time. Then it is counted, and no frame.
bool is_shown_again(StreamFrames& stream, double told_ms, std::int64_t place);

// What is told of a frame, into what is usable: a frame's time in (0, 10 min], a part's in [0, 10 min], an animation
// error of 10 min at most, a count not under 0, else NaN and counted. `place` as in Tally.
FrameRecord usable_frame(FrameRecord told, StreamFrames& stream, std::int64_t place);

std::string counted(std::int64_t count, const char* one, const char* several);

// Notes on all that was counted and how it was read; `place`: "line" or "entry".
std::vector<std::string> all_notes(const StreamFrames& stream, std::string_view place);

// Streams by process, process id and swap chain, in the order in which they come up.
class StreamTable {
public:
    StreamFrames& find(std::string_view process, std::string_view process_id, std::string_view swap_chain);
    std::vector<StreamFrames>& streams() { return streams_; }

private:
    std::vector<StreamFrames> streams_;
    std::unordered_multimap<std::size_t, std::size_t> by_hash_;  // to places in streams_
    std::size_t last_ = 0;
};

// All that a file holds.
struct Collected {
    std::string format;
    std::map<std::string, std::string> settings;  // what the file says of itself
    std::map<std::string, std::string> told;      // that, of the machine and the recorder, where it isn't by key
    std::vector<StreamFrames> streams;
    std::vector<std::string> notes;  // on the file
    std::string_view place = "line";
};

}  // namespace sfsm
