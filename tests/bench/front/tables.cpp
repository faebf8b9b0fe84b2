#include "tests/bench/front/tables.h"

#include <algorithm>
#include <array>

#include "sfsm/report/markup.h"
#include "tests/bench/front/sentences.h"

namespace bench::front {
namespace {

using sfsm::report::escaped;

std::string cell(const std::string& text) {
    return "<td>" + text + "</td>";
}

std::string row_cells(const Row& row) {
    std::string out =
        cell(time_text(row.wall_ms)) + cell(time_text(row.wall_low_ms) + "\u2013" + time_text(row.wall_high_ms));
    for (const ErrorKind& error : error_kinds()) out += cell(error.figure(error.value(row)));
    return out;
}

std::string head(const char* first) {
    std::string out = std::string("<thead><tr><th scope=\"col\">") + first +
                      "</th><th scope=\"col\">Time <small>ms</small></th><th scope=\"col\">Quartiles</th>";
    for (const ErrorKind& error : error_kinds()) {
        out += "<th scope=\"col\">" + escaped(error.name) +
               (error.unit.empty() ? "" : " <small>" + escaped(error.unit) + "</small>") + "</th>";
    }
    return out + "</tr></thead>\n";
}

// Lyu, Zhang and Fan 2018, section 4 and figures 4 and 6 to 8: times are 1000 / frames a second.
struct PaperFigure {
    const char* what;
    double ms;
    const char* time;
    const char* error;
    bool is_of_20k;
};
constexpr std::array paper_figures = {
    PaperFigure{"State 0: original triangles", 1000, "1,000 (1.0 fps)", "the reference", true},
    PaperFigure{"State 1: far people move less often", 300, "300\u2013310 (3.3 fps)", "no figure; \u201Cremained\u201D",
                true},
    PaperFigure{"State 2: people as points", 95, "95 (10.5 fps)", "no figure; \u201Cslightly lower\u201D", true},
    PaperFigure{"Points of 0.2 px, crowd not stated", 46.9, "46.9 (21.3 fps)", "no figure", false},
    PaperFigure{"Points of 1 px, crowd not stated", 15.3, "15.3 (65.5 fps)", "no figure", false},
};

std::string ours_in(const Scene* scene, const PaperFigure& figure) {
    if (scene == nullptr || !figure.is_of_20k) return "\u2013";
    const ErrorKind& error = error_kinds().front();
    const auto best = best_within(*scene, front_of(scene->rows, error), figure.ms);
    if (!best) return "nothing so fast";
    const Row& row = scene->rows[*best];
    return escaped(setting_text(row)) + ": " + error.told(error.value(row)) + " in " + time_text(row.wall_ms) + " ms";
}

constexpr int ratio_digits = 2;

std::string ratio_cell(const std::optional<double>& ratio) {
    return cell(ratio ? sfsm::report::figure(*ratio, ratio_digits) : "\u2013");
}

std::string head_row(const std::vector<std::string>& names) {
    std::string out = "<thead><tr>";
    for (const std::string& name : names) out += "<th scope=\"col\">" + escaped(name) + "</th>";
    return out + "</tr></thead><tbody>\n";
}

std::string summary_table(const Verdicts& verdicts) {
    std::string out = "<table>" + head_row({"Of the law\u2019s choices", "Compared", "Median", "Worst", "Which"});
    for (const Summary& summary : summaries(verdicts)) {
        const auto figure = [&](double ratio) {
            return ratio_cell(summary.cases > 0 ? std::optional(ratio) : std::nullopt);
        };
        out += "<tr><th scope=\"row\">" + escaped(summary.what) + "</th>" +
               cell(std::to_string(summary.cases) + " of " + std::to_string(summary.of)) + figure(summary.median) +
               figure(summary.worst) + cell(escaped(summary.worst_of)) + "</tr>\n";
    }
    return out + "</tbody></table>\n";
}

std::string expectation_line(const Expectation& expectation) {
    if (expectation.rows == 0) return "<p>No frame said what FLIP it expects of itself.</p>\n";
    return "<p>What frames expected of themselves, in " + std::to_string(expectation.rows) +
           " rows of rates and of laws: rank correlation with the measured FLIP " +
           sfsm::report::figure(expectation.rank_correlation, 3) + ", off by " +
           sfsm::report::figure(100 * expectation.worst, 0) + " % at worst: " + escaped(expectation.worst_of) +
           ".</p>\n";
}

std::string case_table(const Verdicts& verdicts) {
    std::vector<std::string> names{"Choice", "Time ms", "FLIP", "Over any rate", "Finest fits"};
    for (const Contender& rival : verdicts.rivals) names.push_back("Beyond the finest, over " + rival.name);
    names.emplace_back("Over before rates");
    std::string out = "<table>" + head_row(names);
    const ErrorKind& flip = error_kinds().front();
    for (const Case& one : verdicts.cases) {
        out += "<tr><th scope=\"row\">" + escaped(one.name()) + "</th>" + cell(time_text(one.ms)) +
               cell(flip.figure(one.flip)) + ratio_cell(one.over_rates) + cell(one.finest_fits ? "yes" : "no");
        for (const auto& ratio : one.over_rivals) out += ratio_cell(ratio);
        out += ratio_cell(one.over_before) + "</tr>\n";
    }
    return out + "</tbody></table>\n";
}

}  // namespace

std::string front_table(const Scene& scene, const ErrorKind& error) {
    std::string out = "<table>" + head("The front, fast to slow") + "<tbody>\n";
    for (const std::size_t i : front_of(scene.rows, error)) {
        const Row& row = scene.rows[i];
        out += "<tr><th scope=\"row\">" + escaped(setting_text(row)) + "</th>" + row_cells(row) + "</tr>\n";
    }
    out += "</tbody><tbody>\n";
    for (const Row& row : scene.rows) {
        if (!row.is_mark()) continue;
        out += "<tr class=\"of-law\"><th scope=\"row\">" + escaped(row.law) + " at " + target_text(row.target_ms) +
               " ms: " + escaped(setting_text(row)) + "</th>" + row_cells(row) + "</tr>\n";
    }
    return out + "</tbody></table>\n";
}

std::string verdict_tables(const Verdicts& verdicts) {
    if (verdicts.cases.empty()) return "<p>What the law of today chooses was not measured.</p>\n";
    return "<div class=\"scroll\">" + summary_table(verdicts) + "</div>\n" + expectation_line(verdicts.expectation) +
           "<details><summary>Choice by choice</summary><div class=\"scroll\">" + case_table(verdicts) +
           "</div></details>\n";
}

std::string paper_table(const std::vector<Scene>& scenes) {
    constexpr std::int64_t crowd = 20'000;
    const auto found =
        std::find_if(scenes.begin(), scenes.end(), [](const Scene& scene) { return scene.people == crowd; });
    const Scene* scene = found == scenes.end() ? nullptr : &*found;
    std::string out =
        "<table><thead><tr><th scope=\"col\">In the paper, 20,000 people of 1,000 triangles</th>"
        "<th scope=\"col\">Time <small>ms</small></th><th scope=\"col\">Error</th><th scope=\"col\">Best here in that "
        "time" +
        (scene ? "<small>, " + escaped(scene->view) + "</small>" : std::string()) + "</th></tr></thead><tbody>\n";
    for (const PaperFigure& figure : paper_figures) {
        out += std::string("<tr><th scope=\"row\">") + figure.what + "</th>" + cell(figure.time) + cell(figure.error) +
               cell(ours_in(scene, figure)) + "</tr>\n";
    }
    return out + "</tbody></table>\n";
}

}  // namespace bench::front
