#include "sfsm/recordings/formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include "sfsm/line_reader.h"
#include "sfsm/number_text.h"
#include "sfsm/recordings/row_splitter.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

constexpr std::string_view own_frames = "frames of replay";

// The first that fits is it.
const std::vector<Format>& formats() {
    static const std::vector<Format> table = {
        {"CapFrameX CSV", Rows::presents, "MsBetweenPresents", {}, true},
        {"FrameView", Rows::presents, "MsBetweenPresents", {"Resolution", "Render Queue Depth"}},
        {"OCAT", Rows::presents, "MsBetweenPresents", {"Motherboard", "Base Driver Version", "Driver Package"}},
        {"PresentMon current",
         Rows::presents,
         "MsBetweenPresents",
         {"PresentRuntime", "MsCPUBusy", "MsGPUBusy", "MsBetweenAppStart", "FrameType"}},
        {"PresentMon 1.x", Rows::presents, "MsBetweenPresents", {}},
        {"PresentMon 2.x", Rows::presents, "FrameTime", {"CPUBusy", "GPUBusy", "DisplayedTime", "Application"}},
        {"PresentMon 2.0", Rows::presents, "CPUBusy", {}, false, "CPUWait"},
        {"PresentMon 2.0", Rows::presents, "CPUDuration", {}, false, "CPUFramePacingStall"},
        {"PresentMon 2.0", Rows::presents, "MsCPUBusy", {}, false, "MsCPUWait"},
        {"MangoHud", Rows::samples, "frametime", {"fps"}},
        {own_frames, Rows::frames, "frame_time_ms", {"animation_error_ms"}},
        {"FRAPS", Rows::clock, "Time (ms)", {"Frame"}},
        {"Unreal CSV profile",
         Rows::frames,
         "FrameTime",
         {"EVENTS", "GameThreadTime", "RenderThreadTime"},
         false,
         {},
         {},
         Format::Lines::unreal},
        {"Afterburner", Rows::times, "Frametime", {"02"}, false, {}, Unit::ms, Format::Lines::afterburner},
        {"Afterburner", Rows::times, "Framerate", {"02"}, false, {}, Unit::fps, Format::Lines::afterburner},
        {"Afterburner", Rows::times, "Frametime", {"Framerate", "GPU usage", "GPU temperature"}, false, {}, Unit::ms},
        {"Afterburner", Rows::times, "Framerate", {"GPU usage", "GPU temperature"}, false, {}, Unit::fps},
    };
    return table;
}

// Other names for the same; the first that a file has is read. The frame time's is the format's.
struct Names {
    Column column;
    std::vector<std::string_view> names;
};
const std::vector<Names>& other_columns() {
    static const std::vector<Names> table = {
        {Column::process, {"Application"}},
        {Column::process_id, {"ProcessID"}},
        {Column::swap_chain, {"SwapChainAddress"}},
        {Column::cpu, {"MsCPUBusy", "CPUBusy", "CpuActive", "GameThreadTime", "cpu_ms"}},
        {Column::gpu, {"MsGPUBusy", "GPUBusy", "MsGPUActive", "GpuActive", "GPUTime", "gpu_ms"}},
        {Column::dropped, {"Dropped"}},
        {Column::displayed, {"DisplayedTime", "MsUntilDisplayed", "MsBetweenDisplayChange"}},
        {Column::frame_type, {"FrameType"}},
        {Column::present_time,
         {"TimeInSeconds", "TimeInMs", "TimeInQPC", "TimeInDateTime", "QPCTime", "CPUStartTime", "CPUStartTimeInMs",
          "CPUStartQPC", "CPUStartQPCTime", "CPUStartQPCTimeInMs", "CPUStartDateTime"}},
        {Column::display_change, {"MsBetweenDisplayChange", "display_ms"}},
        {Column::displayed_time, {"DisplayedTime"}},
        {Column::animation_error, {"MsAnimationError", "AnimationError", "animation_error_ms"}},
        {Column::compilations, {"PsoCompileCount", "compilations"}},
        {Column::animation_time, {"AnimationTime", "MsAnimationTime"}},
        {Column::simulation_step, {"MsBetweenSimulationStart"}},
        {Column::cpu_start, {"CPUStartTime", "CPUStartTimeInMs", "CPUStartQPCTimeInMs", "CPUStartQPCTime"}},
        {Column::present_seconds, {"TimeInSeconds"}},
        {Column::in_present, {"MsInPresentAPI"}},
        {Column::runtime, {"PresentRuntime", "Runtime"}},
        {Column::resolution, {"Resolution"}},
        {Column::present_mode, {"PresentMode"}},
        {Column::fps, {"fps"}},
        {Column::elapsed, {"elapsed"}},
        {Column::record, {"02"}},
    };
    return table;
}

bool contains(const std::vector<std::string>& fields, std::string_view name) {
    return std::any_of(fields.begin(), fields.end(), [&](const std::string& field) { return same_name(field, name); });
}

bool fits(const Format& format, const std::vector<std::string>& fields, bool after_preamble) {
    if (format.has_preamble && !after_preamble) return false;
    if (!contains(fields, format.frame_time)) return false;
    if (!format.frame_rest.empty() && !contains(fields, format.frame_rest)) return false;
    return format.marks.empty() || std::any_of(format.marks.begin(), format.marks.end(),
                                               [&](std::string_view mark) { return contains(fields, mark); });
}

void place_column(Header& header, Column column, std::string_view name, const std::vector<std::string>& fields,
                  const LineReader& place) {
    const std::size_t index = static_cast<std::size_t>(column);
    for (std::size_t i = 0; i < fields.size() && !name.empty(); ++i) {
        if (!same_name(fields[i], name)) continue;
        if (header.position[index]) {
            if (may_be_missing(column)) return;
            place.fail("found two columns '" + std::string(name) + "', expected one");
        }
        header.position[index] = i;
        header.names[index] = fields[i];
    }
}

void drop(Header& header, Column column) {
    header.position[static_cast<std::size_t>(column)].reset();
}

// Of what animation errors are computed, where they aren't told.
void drop_simulation_starts(Header& header) {
    for (const Column column : {Column::animation_time, Column::simulation_step, Column::cpu_start,
                                Column::present_seconds, Column::in_present}) {
        drop(header, column);
    }
}

Header place_columns(const Format& format, char separator, const std::vector<std::string>& fields,
                     const LineReader& place) {
    Header header{&format, separator, fields.size(), {format.unit, ColumnMeaning::Sense::frames}, false, {}, {}};
    place_column(header, Column::frame_time, format.frame_time, fields, place);
    place_column(header, Column::frame_rest, format.frame_rest, fields, place);
    for (const Names& other : other_columns()) {
        for (const std::string_view name : other.names) {
            if (!header.has(other.column)) place_column(header, other.column, name, fields, place);
        }
    }
    if (format.name == own_frames) place_column(header, Column::process, "run", fields, place);
    if (header.has(Column::dropped)) drop(header, Column::displayed);
    if (header.has(Column::frame_rest)) drop(header, Column::cpu);  // it is the frame time's first part
    if (header.has(Column::display_change)) drop(header, Column::displayed_time);
    if (header.has(Column::animation_error)) drop_simulation_starts(header);
    return header;
}

// Tables of one column that is read.
const Format column_format{"a column of times", Rows::times, {}, {}};

// A column's name without what tools write differently: "Frame time (ms)", "frame_time_ms" and "FrameTimeMs" are
// "frametime" in ms.
struct PlainName {
    std::string base;
    std::optional<Unit> unit;
};

// "gpu_ms", "GpuMs", "ms" and "frametimems", but not "GPUs".
bool ends_with_unit(std::string_view field, std::string_view base, std::string_view unit) {
    if (!base.ends_with(unit)) return false;
    const std::string_view rest = base.substr(0, base.size() - unit.size());
    if (rest.empty() || rest.ends_with("time") || rest.ends_with("duration")) return true;
    const char before = field[field.size() - unit.size() - 1], first = field[field.size() - unit.size()];
    const auto is_lower = [](char c) { return std::islower(c & 0xff) != 0; };
    return !std::isalpha(before & 0xff) || (is_lower(before) && !is_lower(first));
}

PlainName plain_name(std::string_view field) {
    PlainName name;
    const std::size_t bracket = field.find_first_of("([");
    if (bracket != std::string_view::npos && (field.back() == ')' || field.back() == ']')) {
        name.unit = unit_named(without_blanks(field.substr(bracket + 1, field.size() - bracket - 2)));
        if (name.unit) field = field.substr(0, bracket);
    }
    for (const char c : field) {
        if (c != ' ' && c != '_' && c != '-' && c != '.') name.base += static_cast<char>(std::tolower(c & 0xff));
    }
    for (const std::string_view unit : {"ms", "us", "ns"}) {
        if (!name.unit && ends_with_unit(field, name.base, unit)) {
            name.unit = unit_named(unit);
            name.base.resize(name.base.size() - unit.size());
        }
    }
    return name;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_frame_time(const PlainName& name) {
    if (name.unit == Unit::fps) return false;
    return is_one_of(name.base,
                     {"frametime", "frametimes", "frameduration", "framedelta", "timeperframe", "deltatime"});
}

// Names that say so little are a frame's time only beside its number.
bool is_time(const PlainName& name) {
    if (name.unit == Unit::fps) return false;
    return is_one_of(name.base, {"time", "times", "timestamp", "duration", "delta", "dt"}) ||
           (name.unit && is_one_of(name.base, {"", "frame", "cpu"}));
}

bool is_counter(std::string_view field) {
    return is_one_of(plain_name(field).base, {"", "#", "frame", "frames", "frameindex", "framenumber", "frameno",
                                              "frameid", "index", "number", "n", "no", "nr", "id", "i"});
}

Header of_column(std::size_t position, ColumnMeaning meaning, char separator, const std::vector<std::string>& fields,
                 const LineReader& place) {
    Header header = place_columns(column_format, separator, fields, place);
    for (std::optional<std::size_t>& other : header.position) {
        if (other == position) other.reset();
    }
    header.position[static_cast<std::size_t>(Column::frame_time)] = position;
    header.names[static_cast<std::size_t>(Column::frame_time)] = fields[position];
    header.meaning = meaning;
    return header;
}

std::optional<Header> find_time_column(char separator, const std::vector<std::string>& fields, const ColumnWish& wish,
                                       const LineReader& place) {
    using Sense = ColumnMeaning::Sense;
    const auto told = [&](std::size_t i) { return wish.unit ? wish.unit : plain_name(fields[i]).unit; };
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (is_frame_time(plain_name(fields[i])))
            return of_column(i, {told(i), Sense::frames}, separator, fields, place);
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (!is_time(plain_name(fields[i]))) continue;
        const auto others = std::count_if(fields.begin(), fields.end(), is_counter);
        const bool is_itself_one = is_counter(fields[i]);
        if (others - is_itself_one == std::ssize(fields) - 1)
            return of_column(i, {told(i), Sense::to_be_found}, separator, fields, place);
    }
    return std::nullopt;
}

// By the name that is asked for, or by its number in a table without names.
std::optional<Header> find_wished(std::string_view line, const ColumnWish& wish, const LineReader& place) {
    for (const char separator : {',', ';', '\t'}) {
        const std::vector<std::string> fields = split_fields(line, separator);
        const bool is_row = std::all_of(fields.begin(), fields.end(),
                                        [](const std::string& field) { return parse_double(field).has_value(); });
        const std::optional<std::int64_t> number = parse_integer(wish.column);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const bool is_it = is_row ? number == static_cast<std::int64_t>(i + 1) : same_name(fields[i], wish.column);
            if (!is_it) continue;
            const std::optional<Unit> unit = is_row ? std::nullopt : plain_name(fields[i]).unit;
            const std::optional<Unit> whole = is_row ? std::nullopt : unit_named(fields[i]);
            Header header = of_column(i, {wish.unit ? wish.unit : unit ? unit : whole, {}}, separator, fields, place);
            header.meaning.sense = ColumnMeaning::Sense::to_be_found;
            header.is_a_row = is_row;
            return header;
        }
    }
    return std::nullopt;
}

// A line that is one number.
std::optional<Header> find_number(std::string_view line, const ColumnWish& wish) {
    if (line.empty() || !told_number(line)) return std::nullopt;
    Header header{&column_format, '\t', 1, {wish.unit, ColumnMeaning::Sense::to_be_found}, true, {}, {}};
    header.position[static_cast<std::size_t>(Column::frame_time)] = 0;
    header.names[static_cast<std::size_t>(Column::frame_time)] = "the time";
    return header;
}

bool is_no_number(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    return text.starts_with("1.#") || text.starts_with("1,#") || same_name(text.substr(0, 4), "nan(");
}

}  // namespace

std::optional<Header> find_header(std::string_view line, bool after_preamble, const ColumnWish& wish,
                                  const LineReader& place) {
    if (!wish.column.empty()) return find_wished(line, wish, place);
    for (const char separator : {',', ';', '\t'}) {
        const std::vector<std::string> fields = split_fields(line, separator);
        for (const Format& format : formats()) {
            if (fits(format, fields, after_preamble)) return place_columns(format, separator, fields, place);
        }
    }
    for (const char separator : {',', ';', '\t'}) {
        const std::vector<std::string> fields = split_fields(line, separator);
        if (std::optional<Header> header = find_time_column(separator, fields, wish, place)) return header;
    }
    return find_number(without_blanks(line), wish);
}

std::string number_columns(std::string_view line, std::string_view next) {
    constexpr std::size_t longest = 60;
    for (const char separator : {',', ';', '\t'}) {
        const std::vector<std::string> names = split_fields(line, separator), values = split_fields(next, separator);
        std::string list;
        for (std::size_t i = 0; i < names.size() && names.size() > 1 && names.size() == values.size(); ++i) {
            if (names[i].empty() || values[i].empty() || !told_number(values[i])) continue;
            if (list.size() > longest) return list + " ...";
            list += (list.empty() ? "" : ", ") + shown(told_number(names[i]) ? std::to_string(i + 1) : names[i]);
        }
        if (!list.empty()) return list;
    }
    return {};
}

bool is_not_available(std::string_view text) {
    return same_name(text, "NA") || same_name(text, "N/A") || same_name(text, "null") || is_no_number(text);
}

std::optional<double> told_number(std::string_view text) {
    if (const std::optional<double> value = parse_double(text)) return value;
    if (text.empty() || is_not_available(text)) return std::numeric_limits<double>::quiet_NaN();
    if (text.starts_with('+')) return parse_double(text.substr(1));
    if (std::count(text.begin(), text.end(), ',') != 1) return std::nullopt;
    std::string with_point(text);
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    return parse_double(with_point);
}

std::string readable_formats() {
    return "one of our own traces, PresentMon, CapFrameX, MangoHud ... or a column of times";
}

}  // namespace sfsm
