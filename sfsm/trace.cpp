#include "sfsm/trace.h"

#include <algorithm>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sfsm/line_reader.h"
#include "sfsm/same_bits.h"
#include "sfsm/trace_columns.h"

namespace sfsm {
namespace {

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

// A column of a file that is one of ours.
struct Placed {
    const TraceColumn* column;
    std::size_t position;
};

struct Header {
    std::vector<Placed> columns;  // in the order of our table
    std::size_t fields = 0;
};

Header parse_header(std::string_view line, const LineReader& place) {
    std::vector<std::string_view> found;
    split(line, found);
    Header header{{}, found.size()};
    for (const TraceColumn& column : trace_columns()) {
        const auto times = std::count(found.begin(), found.end(), column.name);
        if (column.is_required && times != 1) {
            place.fail("found " + std::to_string(times) + " columns '" + std::string(column.name) +
                       "', expected one each of " + required_column_names());
        }
        const auto last = std::find(found.rbegin(), found.rend(), column.name);
        if (times > 0) header.columns.push_back({&column, static_cast<std::size_t>(found.rend() - last) - 1});
    }
    return header;
}

void parse_row(const Header& header, std::span<const std::string_view> fields, const LineReader& place, TraceRow& row) {
    for (const auto& [column, position] : header.columns) {
        const std::string wrong = column->read(row, fields[position]);
        if (!wrong.empty()) place.fail(std::string(column->name) + ' ' + wrong);
    }
}

}  // namespace

void write_trace_header(std::ostream& out, const std::map<std::string, std::string>& settings) {
    for (const auto& [key, value] : settings) out << "# " << one_line(key) << '=' << one_line(value) << '\n';
    out << all_column_names() << '\n';
}

void write_trace_row(std::ostream& out, const TraceRow& row) {
    std::string line;
    for (const TraceColumn& column : trace_columns()) {
        if (!line.empty()) line += ',';
        column.write(line, row);
    }
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
        throw std::runtime_error(lines.name() + ": found no header line, expected " + required_column_names());
    }
    const Header header = parse_header(line, lines);

    std::vector<std::string_view> fields;
    std::int64_t before = -1;  // the last row's frame
    while (lines.next(line)) {
        trace.is_cut = !lines.has_line_end();
        if (trace.is_cut) break;
        split(line, fields);
        if (fields.size() != header.fields) {
            lines.fail("found " + std::to_string(fields.size()) + " fields, expected " + std::to_string(header.fields));
        }
        TraceRow& row = trace.rows.emplace_back();
        parse_row(header, fields, lines, row);
        if (row.frame <= before) {
            lines.fail("found frame " + std::to_string(row.frame) + ", expected one after " + std::to_string(before));
        }
        before = row.frame;
    }
    return trace;
}

}  // namespace sfsm
