#include "tests/bench/front/page.h"

#include <algorithm>
#include <set>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include "sfsm/controller.h"
#include "sfsm/report/markup.h"
#include "sfsm/report/page_file.h"
#include "tests/bench/front/chart.h"
#include "tests/bench/front/embedded.h"
#include "tests/bench/front/page_file.h"
#include "tests/bench/front/scene.h"
#include "tests/bench/front/sentences.h"
#include "tests/bench/front/tables.h"

namespace bench::front {
namespace {

using sfsm::report::escaped;

struct Page {
    const Front& front;
    const Crops& crops;
    std::vector<Scene> scenes;
    std::vector<std::string> families;
    const ErrorKind& error = error_kinds().front();  // what is shown until a reader chooses
};

// One after another: the scenes of a crowd.
template <class Visit>
void for_each_crowd(const std::vector<Scene>& scenes, Visit visit) {
    for (std::size_t begin = 0, end; begin < scenes.size(); begin = end) {
        for (end = begin; end < scenes.size() && scenes[end].people == scenes[begin].people;) ++end;
        visit(begin, std::span(scenes).subspan(begin, end - begin));
    }
}

std::string machine_line(const Machine& machine) {
    std::string line = machine.processor.empty() ? "a processor without a name" : machine.processor;
    line += ", " + std::to_string(machine.threads) + (machine.threads == 1 ? " thread" : " threads");
    line += machine.opengl.empty() ? "; no OpenGL" : "; OpenGL: " + machine.opengl;
    return line + (machine.date.empty() ? "" : "; " + machine.date);
}

std::string answer(const char* id, const std::string& question, const Sentence& sentence) {
    return "<div><h2>" + question + "</h2><p id=\"" + id + "\">" + escaped(sentence.before) + "<b>" +
           escaped(sentence.key) + "</b>" + escaped(sentence.after) + "</p></div>\n";
}

std::string answers(const Page& page) {
    const std::string frame = time_text(frame_ms) + " ms";
    const bool is_empty = page.scenes.empty();
    const Sentence none{"Nothing was measured.", "", ""};
    return answer("draw", "What to draw in " + frame, is_empty ? none : what_to_draw(page.scenes[0], page.error)) +
           answer("buys", "What another millisecond buys",
                  is_empty ? none : what_a_millisecond_buys(page.scenes[0], page.error)) +
           answer("loses", "Where the law of today loses most",
                  is_empty ? none : where_the_law_loses(page.scenes, page.error).sentence);
}

std::string error_buttons() {
    std::string out;
    for (const ErrorKind& error : error_kinds()) {
        const bool is_first = &error == &error_kinds().front();
        out += "<button type=\"button\" data-error=\"" + std::string(error.id) + "\" aria-pressed=\"" +
               (is_first ? "true" : "false") + "\" title=\"" + escaped(error.meaning) + "\">" + escaped(error.name) +
               "</button>\n";
    }
    return out;
}

std::string crowd_buttons(const Page& page) {
    std::set<std::int64_t> crowds;
    for (const Scene& scene : page.scenes) crowds.insert(scene.people);
    std::string out;
    for (const std::int64_t people : crowds) {
        out += "<button type=\"button\" data-people=\"" + std::to_string(people) + "\" aria-pressed=\"" +
               (people == page.scenes.front().people ? "true" : "false") + "\">" + count_text(people) + "</button>\n";
    }
    return out;
}

std::string legend(const Page& page) {
    std::string out;
    for (std::size_t i = 0; i < page.families.size(); ++i) {
        out += "<span class=\"key family-" + std::to_string(i % family_looks) +
               "\"><svg class=\"swatch\" aria-hidden=\"true\" viewBox=\"0 0 26 12\"><path class=\"curve\" d=\"M0 "
               "6h26\"/><circle class=\"point\" cx=\"13\" cy=\"6\" r=\"3.5\"/></svg>" +
               escaped(page.families[i]) + "</span>\n";
    }
    out +=
        "<span class=\"key\"><svg class=\"swatch\" aria-hidden=\"true\" viewBox=\"0 0 26 12\"><path class=\"front\" "
        "d=\"M1 2H9V6H17V10H26\"/></svg>the front</span>\n";
    std::vector<std::string> laws;
    for (const Row& row : page.front.rows)
        if (row.is_mark() && std::find(laws.begin(), laws.end(), row.law) == laws.end()) laws.push_back(row.law);
    for (const std::string& law : laws) {
        out +=
            "<span class=\"key\"><svg class=\"swatch mark-swatch\" aria-hidden=\"true\" viewBox=\"-8 -8 16 16\">"
            "<path class=\"mark law-" +
            law_class(law) + "\" d=\"" + mark_path(law, 6) + "\"/></svg>" + escaped(law) +
            (law == sfsm::law_names().front() ? ", the law of today" : "") + "</span>\n";
    }
    return out;
}

// A crowd's charts, which are buttons that open the large one.
std::string overview(const Page& page) {
    std::string out;
    for_each_crowd(page.scenes, [&](std::size_t begin, std::span<const Scene> scenes) {
        const Range range = range_of(scenes, page.error);
        const bool is_first = begin == 0;
        out += "<div class=\"crowd\" data-people=\"" + std::to_string(scenes.front().people) + "\"><h3>" +
               count_text(scenes.front().people) + " people</h3><div class=\"views\">\n";
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            out += "<button type=\"button\" class=\"view\" data-scene=\"" + std::to_string(begin + i) +
                   "\" aria-pressed=\"" + (is_first && i == 0 ? "true" : "false") + "\"><span>" +
                   escaped(scenes[i].view) + "</span>" +
                   chart_svg(scenes[i], page.error, range, page.families, ChartSize::small) + "</button>\n";
        }
        out += "</div></div>\n";
    });
    return out;
}

std::string large_chart(const Page& page) {
    if (page.scenes.empty()) return "";
    const Scene& scene = page.scenes.front();
    return chart_svg(scene, page.error, range_of(std::span(&scene, 1), page.error), page.families, ChartSize::large);
}

std::string all_tables(const Page& page) {
    std::string out;
    for (const Scene& scene : page.scenes) {
        out += "<h3>" + escaped(scene.name()) + "</h3><div class=\"scroll\">" + front_table(scene, page.error) +
               "</div>\n";
    }
    return out;
}

std::string meanings() {
    std::string out;
    for (const ErrorKind& error : error_kinds()) {
        out += "<div><dt>" + escaped(error.name) +
               (error.unit.empty() ? "" : " <small>" + escaped(error.unit) + "</small>") + "</dt><dd>" +
               escaped(error.meaning) + "</dd></div>\n";
    }
    return out;
}

std::string script() {
    std::string out(sfsm::report::page_file("parts.js"));
    for (const char* file : {"data.js", "chart.js", "panel.js", "table.js", "page.js"}) out += page_file(file);
    return out;
}

// What stands in the page for {{name}}.
std::string part(const Page& page, std::string_view name) {
    if (name == "style") return std::string(sfsm::report::page_file("base.css")) + std::string(page_file("front.css"));
    if (name == "machine") return escaped(machine_line(page.front.machine));
    if (name == "answers") return answers(page);
    if (name == "errors") return error_buttons();
    if (name == "crowds") return crowd_buttons(page);
    if (name == "legend") return legend(page);
    if (name == "overview") return overview(page);
    if (name == "chart") return large_chart(page);
    if (name == "scene") return page.scenes.empty() ? "nothing was measured" : escaped(page.scenes.front().name());
    if (name == "tables") return all_tables(page);
    if (name == "verdicts") return verdict_tables(verdicts_of(page.scenes));
    if (name == "paper") return paper_table(page.scenes);
    if (name == "meanings") return meanings();
    if (name == "data") return embedded(page.front, page.scenes, page.crops);
    return name == "script" ? script() : "";
}

}  // namespace

std::string page_of(const Front& front, const Crops& crops) {
    const Page page{front, crops, scenes_of(front), families_of(front)};
    std::ostringstream out;
    sfsm::report::fill_page(out, page_file("front.html"), [&](std::string_view name) { out << part(page, name); });
    return std::move(out).str();
}

}  // namespace bench::front
