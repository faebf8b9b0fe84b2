#include "sfsm/report/recording_html.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "sfsm/report/markup.h"
#include "sfsm/report/numbers.h"
#include "sfsm/report/series.h"

namespace sfsm::report {
namespace {

constexpr double percent = 100;

std::string unit_text(const std::string& unit) {
    return unit.empty() ? "" : " <small>" + escaped(unit) + "</small>";
}

std::string title_of(const std::string& meaning) {
    return meaning.empty() ? "" : " title=\"" + escaped(meaning) + "\"";
}

void write_tiles(std::ostream& out, const NumberGroup& group) {
    out << "<div class=\"tiles\"><h3>" << escaped(group.name) << "</h3><dl>\n";
    for (const NumberRow& row : group.rows) {
        out << "<div" << title_of(row.meaning) << "><dt>" << escaped(row.name) << unit_text(row.unit) << "</dt><dd>"
            << figure(row.values[0], row.digits) << "</dd></div>\n";
    }
    out << "</dl></div>\n";
}

// The head of a column that is a recording. Names of files may break where their parts end.
void write_head(std::ostream& out, const Report& report, std::size_t place) {
    out << "<th scope=\"col\">" << chip(place);
    for (const char c : escaped(report.recordings.at(place).name)) out << c << (c == '_' || c == '.' ? "<wbr>" : "");
    out << "</th>";
}

void write_group(std::ostream& out, const NumberGroup& group, std::size_t columns) {
    out << "<tr class=\"group\"><th scope=\"rowgroup\" colspan=\"" << columns + 1 << "\">" << escaped(group.name)
        << "</th></tr>\n";
    for (const NumberRow& row : group.rows) {
        out << "<tr" << title_of(row.meaning) << "><th scope=\"row\">" << escaped(row.name) << unit_text(row.unit)
            << "</th>";
        for (const double value : row.values) out << "<td>" << figure(value, row.digits) << "</td>";
        out << "</tr>\n";
    }
}

// The words that the numbers need, for those who can't hover.
void write_meanings(std::ostream& out, const std::vector<NumberGroup>& groups) {
    out << "<details class=\"meanings\"><summary>What each number means</summary><dl>\n";
    for (const NumberGroup& group : groups) {
        for (const NumberRow& row : group.rows) {
            if (row.meaning.empty()) continue;
            out << "<div><dt>" << escaped(row.name) << "</dt><dd>" << escaped(row.meaning) << "</dd></div>\n";
        }
    }
    out << "</dl></details>\n";
}

// Whether the second is better, in words: rates are to be high, shares of stutter low.
std::string verdict(const Difference& difference) {
    if (!std::isfinite(difference.low)) return "too short to tell";
    if (!difference.is_clear()) return "no clear difference";
    if (difference.is_share) return difference.low > 0 ? "more" : "less";
    return difference.low > 0 ? "faster" : "slower";
}

void write_difference(std::ostream& out, const Difference& difference) {
    const double scale = difference.is_share ? percent : 1;
    const int digits = difference.is_share ? 2 : 1;
    out << "<tr" << (difference.is_clear() ? " class=\"clear\"" : "") << "><th scope=\"row\">"
        << escaped(difference.name) << unit_text(difference.unit) << "</th><td>"
        << figure(scale * difference.first, digits) << "</td><td>" << figure(scale * difference.second, digits)
        << "</td><td>" << change_text(difference, difference.change) << "</td><td>" << interval_text(difference)
        << "</td><td class=\"words\">" << verdict(difference) << "</td></tr>\n";
}

void write_notes(std::ostream& out, const ReportedRecording& recording) {
    if (recording.notes.empty()) return;
    out << "<ul class=\"notes\">\n";
    for (const std::string& note : recording.notes) out << "<li>" << escaped(note) << "</li>\n";
    out << "</ul>\n";
}

std::string two_digits(std::int64_t value) {
    return (value < 10 ? "0" : "") + std::to_string(value);
}

// "1:04.25" or "2:01:04.25".
std::string clock_text(double ms) {
    constexpr std::int64_t second = 100, minute = 60 * second, hour = 60 * minute;
    const std::int64_t time = std::llround(ms / 10);
    const std::string rest = two_digits(time % minute / second) + '.' + two_digits(time % second);
    const std::int64_t minutes = time % hour / minute;
    if (time < hour) return std::to_string(minutes) + ':' + rest;
    return std::to_string(time / hour) + ':' + two_digits(minutes) + ':' + rest;
}

// "12 stutters: 9 x shader compilation, 3 x GPU."
std::string counted_causes(const std::vector<Stutter>& stutters) {
    std::array<std::int64_t, 6> counts{};
    for (const Stutter& stutter : stutters) ++counts.at(static_cast<std::size_t>(stutter.cause));
    const std::string all = std::to_string(stutters.size()) + (stutters.size() == 1 ? " stutter" : " stutters");
    if (counts[static_cast<std::size_t>(Cause::untold)] == std::ssize(stutters)) {
        return all + ". The log doesn't tell why.";
    }
    std::string text;
    for (std::size_t cause = 0; cause < counts.size(); ++cause) {
        if (counts[cause] == 0) continue;
        text += (text.empty() ? "" : ", ") + std::to_string(counts[cause]) + " \u00d7 " +
                std::string(name_of(static_cast<Cause>(cause)));
    }
    return all + ": " + text + ".";
}

void write_longest(std::ostream& out, std::size_t place, std::vector<Stutter> stutters) {
    constexpr std::size_t most = 10;
    std::stable_sort(stutters.begin(), stutters.end(),
                     [](const Stutter& a, const Stutter& b) { return a.frame_ms > b.frame_ms; });
    if (stutters.size() > most) stutters.resize(most);
    out << "<div class=\"scroll\"><table class=\"stutters\"><thead><tr><th scope=\"col\">At</th>"
           "<th scope=\"col\">Took <small>ms</small></th><th scope=\"col\">Moving mean <small>ms</small></th>"
           "<th scope=\"col\" class=\"words\">Cause</th><th scope=\"col\">Frame</th></tr></thead><tbody>\n";
    for (const Stutter& stutter : stutters) {
        out << "<tr><td><button type=\"button\" data-recording=\"" << place << "\" data-frame=\"" << stutter.frame
            << "\">" << clock_text(stutter.begins_ms) << "</button></td><td>" << figure(stutter.frame_ms, 1)
            << "</td><td>" << figure(stutter.mean_ms, 1) << "</td><td class=\"words\">"
            << escaped(name_of(stutter.cause)) << "</td><td>" << stutter.frame << "</td></tr>\n";
    }
    out << "</tbody></table></div>\n";
}

}  // namespace

std::string chip(std::size_t place) {
    return "<i class=\"chip\" style=\"--run: var(--run-" + std::to_string(place % 8) + ")\"></i>";
}

void write_facts(std::ostream& out, const std::vector<std::pair<std::string, std::string>>& facts) {
    if (facts.empty()) return;
    out << "<dl class=\"facts\">\n";
    for (const auto& [name, value] : facts) {
        out << "<div><dt>" << escaped(name) << "</dt><dd>" << escaped(value) << "</dd></div>\n";
    }
    out << "</dl>\n";
}

void write_numbers(std::ostream& out, const Report& report) {
    const std::vector<NumberGroup> groups = numbers_of(report.recordings);
    if (report.recordings.size() == 1) {
        for (const NumberGroup& group : groups) write_tiles(out, group);
        return write_meanings(out, groups);
    }
    out << "<div class=\"scroll\"><table class=\"numbers\"><thead><tr><th scope=\"col\">Figure</th>";
    for (std::size_t i = 0; i < report.recordings.size(); ++i) write_head(out, report, i);
    out << "</tr></thead><tbody>\n";
    for (const NumberGroup& group : groups) write_group(out, group, report.recordings.size());
    out << "</tbody></table></div>\n";
    write_meanings(out, groups);
}

void write_comparisons(std::ostream& out, const Report& report) {
    for (const Comparison& comparison : report.comparisons) {
        out << "<div class=\"scroll\"><table class=\"differences\"><thead><tr><th scope=\"col\">Figure</th>";
        for (const std::size_t place : {comparison.first, comparison.second}) write_head(out, report, place);
        out << "<th scope=\"col\">Change</th><th scope=\"col\">95 % interval</th>"
               "<th scope=\"col\" class=\"words\">The second is</th></tr></thead><tbody>\n";
        for (const Difference& difference : comparison.differences) write_difference(out, difference);
        out << "</tbody></table></div>\n";
    }
}

void write_origins(std::ostream& out, const Report& report) {
    for (std::size_t i = 0; i < report.recordings.size(); ++i) {
        const ReportedRecording& recording = report.recordings[i];
        if (recording.facts.empty() && recording.notes.empty()) continue;
        out << "<div class=\"origin\">";
        if (report.recordings.size() > 1) out << "<h3>" << chip(i) << escaped(recording.name) << "</h3>\n";
        write_facts(out, recording.facts);
        write_notes(out, recording);
        out << "</div>\n";
    }
}

void write_busy_figures(std::ostream& out, const Report& report) {
    for (std::size_t i = 0; i < report.recordings.size(); ++i) {
        const ReportedRecording& recording = report.recordings[i];
        const bool tells_gpu = is_told(series_of(recording.frames, &FrameRecord::gpu_ms)),
                   tells_cpu = is_told(series_of(recording.frames, &FrameRecord::cpu_ms));
        if (!tells_gpu && !tells_cpu) continue;
        const Bottleneck& held = recording.figures.bottleneck;
        out << "<figure id=\"recorded-busy-" << i << "\"><figcaption><span>";
        if (report.recordings.size() > 1) out << chip(i) << escaped(shortened(recording.name, 40)) << ": ";
        out << (tells_gpu && tells_cpu ? "CPU and GPU busy"
                : tells_gpu            ? "GPU busy"
                                       : "CPU busy")
            << " <small>[ms]</small></span>";
        if (tells_gpu) out << "<span class=\"key\"><span class=\"key-gpu\"></span>GPU</span>";
        if (tells_cpu) out << "<span class=\"key\"><span class=\"key-cpu\"></span>CPU</span>";
        if (held.frames > 0) {
            out << "<span class=\"key\">held up by the GPU in " << figure(percent * held.gpu, 0)
                << " % of the time, by the CPU in " << figure(percent * held.cpu, 0) << " %, by neither in "
                << figure(percent * held.neither, 0) << " %</span>";
        }
        out << "</figcaption><svg class=\"over-time\" tabindex=\"0\" role=\"application\" aria-label=\"CPU and GPU "
               "busy "
               "times\" aria-describedby=\"recorded-keys\"></svg></figure>\n";
    }
}

void write_stutters(std::ostream& out, const Report& report) {
    for (std::size_t i = 0; i < report.recordings.size(); ++i) {
        const ReportedRecording& recording = report.recordings[i];
        if (recording.stutters.empty()) continue;
        out << "<div class=\"stutter-list\">";
        if (report.recordings.size() > 1) out << "<h3>" << chip(i) << escaped(recording.name) << "</h3>\n";
        out << "<p>" << escaped(counted_causes(recording.stutters)) << "</p>\n";
        write_longest(out, i, recording.stutters);
        out << "</div>\n";
    }
}

}  // namespace sfsm::report
