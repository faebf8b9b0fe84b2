#include "sfsm/recordings/capframex_json.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "sfsm/line_reader.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

constexpr std::string_view expected =
    ", expected CapFrameX's \"Runs\" with \"MsBetweenPresents\" in their \"CaptureData\"";

// The arrays that are read; some have one of two names. Those from `display_change` on may be of another length, and
// are then left out.
enum Array { presents, dropped, cpu, gpu, display_change, animation_error, present_seconds, in_present };
constexpr std::array<std::pair<std::string_view, Array>, 11> array_names = {{{"MsBetweenPresents", presents},
                                                                             {"Dropped", dropped},
                                                                             {"CpuActive", cpu},
                                                                             {"MsCPUBusy", cpu},
                                                                             {"GpuActive", gpu},
                                                                             {"MsGPUBusy", gpu},
                                                                             {"MsBetweenDisplayChange", display_change},
                                                                             {"MsAnimationError", animation_error},
                                                                             {"AnimationError", animation_error},
                                                                             {"TimeInSeconds", present_seconds},
                                                                             {"MsInPresentAPI", in_present}}};
using Run = std::array<std::vector<double>, 8>;

std::string_view name_of(Array array) {
    return std::find_if(array_names.begin(), array_names.end(), [&](const auto& name) { return name.second == array; })
        ->first;
}

// A file's bytes, with null for numbers that JSON hasn't but files have: NaN, Infinity, -Infinity.
class Source {
public:
    explicit Source(LineReader& lines) : lines_(lines) {}

    // Nothing is taken before the parser asks for it, or errors would name the line of the byte behind.
    int peek() {
        if (at_ == null_.size() && !is_in_text_) begin_null();
        return at_ < null_.size() ? null_[at_] : lines_.peek_byte();
    }
    void next() {
        if (at_ < null_.size()) {
            ++at_;
            return;
        }
        const int byte = lines_.next_byte();
        if (is_escaped_) {
            is_escaped_ = false;
        } else if (byte == '"') {
            is_in_text_ = !is_in_text_;
        } else {
            is_escaped_ = is_in_text_ && byte == '\\';
        }
    }

private:
    // A minus sign waits for what follows it.
    void begin_null() {
        const bool is_minus = lines_.peek_byte() == '-';
        if (is_minus) lines_.next_byte();
        const int byte = lines_.peek_byte();
        const std::string_view word = byte == 'N' ? "NaN" : byte == 'I' ? "Infinity" : "";
        std::size_t length = 0;
        while (length < word.size() && lines_.peek_byte() == word[length]) {
            lines_.next_byte();
            ++length;
        }
        const bool is_whole = !word.empty() && length == word.size();
        null_ = is_whole ? "null" : length > 0 ? "?" : is_minus ? "-" : "";
        at_ = 0;
    }

    LineReader& lines_;
    std::string_view null_;  // what is read in place of the file's bytes, from at_ on
    std::size_t at_ = 0;
    bool is_in_text_ = false, is_escaped_ = false;
};

// The same as the parser takes them.
class Bytes {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = char;

    Bytes() = default;  // the end
    explicit Bytes(Source& source) : source_(&source) {}

    char operator*() const { return static_cast<char>(source_->peek()); }
    Bytes& operator++() {
        source_->next();
        return *this;
    }
    bool operator==(const Bytes& other) const { return is_end() == other.is_end(); }
    bool operator!=(const Bytes& other) const { return !(*this == other); }

private:
    bool is_end() const { return !source_ || source_->peek() < 0; }

    Source* source_ = nullptr;
};

// Takes the parser's events. Knows where it is by the keys that lead there, one of each open object or array; an
// array's is empty.
class Events : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit Events(const LineReader& lines) : lines_(lines) {}

    bool null() override { return take(std::numeric_limits<double>::quiet_NaN()); }
    bool boolean(bool value) override;
    bool number_integer(number_integer_t value) override { return take(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return take(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return take(value); }
    bool binary(binary_t&) override { return false; }  // JSON has none
    bool string(string_t& value) override;

    bool start_object(std::size_t) override { return enter(); }
    bool end_object() override { return leave(); }
    bool start_array(std::size_t) override;
    bool end_array() override { return leave(); }
    bool key(string_t& key) override {
        path_.back() = key;
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
        // Errors of a number too large have another id than those of the syntax.
        lines_.fail(std::string(error.id == number_out_of_range ? "found a number too large for a time"
                                                                : "found JSON that is damaged or cut short") +
                    std::string(expected));
    }

    std::vector<Run> runs;
    std::map<std::string, std::string> info;

private:
    static constexpr int number_out_of_range = 406;
    static constexpr std::size_t deepest = 32;

    bool enter();
    bool leave();
    bool take(double value);
    bool is_value() const { return array_ && path_.size() == 5; }  // root, "Runs", run, "CaptureData", the array

    const LineReader& lines_;
    std::vector<std::string> path_;
    std::optional<Array> array_;  // the one that we are in
};

bool Events::enter() {
    if (path_.size() == deepest) {
        lines_.fail("found JSON nested deeper than " + std::to_string(deepest) + std::string(expected));
    }
    if (path_.size() == 2 && path_[0] == "Runs") runs.emplace_back();
    path_.emplace_back();
    return true;
}

bool Events::leave() {
    if (is_value()) array_.reset();
    path_.pop_back();
    return true;
}

bool Events::start_array(std::size_t) {
    if (path_.size() == 4 && path_[0] == "Runs" && path_[2] == "CaptureData") {
        for (const auto& [name, array] : array_names) {
            if (path_[3] == name) array_ = array;
        }
    }
    return enter();
}

bool Events::take(double value) {
    if (is_value()) runs.back()[*array_].push_back(value);
    return true;
}

bool Events::boolean(bool value) {
    if (is_value() && array_ != dropped) {
        lines_.fail("found true or false in " + shown(path_[3]) + ", expected a number");
    }
    return take(value ? 1 : 0);
}

// CapFrameX writes what is no finite number in quotes.
bool Events::string(string_t& value) {
    if (is_value()) {
        if (value != "NaN" && value != "Infinity" && value != "-Infinity")
            lines_.fail("found " + shown(value) + " in " + shown(path_[3]) + ", expected a number");
        return take(std::numeric_limits<double>::quiet_NaN());
    }
    if (path_.size() == 2 && path_[0] == "Info") info[path_[1]] = value;
    return true;
}

double part(const Run& run, Array array, std::size_t i) {
    return run[array].empty() ? std::numeric_limits<double>::quiet_NaN() : run[array][i];
}

void check_lengths(Run& run, StreamFrames& stream, const LineReader& lines) {
    for (const Array array : {dropped, cpu, gpu}) {
        if (run[array].empty() || run[array].size() == run[presents].size()) continue;
        lines.fail("found arrays of " + std::to_string(run[presents].size()) + " and " +
                   std::to_string(run[array].size()) + " entries in a run, expected all of one length");
    }
    for (const Array array : {display_change, animation_error, present_seconds, in_present}) {
        if (run[array].empty() || run[array].size() == run[presents].size()) continue;
        stream.notes.push_back(std::string(name_of(array)) + " has " + std::to_string(run[array].size()) +
                               " entries, not " + std::to_string(run[presents].size()) + ": left out");
        run[array] = {};
    }
}

FrameRecord::Fate fate(const Run& run, std::size_t i, StreamFrames& stream, std::int64_t entry) {
    if (run[dropped].empty()) return FrameRecord::Fate::untold;
    if (run[dropped][i] == 0) return FrameRecord::Fate::shown;
    if (run[dropped][i] != 1) return FrameRecord::Fate::untold;
    stream.unshown.add(entry);
    return FrameRecord::Fate::dropped;
}

DisplayRow display_row(const Run& run, std::size_t i) {
    constexpr double ms_per_s = 1000;
    DisplayRow row;
    row.display_ms = part(run, display_change, i);
    row.present_ms = ms_per_s * part(run, present_seconds, i);
    row.in_present_ms = part(run, in_present, i);
    return row;
}

StreamFrames to_stream(Run& run, const LineReader& lines) {
    StreamFrames stream;
    check_lengths(run, stream, lines);
    const bool computes_errors = run[animation_error].empty();
    stream.frames.reserve(run[presents].size());
    for (std::size_t i = 0; i < run[presents].size(); ++i) {
        const std::int64_t entry = static_cast<std::int64_t>(i) + 1;
        const DisplayRow display = display_row(run, i);
        if (is_shown_again(stream, run[presents][i], entry)) {
            stream.display.add_generated(display);
            continue;
        }
        FrameRecord told{run[presents][i], part(run, cpu, i), part(run, gpu, i)};
        told.fate = fate(run, i, stream, entry);
        told.display_ms = static_cast<float>(stream.display.add(display, told, {false, computes_errors}));
        if (told.fate != FrameRecord::Fate::dropped)
            told.animation_error_ms = static_cast<float>(part(run, animation_error, i));
        add_frame(stream, usable_frame(told, stream, entry), 0);
    }
    if (stream.display.finish(stream.frames))
        stream.notes.push_back(computed_note("TimeInSeconds + MsInPresentAPI", "MsBetweenDisplayChange"));
    return stream;
}

}  // namespace

Collected read_capframex_json(LineReader& lines) {
    Events events(lines);
    Source source(lines);
    nlohmann::json::sax_parse(Bytes(source), Bytes(), &events);
    Collected collected;
    collected.format = "CapFrameX JSON";
    collected.settings = events.info;
    collected.place = "entry";
    for (Run& run : events.runs) {
        StreamFrames& stream = collected.streams.emplace_back(to_stream(run, lines));
        if (const auto name = events.info.find("ProcessName"); name != events.info.end()) stream.process = name->second;
        if (events.runs.size() > 1) stream.swap_chain = "run " + std::to_string(collected.streams.size());
    }
    if (collected.streams.empty()) lines.fail("found JSON without runs" + std::string(expected));
    return collected;
}

}  // namespace sfsm
