#include <ostream>

#include "sfsm/report/markup.h"
#include "sfsm/report/pictures.h"
#include "sfsm/report/report.h"
#include "sfsm/report/svg_parts.h"

namespace sfsm {

using namespace report;

void write_report_svg(std::ostream& out, const Report& report) {
    std::string body =
        text(chart_left, 38, filled(ink) + " font-size=\"19\" font-weight=\"600\"", shortened(report.title, 64));
    double y = 38;
    if (!report.recordings.empty()) y = draw_recordings(body, report, y + 30);
    if (!report.runs.empty() && !report.recordings.empty()) {
        y += 56;
        body += text(chart_left, y, filled(ink) + " font-size=\"16\" font-weight=\"600\"",
                     shortened(report.runs_title, 80));
    }
    if (!report.runs.empty()) y = draw_laws(body, report, y + 30);
    y += 28;
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << pixels(picture_width) << ' ' << pixels(y)
        << "\" role=\"img\" aria-label=\"" << escaped(report.title)
        << "\" font-family=\"system-ui, sans-serif\" font-size=\"12.5\" fill=\"none\">\n"
        << law_patterns << "<rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"#fff\"/>\n"
        << body << "</svg>\n";
}

}  // namespace sfsm
