#include "sfsm/trace.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sfsm/line_reader.h"
#include "sfsm/number_text.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

enum Column {
    frame,
    target_ms,
    frame_ms,
    cpu_ms,
    gpu_ms,
    state,
    distance,
    splat,
    people,
    triangles,
    points,
    updates,
    range
};
constexpr std::array<std::string_view, 13> column_names = {
    "frame",    "target_ms", "frame_ms",  "cpu_ms", "gpu_ms",         "state",   "motion_distance_m",
    "splat_px", "visible",   "triangles", "points", "motion_updates", "range_m",
};
constexpr std::string_view header_line =
    "frame,target_ms,frame_ms,cpu_ms,gpu_ms,state,motion_distance_m,splat_px,visible,triangles,points,motion_updates,"
    "range_m";
constexpr std::string_view predicted_name = "predicted_ms", motion_name = "motion_steps", splat_name = "splat_steps";

// A setting is one line: what would break it becomes a blank.
std::string one_line(std::string_view text) {
    std::string line(text);
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return line;
}

void read_setting(std::string_view line, std::map<std::string, std::string>& settings) {
    line.remove_prefix(1);
    if (line.starts_with(' ')) line.remove_prefix(1);
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos) settings[std::string(line.substr(0, equals))] = line.substr(equals + 1);
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
    fields.clear();
    for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1)) {
        fields.push_back(line.substr(0, comma));
    }
    fields.push_back(line);
}

// Where each of our columns stands in this file.
struct Header {
    std::array<std::size_t, column_names.size()> position{};
    std::optional<std::size_t> predicted, motion, splats;
    std::size_t fields = 0;
};

Header parse_header(std::string_view line, const LineReader& place) {
    std::vector<std::string_view> found;
    split(line, found);
    Header header;
    header.fields = found.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] == predicted_name) header.predicted = i;
        if (found[i] == motion_name) header.motion = i;
        if (found[i] == splat_name) header.splats = i;
    }
    for (std::size_t column = 0; column < column_names.size(); ++column) {
        std::size_t times = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (found[i] != column_names[column]) continue;
            header.position[column] = i;
            ++times;
        }
        if (times == 1) continue;
        place.fail("found " + std::to_string(times) + " columns '" + std::string(column_names[column]) +
                   "', expected one each of " + std::string(header_line));
    }
    return header;
}

// The fields of one line, by column.
struct Fields {
    const Header& header;
    const std::vector<std::string_view>& fields;
    const LineReader& place;

    std::string_view text(Column column) const { return fields[header.position[column]]; }

    [[noreturn]] void fail(Column column, const char* expected) const {
        place.fail(std::string(column_names[column]) + " is " + shown(text(column)) + ", expected " + expected);
    }

    double number(Column column) const {
        if (const std::optional<double> value = parse_double(text(column))) return *value;
        fail(column, "a number");
    }

    double time(Column column) const {
        return text(column).empty() ? std::numeric_limits<double>::quiet_NaN() : number(column);
    }

    double prediction() const {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        if (!header.predicted || fields[*header.predicted].empty()) return unknown;
        if (const std::optional<double> value = parse_double(fields[*header.predicted])) return *value;
        place.fail(std::string(predicted_name) + " is " + shown(fields[*header.predicted]) + ", expected a number");
    }

    std::int64_t count(Column column) const {
        const std::optional<std::int64_t> value = parse_integer(text(column));
        if (!value || *value < 0) fail(column, "a whole number from 0");
        return *value;
    }

    // Steps of `numbers` numbers each, one after the other: most of a trace's bytes are these. `add` takes them.
    template <std::size_t numbers, typename Step, typename Add>
    void steps(std::optional<std::size_t> position, std::string_view name, std::vector<Step>& into, Add add) const {
        if (!position || fields[*position].empty()) return;
        const std::string_view field = fields[*position];
        into.reserve(1 + static_cast<std::size_t>(std::count(field.begin(), field.end(), ' ')));
        const char* const end = field.data() + field.size();
        for (const char* at = field.data();; ++at) {
            const char* const begin = at;
            std::array<double, numbers> values{};
            if (!parse_step(at, end, values)) {
                const std::string_view step(begin, static_cast<std::size_t>(std::find(begin, end, ' ') - begin));
                place.fail(std::string(name) + " has " + shown(step) + ", expected " + std::to_string(numbers) +
                           " numbers from 0, parted by colons");
            }
            add(values);
            if (at == end) return;
        }
    }

    // Moves `at` to the blank behind the step, or to the end.
    template <std::size_t numbers>
    static bool parse_step(const char*& at, const char* end, std::array<double, numbers>& values) {
        for (std::size_t i = 0; i < numbers; ++i) {
            if (i > 0 && (at == end || *at++ != ':')) return false;
            const std::from_chars_result result = std::from_chars(at, end, values[i]);
            if (result.ec != std::errc() || !(values[i] >= 0)) return false;
            at = result.ptr;
        }
        return at == end || *at == ' ';
    }

    Decision decision() const {
        const std::string_view s = text(Column::state);
        if (s != "0" && s != "1" && s != "2") fail(Column::state, "0, 1 or 2");
        Decision decision{static_cast<State>(s[0] - '0'), number(distance), number(splat)};
        if (!(decision.motion_distance > 0)) fail(distance, "metres over 0, or inf");
        if (!(decision.splat_size >= 0 && decision.splat_size <= max_splat_size)) fail(splat, "pixels in [0, 32]");
        return decision;
    }
};
static_assert(max_splat_size == 32, "the message above says so");

// Counts are whole numbers that a double holds.
std::int64_t whole(double count) {
    constexpr double most = 0x1p53;
    return static_cast<std::int64_t>(std::min(count, most));
}

void append_steps(std::string& line, const TraceRow& row) {
    const char* blank = "";
    for (const Step& step : row.motion) {
        append_number(line += blank, step.setting);
        append_number(line += ':', step.work[WorkKind::motion_update]);
        append_number(line += ':', step.loss_px);
        blank = " ";
    }
    line += ',';
    blank = "";
    for (const Step& step : row.shapes) {
        append_number(line += blank, step.setting);
        for (const WorkKind kind : work_on<WorkAxis::shape>) append_number(line += ':', step.work[kind]);
        append_number(line += ':', step.loss_px);
        blank = " ";
    }
}

TraceRow parse_row(const Fields& fields) {
    TraceRow row;
    row.frame = fields.count(frame);
    row.target_ms = fields.number(target_ms);
    row.frame_ms = fields.time(frame_ms);
    row.cpu_ms = fields.time(cpu_ms);
    row.gpu_ms = fields.time(gpu_ms);
    row.decision = fields.decision();
    row.work = {fields.count(people), fields.count(triangles), fields.count(points), fields.count(updates)};
    row.range = fields.number(range);
    row.predicted_ms = fields.prediction();
    fields.steps<3>(fields.header.motion, motion_name, row.motion, [&](const std::array<double, 3>& v) {
        row.motion.push_back({v[0], Work{0, 0, 0, whole(v[1])}, v[2]});
    });
    fields.steps<4>(fields.header.splats, splat_name, row.shapes, [&](const std::array<double, 4>& v) {
        row.shapes.push_back({v[0], Work{0, whole(v[1]), whole(v[2])}, v[3]});
    });
    return row;
}

}  // namespace

void write_trace_header(std::ostream& out, const std::map<std::string, std::string>& settings) {
    for (const auto& [key, value] : settings) out << "# " << one_line(key) << '=' << one_line(value) << '\n';
    out << header_line << ',' << predicted_name << ',' << motion_name << ',' << splat_name << '\n';
}

void write_trace_row(std::ostream& out, const TraceRow& row) {
    std::string line;
    append_number(line, row.frame);
    for (const double ms : {row.target_ms, row.frame_ms, row.cpu_ms, row.gpu_ms}) append_number(line += ',', ms);
    append_number(line += ',', std::int64_t{static_cast<int>(row.decision.state)});
    append_number(line += ',', row.decision.motion_distance);
    append_number(line += ',', row.decision.splat_size);
    for (const std::int64_t count : row.work.counts) {
        append_number(line += ',', count);
    }
    append_number(line += ',', row.range);
    append_number(line += ',', row.predicted_ms);
    append_steps(line += ',', row);
    out << (line += '\n');
}

Trace read_trace(std::istream& in, const std::string& name) {
    LineReader lines(in, name);
    return read_trace(lines);
}

Trace read_trace(LineReader& lines) {
    Trace trace;
    trace.name = lines.name();
    std::string_view line;
    bool is_there = lines.next(line);
    for (; is_there && line.starts_with('#'); is_there = lines.next(line)) read_setting(line, trace.settings);
    if (!is_there) {
        throw std::runtime_error(lines.name() + ": found no header line, expected " + std::string(header_line));
    }
    const Header header = parse_header(line, lines);

    std::vector<std::string_view> fields;
    while (lines.next(line)) {
        trace.is_cut = !lines.has_line_end();
        if (trace.is_cut) break;
        split(line, fields);
        if (fields.size() != header.fields) {
            lines.fail("found " + std::to_string(fields.size()) + " fields, expected " + std::to_string(header.fields));
        }
        TraceRow row = parse_row({header, fields, lines});
        if (!trace.rows.empty() && row.frame <= trace.rows.back().frame) {
            lines.fail("found frame " + std::to_string(row.frame) + ", expected one after " +
                       std::to_string(trace.rows.back().frame));
        }
        trace.rows.push_back(std::move(row));
    }
    return trace;
}

}  // namespace sfsm
