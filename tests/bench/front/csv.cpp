#include "tests/bench/front/csv.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "sfsm/number_text.h"
#include "sfsm/text.h"
#include "sfsm/work.h"

namespace bench::front {

namespace {

// Without a sign where nothing but zeros is left.
std::string rounded(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    std::string out = text;
    if (out.front() == '-' && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
    return out;
}

std::string six_figures(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

// In quotes where it must be, each quote within them twice.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + '"';
}

bool read_number(std::string_view text, double& value) {
    const auto number = sfsm::parse_double(text);
    if (!number || std::isnan(*number)) return false;
    value = *number;
    return true;
}

bool read_whole(std::string_view text, std::int64_t& value) {
    const auto number = sfsm::parse_integer(text);
    if (!number || *number < 0) return false;
    value = *number;
    return true;
}

constexpr std::string_view a_text = "a text", a_number = "a number", a_whole_number = "a whole number from 0";

// `member` is a pointer to a member of Row, or to a function that gets a reference to one of a row's values.
template <auto member>
Column text_column(const char* name) {
    return {name,
            Kind::name,
            [](const Row& row, std::size_t) { return row.*member; },
            [](Row& row, std::size_t, std::string_view text) {
                row.*member = text;
                return true;
            },
            0,
            a_text};
}

template <auto member>
Column exact_column(const char* name) {
    return {name,
            Kind::name,
            [](const Row& row, std::size_t) { return sfsm::number_text(row.*member); },
            [](Row& row, std::size_t, std::string_view text) { return read_number(text, row.*member); },
            0,
            a_number};
}

template <Kind kind, int decimals, auto at>
Column rounded_column(std::string name) {
    return {std::move(name),
            kind,
            [](const Row& row, std::size_t) { return rounded(at(const_cast<Row&>(row)), decimals); },
            [](Row& row, std::size_t, std::string_view text) { return read_number(text, at(row)); },
            0,
            a_number};
}

// Nothing is known of it in older files.
Column younger(Column column) {
    column.is_younger = true;
    return column;
}

template <auto at>
Column error_column(std::string name) {
    return rounded_column<Kind::error, 5, at>(std::move(name));
}

template <auto member>
Column time_column(const char* name) {
    return rounded_column<Kind::time, 3, [](Row& row) -> double& { return row.*member; }>(name);
}

void add_names(std::vector<Column>& all) {
    all.push_back({"people", Kind::name, [](const Row& row, std::size_t) { return std::to_string(row.people); },
                   [](Row& row, std::size_t, std::string_view text) { return read_whole(text, row.people); }, 0,
                   a_whole_number});
    all.push_back(text_column<&Row::view>("view"));
    all.push_back({"is_preset", Kind::name,
                   [](const Row& row, std::size_t) { return std::string(row.is_preset ? "1" : "0"); },
                   [](Row& row, std::size_t, std::string_view text) {
                       row.is_preset = text == "1";
                       return text == "0" || text == "1";
                   },
                   0, "0 or 1"});
    all.push_back(text_column<&Row::family>("family"));
    all.push_back(text_column<&Row::setting>("setting"));
    all.push_back(text_column<&Row::law>("law"));
    all.push_back(exact_column<&Row::target_ms>("target_ms"));
    all.push_back(rounded_column<Kind::name, 3, [](Row& row) -> double& { return row.density; }>("density"));
    all.push_back({"samples", Kind::name, [](const Row& row, std::size_t) { return std::to_string(row.samples); },
                   [](Row& row, std::size_t, std::string_view text) {
                       std::int64_t samples = 0;
                       const bool is_whole = read_whole(text, samples) && samples < 1000;
                       row.samples = static_cast<int>(samples);
                       return is_whole;
                   },
                   0, "a whole number from 0 to 999"});
}

void add_decision(std::vector<Column>& all) {
    all.push_back({"state", Kind::name,
                   [](const Row& row, std::size_t) { return std::to_string(static_cast<int>(row.decision.state)); },
                   [](Row& row, std::size_t, std::string_view text) {
                       std::int64_t state = 0;
                       const bool is_state = read_whole(text, state) && state <= 2;
                       row.decision.state = static_cast<sfsm::State>(state);
                       return is_state;
                   },
                   0, "0, 1 or 2"});
    all.push_back(
        rounded_column<Kind::name, 3, [](Row& row) -> double& { return row.decision.motion_distance; }>("D_m"));
    all.push_back(rounded_column<Kind::name, 3, [](Row& row) -> double& { return row.decision.splat_size; }>("S_px"));
    all.push_back(
        younger({"rate", Kind::name, [](const Row& row, std::size_t) { return six_figures(row.decision.rate); },
                 [](Row& row, std::size_t, std::string_view text) {
                     return read_number(text, row.decision.rate) && row.decision.rate >= 0;
                 },
                 0, "a number from 0"}));
    for (const sfsm::WorkEntry& entry : sfsm::work_table)
        all.push_back(
            {std::string(entry.column), Kind::count,
             [](const Row& row, std::size_t kind) { return std::to_string(row.work.counts[kind]); },
             [](Row& row, std::size_t kind, std::string_view text) { return read_whole(text, row.work.counts[kind]); },
             sfsm::index_of(entry.kind), a_whole_number});
}

template <auto errors>
void add_errors(std::vector<Column>& all, const std::string& of) {
    all.push_back(error_column<[](Row& row) -> double& { return (row.*errors).flip; }>(of + "flip"));
    all.push_back(error_column<[](Row& row) -> double& { return (row.*errors).psnr; }>(of + "psnr"));
    all.push_back(error_column<[](Row& row) -> double& { return (row.*errors).ssim; }>(of + "ssim"));
    all.push_back(error_column<[](Row& row) -> double& { return (row.*errors).brightness; }>(of + "brightness"));
    all.push_back(error_column<[](Row& row) -> double& { return (row.*errors).red; }>(of + "red"));
    all.push_back(error_column<[](Row& row) -> double& { return (row.*errors).green; }>(of + "green"));
    all.push_back(error_column<[](Row& row) -> double& { return (row.*errors).blue; }>(of + "blue"));
}

template <auto member>
void add_error(std::vector<Column>& all, const char* name) {
    all.push_back(error_column<[](Row& row) -> double& { return row.*member; }>(name));
}

std::vector<Column> make_columns() {
    std::vector<Column> all;
    add_names(all);
    add_decision(all);
    add_errors<&Row::frame>(all, "");
    add_error<&Row::crowd_share>(all, "crowd_share");
    add_errors<&Row::crowd>(all, "crowd_");
    add_error<&Row::change>(all, "change");
    add_error<&Row::motion_px>(all, "motion_px");
    add_error<&Row::motion_worst_px>(all, "motion_worst_px");
    add_error<&Row::outline_px>(all, "outline_px");
    add_error<&Row::outline_worst_px>(all, "outline_worst_px");
    add_error<&Row::covering_px>(all, "covering_px");
    const std::size_t younger_from = all.size();
    add_error<&Row::expected_flip>(all, "expected_flip");
    add_error<&Row::max_motion_px>(all, "max_motion_px");
    add_error<&Row::max_splat_px>(all, "max_splat_px");
    for (std::size_t i = younger_from; i < all.size(); ++i) all[i].is_younger = true;
    all.push_back(time_column<&Row::wall_ms>("wall_ms"));
    all.push_back(time_column<&Row::wall_low_ms>("wall_low_ms"));
    all.push_back(time_column<&Row::wall_high_ms>("wall_high_ms"));
    all.push_back(time_column<&Row::process_ms>("process_ms"));
    return all;
}

struct MachineLine {
    std::string_view name;
    std::string (*write)(const Machine& machine);
    bool (*read)(Machine& machine, std::string_view text);
};

template <std::string Machine::*member>
constexpr MachineLine text_line(std::string_view name) {
    return {name, [](const Machine& machine) { return machine.*member; },
            [](Machine& machine, std::string_view text) {
                machine.*member = text;
                return true;
            }};
}

constexpr MachineLine machine_table[] = {
    text_line<&Machine::processor>("processor"),
    {"threads", [](const Machine& machine) { return std::to_string(machine.threads); },
     [](Machine& machine, std::string_view text) {
         std::int64_t threads = 0;
         const bool is_whole = read_whole(text, threads) && threads < 100'000;
         machine.threads = static_cast<int>(threads);
         return is_whole;
     }},
    text_line<&Machine::opengl>("opengl"),
    text_line<&Machine::date>("date"),
};

// Takes lines from a text, and says where it is when something is wrong.
class Lines {
public:
    Lines(std::string_view text, const std::string& name, std::int64_t lines_before)
        : rest_(text), name_(name), number_(lines_before) {}

    bool at_end() const { return rest_.empty(); }
    std::string_view next(const std::string& expected) {
        ++number_;
        const std::size_t end = rest_.find('\n');
        if (end == std::string_view::npos)
            fail(rest_.empty() ? "found the end of the file, expected " + expected
                               : "found a line without its end, expected " + expected);
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return line;
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error(name_ + ":" + std::to_string(number_) + ": " + what);
    }

private:
    std::string_view rest_;
    const std::string& name_;
    std::int64_t number_;  // of the line that was read last
};

void read_machine(Lines& lines, Machine& machine) {
    for (const MachineLine& one : machine_table) {
        const std::string start = "# " + std::string(one.name) + ": ";
        std::string_view line = lines.next("'" + start + "...'");
        if (!line.starts_with(start)) lines.fail("found " + sfsm::shown(line) + ", expected '" + start + "...'");
        line.remove_prefix(start.size());
        if (!one.read(machine, line))
            lines.fail(std::string(one.name) + ": found " + sfsm::shown(line) + ", expected a whole number");
    }
}

std::vector<std::string> fields_of(std::string_view line, const Lines& lines) {
    std::vector<std::string> fields(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (is_quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            is_quoted = !is_quoted;
        else if (c == ',' && !is_quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    if (is_quoted) lines.fail("found a quote that isn't closed, expected one before the line's end");
    return fields;
}

// Those that a file has: all of them in their order, but for younger ones.
std::vector<const Column*> columns_of(std::string_view header, const Lines& lines) {
    const std::vector<std::string> names = fields_of(header, lines);
    std::vector<const Column*> found;
    for (const Column& column : columns()) {
        if (found.size() < names.size() && names[found.size()] == column.name)
            found.push_back(&column);
        else if (!column.is_younger)
            break;
    }
    const auto is_there = [&](const Column& column) {
        return column.is_younger || std::ranges::find(found, &column) != found.end();
    };
    if (found.size() != names.size() || !std::ranges::all_of(columns(), is_there))
        lines.fail("found other columns, expected '" + header_line() + "'");
    return found;
}

Row row_of(std::string_view line, std::span<const Column* const> of_file, const Lines& lines) {
    const std::vector<std::string> fields = fields_of(line, lines);
    if (fields.size() != of_file.size())
        lines.fail("found " + std::to_string(fields.size()) + " values, expected " + std::to_string(of_file.size()));
    Row row;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const Column& column = *of_file[i];
        if (!column.read(row, column.index, fields[i]))
            lines.fail(column.name + ": found " + sfsm::shown(fields[i]) + ", expected " +
                       std::string(column.expected));
    }
    return row;
}

}  // namespace

std::span<const Column> columns() {
    static const std::vector<Column> all = make_columns();
    return all;
}

std::string header_line() {
    std::string line;
    for (const Column& column : columns()) line += (line.empty() ? "" : ",") + column.name;
    return line;
}

std::string line_of(const Row& row) {
    std::string line;
    for (const Column& column : columns())
        line += (&column == columns().data() ? "" : ",") + quoted(column.text_of(row));
    return line;
}

std::string machine_lines(const Machine& machine) {
    std::string lines;
    for (const MachineLine& one : machine_table)
        lines += "# " + std::string(one.name) + ": " + one.write(machine) + '\n';
    return lines;
}

std::string to_csv(const Front& front) {
    std::string text = machine_lines(front.machine) + header_line() + '\n';
    for (const Row& row : front.rows) text += line_of(row) + '\n';
    return text;
}

Front from_csv(std::string_view text, const std::string& name, std::int64_t lines_before) {
    Front front;
    Lines lines(text, name, lines_before);
    read_machine(lines, front.machine);
    const std::vector<const Column*> of_file = columns_of(lines.next("the line of columns"), lines);
    while (!lines.at_end()) front.rows.push_back(row_of(lines.next("a row"), of_file, lines));
    return front;
}

}  // namespace bench::front
