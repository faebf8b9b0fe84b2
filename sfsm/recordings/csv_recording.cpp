#include "sfsm/recordings/csv_recording.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "sfsm/line_reader.h"
#include "sfsm/number_text.h"
#include "sfsm/recordings/formats.h"
#include "sfsm/recordings/mangohud.h"
#include "sfsm/recordings/row_splitter.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

constexpr std::size_t longest_preamble = 200;        // lines
constexpr std::size_t longest_preamble_line = 4096;  // what is kept of it [bytes]

bool is_not_available(std::string_view text) {
    return same_name(text, "NA") || same_name(text, "N/A") || same_name(text, "-nan(ind)");
}

// NaN: not available; nothing: no number. A decimal comma is as good as a point.
std::optional<double> told_number(std::string_view text) {
    if (const std::optional<double> value = parse_double(text)) return value;
    if (is_not_available(text)) return std::numeric_limits<double>::quiet_NaN();
    if (std::count(text.begin(), text.end(), ',') != 1) return std::nullopt;
    std::string with_point(text);
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    return parse_double(with_point);
}

bool is_comment(std::string_view line) {
    return line.starts_with('#') || line.starts_with("//");
}

// Lines that MangoHud writes before its header.
bool begins_mangohud(std::string_view line) {
    return line.starts_with("os,") || line == "v1" || line.starts_with("-----");
}

class CsvReader {
public:
    explicit CsvReader(LineReader& lines) : lines_(lines) {}

    Collected read();

private:
    void seek_header(std::string_view line);
    void keep_preamble(std::string_view line);
    void begin_table(const Header& header, std::string_view line);
    void read_preamble();
    void take_line(std::string_view line);
    bool begins_again(std::string_view line);
    void take_row();
    void take_present(double told_ms);
    void take_sample(double told_ms);
    void take_clock(double clock_ms);
    void append_notes();

    double number(Column column) const;
    double optional_number(Column column) const;
    bool is_unshown() const;
    std::size_t present() const;
    [[noreturn]] void fail_field(Column column, const char* expected) const;
    [[noreturn]] void fail_without_header() const;

    LineReader& lines_;
    std::vector<std::string> preamble_;  // lines before the header
    std::int64_t suspect_ = 0;           // number of the first of them that is no comment, else of the first
    std::string suspect_text_;
    std::optional<Header> header_;
    std::optional<RowSplitter> row_;
    bool is_seeking_ = true;
    std::int64_t rows_ = 0;
    std::optional<double> clock_ms_;  // of the row before, of Rows::clock
    Tally repeated_headers_;

    StreamTable table_;
    Collected collected_;
};

Collected CsvReader::read() {
    std::string_view line;
    while (lines_.next(line)) {
        if (without_blanks(line).empty()) continue;
        if (is_seeking_) {
            seek_header(line);
        } else {
            take_line(line);
        }
    }
    if (is_seeking_) fail_without_header();
    if (rows_ == 0) {
        lines_.fail("found no row behind the header of " + collected_.format + ", expected at least one");
    }
    append_notes();
    collected_.streams = std::move(table_.streams());
    return std::move(collected_);
}

void CsvReader::seek_header(std::string_view line) {
    const bool has_preamble = !preamble_.empty() && preamble_.front().starts_with("//");
    if (const std::optional<Header> header = find_header(line, has_preamble, lines_)) {
        begin_table(*header, line);
        return;
    }
    keep_preamble(line);
    if (preamble_.size() > longest_preamble) fail_without_header();
}

void CsvReader::keep_preamble(std::string_view line) {
    preamble_.emplace_back(line.substr(0, longest_preamble_line));
    if (preamble_.size() > 1 && (is_comment(line) || !is_comment(suspect_text_))) return;
    suspect_ = lines_.number();
    suspect_text_ = preamble_.back();
}

void CsvReader::begin_table(const Header& header, std::string_view line) {
    if (header_ && header_->format != header.format) {
        lines_.fail("found the header of " + std::string(header.format->name) + ' ' + shown(line) +
                    ", expected rows of " + collected_.format);
    }
    if (header_) {
        repeated_headers_.add(lines_.number());
    } else {
        collected_.format = header.format->name;
        read_preamble();
    }
    header_ = header;
    row_.emplace(*header_);
    clock_ms_.reset();
    preamble_.clear();
    is_seeking_ = false;
}

// "//Key=Value", or MangoHud's two lines of keys and values.
void CsvReader::read_preamble() {
    for (std::size_t i = 0; i < preamble_.size(); ++i) {
        const std::string_view line = preamble_[i];
        const std::size_t equals = line.find('=');
        if (line.starts_with("//") && equals != std::string_view::npos) {
            collected_.settings[std::string(without_blanks(line.substr(2, equals - 2)))] =
                without_blanks(line.substr(equals + 1));
        }
        if (!line.starts_with("os,") || i + 1 == preamble_.size()) continue;
        const std::vector<std::string> keys = split_fields(line, ','), values = split_fields(preamble_[i + 1], ',');
        for (std::size_t k = 0; keys.size() == values.size() && k < keys.size(); ++k) {
            collected_.settings[keys[k]] = values[k];
        }
    }
}

void CsvReader::take_line(std::string_view line) {
    const RowSplitter::Result result = row_->split(line);
    const bool is_row = result == RowSplitter::Result::good && told_number(row_->text(Column::frame_time));
    if (!is_row && begins_again(line)) return;
    const bool is_cut = !lines_.has_line_end() && (result == RowSplitter::Result::too_short || !row_->is_closed());
    if (is_cut) return collected_.notes.push_back(cut_line_note(lines_));
    if (result == RowSplitter::Result::too_short) {
        lines_.fail("found " + std::to_string(row_->fields()) + " fields, expected " + std::to_string(row_->needed()) +
                    " or more");
    }
    if (result == RowSplitter::Result::too_long) {
        lines_.fail("found " + std::to_string(row_->fields()) + " fields, expected " + std::to_string(header_->fields) +
                    " at most: is a decimal comma taken for a separator?");
    }
    take_row();
}

// What files put together have between their rows: a header, with what may stand before it.
bool CsvReader::begins_again(std::string_view line) {
    if (line.starts_with("//") && header_->format->has_preamble) return true;
    is_seeking_ = header_->format->rows == Rows::samples && begins_mangohud(line);
    if (is_seeking_) {
        keep_preamble(line);
        return true;
    }
    const std::optional<Header> header = find_header(line, header_->format->has_preamble, lines_);
    if (header) begin_table(*header, line);
    return header.has_value();
}

void CsvReader::take_row() {
    ++rows_;
    const double told = number(Column::frame_time);
    switch (header_->format->rows) {
        case Rows::presents:
            return take_present(told);
        case Rows::samples:
            return take_sample(told);
        case Rows::clock:
            return take_clock(told);
    }
}

void CsvReader::take_present(double told_ms) {
    StreamFrames& stream =
        table_.find(row_->text(Column::process), row_->text(Column::process_id), row_->text(Column::swap_chain));
    const std::string_view type = row_->text(Column::frame_type);
    if (!type.empty() && !is_not_available(type) && !same_name(type, "Application")) {
        if (stream.generated.rows.count == 0) stream.generated.type = shown(type);
        stream.generated.rows.add(lines_.number());
        add_generated(stream, told_ms, present());
        return;
    }
    const FrameTimes told{told_ms, optional_number(Column::cpu), optional_number(Column::gpu)};
    if (is_unshown()) stream.unshown.add(lines_.number());
    add_frame(stream, usable_times(told, stream, lines_.number()), present());
}

void CsvReader::take_sample(double told_ms) {
    StreamFrames& stream = table_.find("", "", "");
    stream.frames.push_back(usable_times({in_milliseconds(told_ms, number(Column::fps))}, stream, lines_.number()));
    if (header_->has(Column::elapsed)) stream.elapsed.push_back(number(Column::elapsed));
}

void CsvReader::take_clock(double clock_ms) {
    StreamFrames& stream = table_.find("", "", "");
    if (clock_ms_) add_frame(stream, usable_times({clock_ms - *clock_ms_}, stream, lines_.number()), 0);
    clock_ms_ = clock_ms;
}

void CsvReader::append_notes() {
    if (repeated_headers_.count == 0) return;
    collected_.notes.push_back(
        "header found again in line " + std::to_string(repeated_headers_.first) +
        (repeated_headers_.count == 1 ? "" : " and " + std::to_string(repeated_headers_.count - 1) + " more") +
        ": recordings put together");
}

double CsvReader::number(Column column) const {
    if (const std::optional<double> value = told_number(row_->text(column))) return *value;
    fail_field(column, "a number or NA");
}

// NaN where there is no such column or an empty field.
double CsvReader::optional_number(Column column) const {
    return row_->text(column).empty() ? std::numeric_limits<double>::quiet_NaN() : number(column);
}

bool CsvReader::is_unshown() const {
    const std::string_view dropped = row_->text(Column::dropped);
    if (dropped == "0" || dropped == "1") return dropped == "1";
    if (header_->has(Column::dropped)) {
        if (same_name(dropped, "true") || same_name(dropped, "false")) return same_name(dropped, "true");
        if (dropped.empty() || is_not_available(dropped)) return false;
        fail_field(Column::dropped, "0 or 1");
    }
    const std::string_view displayed = row_->text(Column::displayed);
    return !displayed.empty() && (is_not_available(displayed) || number(Column::displayed) == 0);
}

std::size_t CsvReader::present() const {
    const std::string_view text = row_->text(Column::present_time);
    return text.empty() || is_not_available(text) ? 0 : std::hash<std::string_view>()(text) | 1;
}

void CsvReader::fail_field(Column column, const char* expected) const {
    lines_.fail(header_->name(column) + " is " + shown(row_->text(column)) + ", expected " + expected);
}

void CsvReader::fail_without_header() const {
    const std::string expected = ", expected " + readable_formats();
    if (preamble_.empty()) lines_.fail_at(1, "found an empty file" + expected);
    lines_.fail_at(suspect_, "found no header but " + shown(suspect_text_) + expected);
}

}  // namespace

std::string cut_line_note(const LineReader& lines) {
    return "line " + std::to_string(lines.number()) + ", the last, is cut short: left out";
}

Collected read_csv_recording(LineReader& lines) {
    return CsvReader(lines).read();
}

}  // namespace sfsm
