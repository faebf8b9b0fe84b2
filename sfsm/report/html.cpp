#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>
#include <string_view>

#include "sfsm/report/embedded.h"
#include "sfsm/report/markup.h"
#include "sfsm/report/numbers.h"
#include "sfsm/report/page_file.h"
#include "sfsm/report/recording_html.h"
#include "sfsm/report/report.h"
#include "sfsm/report/small_multiples.h"

namespace sfsm {
namespace {

using namespace report;

constexpr std::size_t most_over_each_other = 7;  // runs in one chart: what was recorded, and six laws

void write_run_facts(std::ostream& out, const Report& report) {
    if (report.facts.empty()) return;
    out << "<div class=\"facts\">\n<h3>The run</h3>\n";
    write_facts(out, report.facts);
    out << "</div>\n";
}

// What is marked: the value none of the others beats, unless all are the same as they are shown.
bool is_best(const Report& report, std::size_t row, const Score& score) {
    if (score.better == Score::Better::neither || std::isnan(score.value)) return false;
    bool differs = false;
    for (const ReportRun& run : report.runs) {
        const Score& other = run.scores[row];
        const bool is_same = figure(other.value, other.digits) == figure(score.value, score.digits);
        const bool beats = score.better == Score::Better::more ? other.value > score.value : other.value < score.value;
        if (!is_same && beats) return false;
        differs = differs || !is_same;
    }
    return differs;
}

void write_score(std::ostream& out, const Report& report, std::size_t row, const Score& score) {
    const bool best = is_best(report, row, score);
    out << (best ? "<td class=\"best\">" : "<td>") << figure(score.value, score.digits)
        << (best ? "<span class=\"hidden\"> (best)</span>" : "") << "</td>";
}

// A figure a row, a run a column.
void write_scorecard(std::ostream& out, const Report& report) {
    out << "<table" << (report.runs.size() == 1 ? " class=\"single\"" : "")
        << "><thead><tr><th scope=\"col\">Figure</th>";
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        out << "<th scope=\"col\">" << chip(i) << escaped(report.runs[i].name) << "</th>";
    }
    out << "</tr></thead><tbody>\n";
    std::size_t rows = report.runs.front().scores.size();
    for (const ReportRun& run : report.runs) rows = std::min(rows, run.scores.size());
    for (std::size_t row = 0; row < rows; ++row) {
        const Score& first = report.runs.front().scores[row];
        out << "<tr><th scope=\"row\">" << escaped(first.name)
            << (first.unit.empty() ? "" : " <small>" + escaped(first.unit) + "</small>") << "</th>";
        for (const ReportRun& run : report.runs) write_score(out, report, row, run.scores[row]);
        out << "</tr>\n";
    }
    out << "</tbody></table>\n";
}

bool has_origins(const Report& report) {
    return std::any_of(report.recordings.begin(), report.recordings.end(), [](const ReportedRecording& recording) {
        return !recording.facts.empty() || !recording.notes.empty();
    });
}

// A part of the page that has a file of its own.
void write_section(std::ostream& out, const Report& report, const char* file);

void write_script(std::ostream& out) {
    for (const char* file : {"parts.js", "series.js", "plot.js", "view.js", "spread.js", "recording_charts.js",
                             "recordings.js", "laws.js", "law_charts.js", "page.js"}) {
        out << page_file(file);
    }
}

// What the charts of recordings and of laws both have, under ids that begin so.
void write_controls(std::ostream& out, const char* file, const char* prefix) {
    fill_page(out, page_file(file), [&](std::string_view) { out << prefix; });
}

// What stands in the page for {{name}}.
void write_part(std::ostream& out, const Report& report, std::string_view name) {
    if (name == "title") out << escaped(report.title);
    if (name == "style") out << page_file("base.css") << page_file("report.css");
    if (name == "recordings" && !report.recordings.empty()) write_section(out, report, "recordings.html");
    if (name == "laws" && !report.runs.empty()) {
        write_section(out, report, report.runs.size() > most_over_each_other ? "many_laws.html" : "laws.html");
    }
    if (name == "numbers") write_numbers(out, report);
    if (name == "comparisons" && !report.comparisons.empty()) write_section(out, report, "comparisons.html");
    if (name == "differences") write_comparisons(out, report);
    if (name == "busy") write_busy_figures(out, report);
    if (name == "stutters" && has_stutters(report)) write_section(out, report, "stutters.html");
    if (name == "stutter-lists") write_stutters(out, report);
    if (name == "origins" && has_origins(report)) write_section(out, report, "origins.html");
    if (name == "origin-lists") write_origins(out, report);
    if (name == "runs-title") out << escaped(report.runs_title);
    if (name == "runs-words" && !report.runs_words.empty()) out << "<p>" << escaped(report.runs_words) << "</p>\n";
    if (name == "tools") write_controls(out, "tools.html", "");
    if (name == "recorded-tools") write_controls(out, "tools.html", "recorded-");
    if (name == "keys") write_controls(out, "keys.html", "");
    if (name == "recorded-keys") write_controls(out, "keys.html", "recorded-");
    if (name == "facts") write_run_facts(out, report);
    if (name == "scorecard") write_scorecard(out, report);
    if (name == "small-multiples") write_small_multiples(out, report);
    if (name == "picture") write_report_svg(out, report);
    if (name == "data") write_embedded(out, report);
    if (name == "script") write_script(out);
}

void write_section(std::ostream& out, const Report& report, const char* file) {
    fill_page(out, page_file(file), [&](std::string_view name) { write_part(out, report, name); });
}

}  // namespace

void write_report_html(std::ostream& out, const Report& report) {
    write_section(out, report, "report.html");
}

}  // namespace sfsm
