#include "sfsm/recordings/csv_recording.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "sfsm/line_reader.h"
#include "sfsm/number_text.h"
#include "sfsm/recordings/facts.h"
#include "sfsm/recordings/formats.h"
#include "sfsm/recordings/mangohud.h"
#include "sfsm/recordings/row_splitter.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t heard_at_once = 4096;          // frames
constexpr std::size_t longest_preamble = 200;        // lines
constexpr std::size_t longest_preamble_line = 4096;  // what is kept of it [bytes]

// Who made a frame. Names that we don't know are no reason to think that nobody rendered it.
enum class Maker { application, generator, repetition, somebody };

Maker maker_of(std::string_view type) {
    if (type.empty() || same_name(type, "Application") || is_not_available(type)) return Maker::application;
    if (same_name(type, "Repeated")) return Maker::repetition;
    std::string lower(type);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* generator :
         {"xess", "xefg", "xell", "afmf", "fsr", "dlss", "smooth", "generated", "interpolated"}) {
        if (lower.find(generator) != std::string::npos) return Maker::generator;
    }
    return Maker::somebody;
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
    CsvReader(LineReader& lines, ColumnWish wish, const HearFrames& hear)
        : lines_(lines), wish_(std::move(wish)), hear_(hear) {}

    Collected read();

private:
    void seek_header(std::string_view line);
    void keep_preamble(std::string_view line);
    bool has_simulation_start() const;
    void begin_table(const Header& header, std::string_view line);
    void read_preamble();
    void read_first_line(const std::vector<std::string>& fields);
    void note_preamble(const Format& format);
    void seek_machine(std::string_view header);
    void take_machine(std::string_view line);
    void take_line(std::string_view line);
    bool is_aside(std::string_view line);
    bool begins_again(std::string_view line);
    std::string fault(RowSplitter::Result result) const;
    void leave_out(std::string fault);
    void take_row(double told);
    void take_present(double told_ms);
    bool is_no_frame(StreamFrames& stream, double told_ms);
    FrameRecord::Fate fate(StreamFrames& stream);
    DisplayRow display_row(StreamFrames& stream) const;
    void take_raw(double told);
    void finish_raw();
    void check_unreadable() const;
    void forget_untracked_displays();
    void finish_displays();
    void append_notes();

    double number(Column column) const;
    double part(Column column, StreamFrames& stream) const;
    double detail(Column column, StreamFrames& stream) const;
    std::size_t present() const;
    [[noreturn]] void fail_without_header() const;

    LineReader& lines_;
    ColumnWish wish_;
    const HearFrames& hear_;
    std::vector<std::string> preamble_;  // lines before the header
    std::int64_t suspect_ = 0;           // number of the first of them that is no comment, else of the first
    std::string suspect_text_;
    std::optional<Header> header_;
    std::optional<RowSplitter> row_;
    bool is_seeking_ = true;
    bool is_first_ = true;  // row behind a header
    std::int64_t rows_ = 0;
    Tally unreadable_, repeated_headers_, before_header_;
    std::string first_fault_, first_before_header_;
    std::vector<std::pair<std::size_t, std::string>> machine_;  // columns on it that are still to be found told
    bool has_display_times_ = false, has_simulation_start_ = false;

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
    check_unreadable();
    if (rows_ == 0) {
        lines_.fail("found no row behind the header of " + collected_.format + ", expected at least one");
    }
    finish_raw();
    forget_untracked_displays();
    finish_displays();
    append_notes();
    collected_.streams = std::move(table_.streams());
    return std::move(collected_);
}

void CsvReader::seek_header(std::string_view line) {
    const bool has_preamble = !preamble_.empty() && preamble_.front().starts_with("//");
    if (const std::optional<Header> header = find_header(line, has_preamble, wish_, lines_)) {
        begin_table(*header, line);
        return header->is_a_row ? take_line(line) : void();
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
        // Unreal writes its header once more at the end.
        if (header.format->lines != Format::Lines::unreal) repeated_headers_.add(lines_.number());
    } else {
        collected_.format = header.format->name;
        read_preamble();
        note_preamble(*header.format);
    }
    header_ = header;
    row_.emplace(*header_);
    has_simulation_start_ = has_simulation_start();
    seek_machine(line);
    for (StreamFrames& stream : table_.streams()) stream.display.begin_again();
    is_first_ = true;
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
        if (line.starts_with("01,")) collected_.settings["GPU"] = split_fields(line, ',').back();
        if (line.starts_with("00,")) read_first_line(split_fields(line, ','));
        if (i > 0 && preamble_[i - 1] == "v1") collected_.told["AppVersion"] = line;
        if (!line.starts_with("os,") || i + 1 == preamble_.size()) continue;
        const std::vector<std::string> keys = split_fields(line, ','), values = split_fields(preamble_[i + 1], ',');
        for (std::size_t k = 0; keys.size() == values.size() && k < keys.size(); ++k) {
            collected_.settings[keys[k]] = values[k];
        }
    }
}

// Afterburner's: when and by what.
void CsvReader::read_first_line(const std::vector<std::string>& fields) {
    if (fields.size() < 3) return;
    collected_.told["CreationDate"] = fields[1];
    collected_.told["AppVersion"] = fields.back();
}

// Columns on the machine, which stand in the first row or in each.
void CsvReader::seek_machine(std::string_view header) {
    machine_.clear();
    if (header_->format->rows != Rows::presents) return;
    const std::vector<std::string> fields = split_fields(header, header_->separator);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        for (const char* name : {"GPU", "CPU", "Processor", "OS", "System RAM", "Driver Package"}) {
            if (same_name(fields[i], name)) machine_.emplace_back(i, name);
        }
    }
}

void CsvReader::take_machine(std::string_view line) {
    constexpr std::int64_t most_rows = 100;
    const std::vector<std::string> fields = split_fields(line, header_->separator);
    std::erase_if(machine_, [&](const auto& column) {
        const auto& [position, name] = column;
        if (position >= fields.size() || told_number(fields[position])) return false;  // or it says nothing, or no name
        collected_.told[name] = fields[position];
        return true;
    });
    if (rows_ >= most_rows) machine_.clear();
}

// What a recorder said on the console, say.
void CsvReader::note_preamble(const Format& format) {
    const bool has_lines = format.rows == Rows::samples || format.lines == Format::Lines::afterburner;
    if (has_lines || preamble_.empty() || is_comment(suspect_text_)) return;
    const std::string said = presentable(suspect_text_);
    first_before_header_ = said.empty() ? "" : ", " + shown(said);
    before_header_.first = suspect_;
    before_header_.count =
        std::count_if(preamble_.begin(), preamble_.end(), [](const std::string& line) { return !is_comment(line); });
}

void CsvReader::take_line(std::string_view line) {
    using Result = RowSplitter::Result;
    if (header_->format->lines != Format::Lines::rows && is_aside(line)) return;
    Result result = row_->split(line);
    if (result == Result::too_long && header_->format->lines == Format::Lines::unreal) result = Result::good;
    std::optional<double> told;
    if (result == Result::good) told = told_number(row_->text(Column::frame_time));
    if (told) {
        if (!machine_.empty()) take_machine(line);
        if (lines_.has_line_end()) return take_row(*told);
        if (!row_->is_closed()) return collected_.notes.push_back(cut_line_note(lines_));
        row_->forget_last();
        return take_row(*told);
    }
    if (begins_again(line)) return;
    if (!lines_.has_line_end() && (result == Result::too_short || !row_->is_closed())) {
        return collected_.notes.push_back(cut_line_note(lines_));
    }
    leave_out(fault(result));
}

// Lines that are no rows by their beginning.
bool CsvReader::is_aside(std::string_view line) {
    if (header_->format->lines == Format::Lines::afterburner) return !line.starts_with("80") && !line.starts_with("02");
    if (!line.starts_with('[')) return false;
    // "[Key],value,[Key],value": of these what can't name a user's folders.
    const std::vector<std::string> fields = split_fields(line, header_->separator);
    for (std::size_t i = 0; i + 1 < fields.size(); i += 2) {
        for (const char* key : {"Platform", "Config", "CPU", "DesktopGPU"}) {
            if (same_name(fields[i], '[' + std::string(key) + ']')) collected_.settings[key] = fields[i + 1];
        }
    }
    return true;
}

// What was found and what was expected, of a row that can't be read.
std::string CsvReader::fault(RowSplitter::Result result) const {
    const std::string fields = "found " + std::to_string(row_->fields()) + " fields, expected ";
    switch (result) {
        case RowSplitter::Result::too_short:
            return fields + std::to_string(row_->needed()) + " or more";
        case RowSplitter::Result::too_long:
            return fields + std::to_string(header_->fields) + " at most: is a decimal comma taken for a separator?";
        case RowSplitter::Result::good:
            break;
    }
    return header_->name(Column::frame_time) + " is " + shown(row_->text(Column::frame_time)) +
           ", expected a number or NA";
}

void CsvReader::leave_out(std::string fault) {
    if (unreadable_.count == 0) first_fault_ = std::move(fault);
    unreadable_.add(lines_.number());
}

// Noise between rows is left out; a file that is mostly noise is none of ours.
void CsvReader::check_unreadable() const {
    constexpr std::int64_t always_passed = 10, one_in = 100;
    const std::int64_t count = unreadable_.count;
    if (count == 0 || (count < rows_ && count <= std::max(always_passed, (rows_ + count) / one_in))) return;
    const std::string others = count == 1 ? "" : " (and " + std::to_string(count - 1) + " rows more)";
    lines_.fail_at(unreadable_.first, first_fault_ + others);
}

// What files put together have between their rows: a header, with what may stand before it.
bool CsvReader::begins_again(std::string_view line) {
    if (line.starts_with("//") && header_->format->has_preamble) return true;
    is_seeking_ = header_->format->rows == Rows::samples && begins_mangohud(line);
    if (is_seeking_) {
        keep_preamble(line);
        return true;
    }
    const std::optional<Header> header = find_header(line, header_->format->has_preamble, wish_, lines_);
    const bool is_other_column = header && header->format->rows == Rows::times && header->format != header_->format;
    if (!header || header->is_a_row || is_other_column) return false;
    begin_table(*header, line);
    return true;
}

void CsvReader::take_row(double told) {
    ++rows_;
    const Rows rows = header_->format->rows;
    if (rows == Rows::presents || rows == Rows::frames) {
        take_present(told);
    } else {
        take_raw(told);
    }
    is_first_ = false;
}

void CsvReader::take_present(double told_ms) {
    StreamFrames& stream =
        table_.find(row_->text(Column::process), row_->text(Column::process_id), row_->text(Column::swap_chain));
    FrameRecord told{told_ms, part(Column::cpu, stream), part(Column::gpu, stream)};
    told.animation_error_ms = static_cast<float>(detail(Column::animation_error, stream));
    told.compilations = static_cast<float>(detail(Column::compilations, stream));
    if (header_->has(Column::frame_rest)) {
        told.cpu_ms = told_ms;
        told.frame_ms += number(Column::frame_rest);
    }
    stream.span.extend(lines_.number(), row_->text(Column::present_time));
    if (stream.frames.empty()) {
        stream.runtime = row_->text(Column::runtime);
        stream.resolution = row_->text(Column::resolution);
    }
    stream.present_modes.add(row_->text(Column::present_mode));
    const DisplayRow display = display_row(stream);
    if (is_no_frame(stream, told.frame_ms)) return stream.display.add_generated(display);
    told.fate = fate(stream);
    told.display_ms = static_cast<float>(
        stream.display.add(display, told, {header_->has(Column::displayed_time), has_simulation_start_}));
    if (told.fate == FrameRecord::Fate::dropped) told.animation_error_ms = FrameRecord().animation_error_ms;
    add_frame(stream, usable_frame(told, stream, lines_.number()), present());
    if (hear_ && &stream == &table_.streams().front() && stream.frames.size() % heard_at_once == 0)
        hear_(std::span(stream.frames).last(heard_at_once));
}

bool CsvReader::has_simulation_start() const {
    const bool has_display = header_->has(Column::display_change) || header_->has(Column::displayed_time);
    const bool has_present = header_->has(Column::present_seconds) && header_->has(Column::in_present);
    return has_display && (has_present || header_->has(Column::animation_time) ||
                           header_->has(Column::simulation_step) || header_->has(Column::cpu_start));
}

DisplayRow CsvReader::display_row(StreamFrames& stream) const {
    DisplayRow row;
    row.display_ms = detail(Column::display_change, stream);
    if (header_->has(Column::displayed_time)) row.display_ms = detail(Column::displayed_time, stream);
    if (!has_simulation_start_) return row;
    constexpr double ms_per_s = 1000;
    row.animation_ms = number(Column::animation_time);
    row.step_ms = number(Column::simulation_step);
    row.cpu_start_ms = number(Column::cpu_start);
    row.present_ms = ms_per_s * number(Column::present_seconds);
    row.in_present_ms = number(Column::in_present);
    return row;
}

// Whether the row only shows what another generated, or what was rendered before.
bool CsvReader::is_no_frame(StreamFrames& stream, double told_ms) {
    if (header_->format->rows != Rows::presents) return false;
    const std::string_view type = row_->text(Column::frame_type);
    const Maker maker = maker_of(type);
    const bool is_repeated = maker == Maker::repetition && present() != 0 && present() == stream.generated.present;
    if (maker == Maker::generator || is_repeated) {
        if (stream.generated.rows.count == 0) stream.generated.type = shown(type);
        stream.generated.rows.add(lines_.number());
        add_generated(stream, told_ms, present());
        return true;
    }
    if (maker == Maker::somebody || maker == Maker::repetition) {
        if (stream.other_types.count == 0) stream.other_type = shown(type);
        stream.other_types.add(lines_.number());
    }
    return !same_name(type, "Application") && is_shown_again(stream, told_ms, lines_.number());
}

// Whether the frame was ever shown.
FrameRecord::Fate CsvReader::fate(StreamFrames& stream) {
    using Fate = FrameRecord::Fate;
    const auto dropped = [&] {
        stream.unshown.add(lines_.number());
        return Fate::dropped;
    };
    const auto unknown_fate = [&] {
        stream.unknown_fate.add(lines_.number());
        return Fate::untold;
    };
    const std::string_view told = row_->text(Column::dropped);
    if (told == "0" || same_name(told, "false")) return Fate::shown;
    if (told == "1" || same_name(told, "true")) return dropped();
    if (header_->has(Column::dropped)) return told.empty() || is_not_available(told) ? Fate::untold : unknown_fate();
    const std::string_view displayed = row_->text(Column::displayed);
    if (displayed.empty()) return Fate::untold;
    const std::optional<double> time = told_number(displayed);
    has_display_times_ = has_display_times_ || (time && *time > 0);
    if (!time) return unknown_fate();
    return std::isnan(*time) || *time == 0 ? dropped() : Fate::shown;
}

// A row that means nothing before all are known.
void CsvReader::take_raw(double told) {
    StreamFrames& stream =
        table_.find(row_->text(Column::process), row_->text(Column::process_id), row_->text(Column::swap_chain));
    stream.span.extend(lines_.number(), row_->text(Column::present_time));
    stream.raw.push_back({told, number(Column::fps), number(Column::elapsed), lines_.number(), is_first_});
}

void CsvReader::finish_raw() {
    for (StreamFrames& stream : table_.streams()) {
        if (header_->format->rows == Rows::samples) take_mangohud_rows(stream, lines_.name());
        if (header_->format->rows == Rows::clock)
            take_raw_times(stream, {Unit::ms, ColumnMeaning::Sense::likely_clock});
        if (header_->format->rows == Rows::times) take_raw_times(stream, header_->meaning);
        if (header_->format->name == "Afterburner")
            stream.notes.push_back("samples, taken now and then: each stands for one frame, most are not recorded");
    }
}

// Animation errors that aren't recorded.
void CsvReader::finish_displays() {
    constexpr std::array<Column, simulation_starts> columns = {Column::animation_time, Column::simulation_step,
                                                               Column::cpu_start, Column::in_present};
    const bool is_shown_for = header_->has(Column::displayed_time);
    for (StreamFrames& stream : table_.streams()) {
        const std::optional<SimulationStart> start = stream.display.finish(stream.frames);
        if (!start) continue;
        const std::string present =
            *start == SimulationStart::present_end ? header_->name(Column::present_seconds) + " + " : "";
        stream.notes.push_back(
            computed_note(present + header_->name(columns[static_cast<std::size_t>(*start)]),
                          header_->name(is_shown_for ? Column::displayed_time : Column::display_change)));
    }
}

// Where no row has a display's time, it wasn't recorded.
void CsvReader::forget_untracked_displays() {
    if (header_->has(Column::dropped) || has_display_times_) return;
    bool is_forgotten = false;
    for (StreamFrames& stream : table_.streams()) {
        is_forgotten = is_forgotten || stream.unshown.count > 0;
        stream.unshown = {};
        for (FrameRecord& frame : stream.frames) frame.fate = FrameRecord::Fate::untold;
    }
    if (!is_forgotten) return;
    collected_.notes.push_back(header_->name(Column::displayed) +
                               " is told in no row: what was shown was not recorded, nothing is taken for dropped");
}

void CsvReader::append_notes() {
    std::vector<std::string>& notes = collected_.notes;
    if (before_header_.count > 0) {
        notes.push_back(counted(before_header_.count, "line", "lines") + " before the header, from line " +
                        std::to_string(before_header_.first) + first_before_header_ + ": left out");
    }
    if (unreadable_.count > 0) {
        notes.push_back(counted(unreadable_.count, "row", "rows") + " that can't be read, the first in line " +
                        std::to_string(unreadable_.first) + ": " + first_fault_ + ": left out");
    }
    if (repeated_headers_.count == 0) return;
    notes.push_back(
        "header found again in line " + std::to_string(repeated_headers_.first) +
        (repeated_headers_.count == 1 ? "" : " and " + std::to_string(repeated_headers_.count - 1) + " more") +
        ": recordings put together");
}

// NaN: not told, or no number.
double CsvReader::number(Column column) const {
    return told_number(row_->text(column)).value_or(unknown);
}

double CsvReader::part(Column column, StreamFrames& stream) const {
    const std::optional<double> told = told_number(row_->text(column));
    if (!told) stream.unusable_parts.add(lines_.number());
    return told.value_or(unknown);
}

double CsvReader::detail(Column column, StreamFrames& stream) const {
    const std::optional<double> told = told_number(row_->text(column));
    if (!told) stream.unusable_details.add(lines_.number());
    return told.value_or(unknown);
}

// Tells presents apart; 0: nothing says.
std::size_t CsvReader::present() const {
    if (!header_->has(Column::frame_type)) return 0;
    const std::string_view text = row_->text(Column::present_time);
    return text.empty() || is_not_available(text) ? 0 : std::hash<std::string_view>()(text) | 1;
}

void CsvReader::fail_without_header() const {
    const std::string expected = ", expected " + readable_formats();
    if (preamble_.empty()) lines_.fail_at(1, "found an empty file" + expected);
    const std::string wished = wish_.column.empty() ? "" : "no column " + shown(wish_.column) + " but ";
    for (std::size_t i = 0; i + 1 < preamble_.size(); ++i) {
        const std::string columns = number_columns(preamble_[i], preamble_[i + 1]);
        if (!columns.empty())
            lines_.fail("found " + wished + "columns " + columns + ", expected one of them named as --column");
    }
    lines_.fail_at(suspect_, "found no " + (wish_.column.empty() ? "header" : "column " + shown(wish_.column)) +
                                 " but " + shown(suspect_text_) + expected);
}

}  // namespace

std::string cut_line_note(const LineReader& lines) {
    return "line " + std::to_string(lines.number()) + ", the last, is cut short: left out";
}

Collected read_csv_recording(LineReader& lines, const ColumnWish& wish, const HearFrames& hear) {
    return CsvReader(lines, wish, hear).read();
}

}  // namespace sfsm
