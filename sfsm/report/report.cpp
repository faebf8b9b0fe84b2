#include "sfsm/report/report.h"

#include <ostream>

namespace sfsm {

ReportFrame report_frame(const TraceRow& row) {
    return {static_cast<float>(row.target_ms),           static_cast<float>(row.frame_ms),
            static_cast<float>(row.predicted_ms),        static_cast<float>(row.decision.motion_distance),
            static_cast<float>(row.decision.splat_size), row.decision.state};
}

std::vector<Score> time_scores(const std::vector<ReportFrame>&) {
    return {};
}

void write_report_html(std::ostream& out, const Report& report) {
    out << report.title << '\n';
}

void write_report_svg(std::ostream& out, const Report& report) {
    out << report.title << '\n';
}

}  // namespace sfsm
