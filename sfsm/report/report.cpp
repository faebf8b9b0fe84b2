#include "sfsm/report/report.h"

#include <utility>

#include "sfsm/summary.h"

namespace sfsm {

ReportFrame report_frame(const TraceRow& row) {
    return {static_cast<float>(row.target_ms),           static_cast<float>(row.frame_ms),
            static_cast<float>(row.predicted_ms),        static_cast<float>(row.decision.motion_distance),
            static_cast<float>(row.decision.splat_size), row.decision.state,
            static_cast<float>(row.decision.rate)};
}

std::vector<Score> time_scores(const std::vector<ReportFrame>& frames) {
    Summing summing;
    summing.expect(frames.size());
    for (const ReportFrame& frame : frames) summing.add({frame.target_ms, frame.frame_ms, frame.state});
    const Summary summary = summing.finish();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto share = [&](double value) { return summary.frames > 0 ? 100 * value : none; };
    const auto time = [&](double value) { return summary.frames > 0 ? value : none; };
    using enum Score::Better;
    return {
        {"control rate", "%", share(summary.control_rate), 1, more},
        {"within 5 %", "%", share(summary.within_5pct), 1, more},
        {"within 10 %", "%", share(summary.within_10pct), 1, more},
        {"over by 5 %", "%", share(summary.over_5pct), 1, less},
        {"mean", "ms", time(summary.mean_ms), 2, neither},
        {"median", "ms", time(summary.p50_ms), 2, neither},
        {"99th percentile", "ms", time(summary.p99_ms), 2, less},
    };
}

ReportRun report_run(std::string name, std::span<const TraceRow> rows) {
    ReportRun run{std::move(name), {}, {}};
    run.frames.reserve(rows.size());
    for (const TraceRow& row : rows) run.frames.push_back(report_frame(row));
    run.scores = time_scores(run.frames);
    return run;
}

}  // namespace sfsm
