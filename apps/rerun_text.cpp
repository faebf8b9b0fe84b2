#include "apps/rerun_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/recording_text.h"
#include "apps/table.h"
#include "sfsm/summary.h"

namespace apps {
namespace {

namespace sim = sfsm::simulate;
using Json = nlohmann::ordered_json;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// How often, in a thousand frames, a decision isn't the one before.
double changes_per_1000(const std::vector<RerunFrame>& frames) {
    if (frames.size() < 2) return unknown;
    std::int64_t changes = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) changes += frames[i].decision != frames[i - 1].decision;
    return 1000.0 * static_cast<double>(changes) / static_cast<double>(frames.size() - 1);
}

// A miss that no frame could have is none that was avoided: NaN where nothing was judged, or less than a second.
sim::Metrics known(sim::Metrics metrics) {
    constexpr double second_ms = 1000;
    if (metrics.judged_ms < second_ms) metrics.worst_second = unknown;
    if (metrics.judged_ms > 0) return metrics;
    metrics.over_target = metrics.hitch_ms_per_s = metrics.overshoot_pct = unknown;
    return metrics;
}

// The picture kept, in shares of what a clairvoyant keeps; and what is felt of the misses.
void add_metrics(std::vector<sfsm::Score>& scores, const Rerun& rerun) {
    using Better = sfsm::Score::Better;
    const sim::Metrics metrics = known(rerun.metrics.value_or(sim::Metrics{}));
    const double quality = rerun.metrics ? 100 * metrics.quality : unknown;
    scores.push_back({"detail of the best", "%", quality, 1, Better::more});
    scores.push_back({"worst second over by 5 %", "%", 100 * metrics.worst_second, 1, Better::less});
    scores.push_back({"late", "ms/s", metrics.hitch_ms_per_s, 1, Better::less});
}

void add_metrics(Json& json, const sim::Metrics& metrics) {
    json["quality"] = number(metrics.quality);
    json["over_target"] = number(metrics.over_target);
    json["worst_second"] = number(metrics.worst_second);
    json["hitch_ms_per_s"] = number(metrics.hitch_ms_per_s);
    json["overshoot_pct"] = number(metrics.overshoot_pct);
}

Json prices_json(const sfsm::Prices& prices) {
    Json json{{"frame", number(prices.frame)}};
    for (const sfsm::WorkEntry& entry : sfsm::work_table) {
        std::string key(entry.name);
        std::replace(key.begin(), key.end(), ' ', '_');
        json[key] = number(prices[entry.kind]);
    }
    return json;
}

std::string percent(double share) {
    std::ostringstream text;
    text << std::showpos << std::fixed << std::setprecision(1) << 100 * share << " %";
    return text.str();
}

sfsm::ReportFrame report_frame(const RerunFrame& frame) {
    return {static_cast<float>(frame.target_ms),           static_cast<float>(frame.frame_ms),
            static_cast<float>(frame.predicted_ms),        static_cast<float>(frame.decision.motion_distance),
            static_cast<float>(frame.decision.splat_size), frame.decision.state,
            static_cast<float>(frame.decision.rate)};
}

}  // namespace

std::vector<sfsm::ReportRun> report_runs(std::span<const Rerun> reruns) {
    const bool is_closed =
        std::any_of(reruns.begin(), reruns.end(), [](const Rerun& rerun) { return rerun.metrics.has_value(); });
    std::vector<sfsm::ReportRun> runs;
    for (const Rerun& rerun : reruns) {
        sfsm::ReportRun& run = runs.emplace_back();
        run.name = rerun.law;
        run.frames.reserve(rerun.frames.size());
        for (const RerunFrame& frame : rerun.frames) run.frames.push_back(report_frame(frame));
        run.scores = sfsm::time_scores(run.frames);
        if (is_closed) add_metrics(run.scores, rerun);
        run.scores.push_back({"changes", "/1000", changes_per_1000(rerun.frames), 0, sfsm::Score::Better::less});
    }
    return runs;
}

void write_scores(std::ostream& out, std::span<const sfsm::ReportRun> runs) {
    std::vector<TableLine> lines(1);
    for (const sfsm::ReportRun& run : runs) lines[0].cells.push_back(run.name);
    for (std::size_t i = 0; i < runs.front().scores.size(); ++i) {
        const sfsm::Score& score = runs.front().scores[i];
        TableLine& line = lines.emplace_back();
        line.label = score.name + (score.unit.empty() ? "" : " [" + score.unit + "]");
        for (const sfsm::ReportRun& run : runs) line.cells.push_back(fixed(run.scores[i].value, run.scores[i].digits));
    }
    write_table(out, lines);
}

Json rerun_json(const Rerun& rerun) {
    sfsm::Summing summing;
    summing.expect(rerun.frames.size());
    for (const RerunFrame& frame : rerun.frames) summing.add({frame.target_ms, frame.frame_ms, frame.decision.state});
    const sfsm::Summary summary = summing.finish();
    Json json;
    json["law"] = rerun.law;
    json["frames"] = summary.frames;
    json["target_ms"] = number(summary.target_ms);
    json["mean_ms"] = number(summary.mean_ms);
    json["p50_ms"] = number(summary.p50_ms);
    json["p99_ms"] = number(summary.p99_ms);
    json["control_rate"] = number(summary.control_rate);
    json["within_5pct"] = number(summary.within_5pct);
    json["within_10pct"] = number(summary.within_10pct);
    json["over_5pct"] = number(summary.over_5pct);
    json["state_frames"] = summary.state_frames;
    json["changes_per_1000"] = number(changes_per_1000(rerun.frames));
    if (rerun.metrics) add_metrics(json, known(*rerun.metrics));
    return json;
}

void write_fit(std::ostream& out, const sim::CostFit& fit) {
    constexpr double us_per_ms = 1000;
    const auto write_price = [&](std::string_view name, double ms, double sigma) {
        out << "  " << std::left << std::setw(14) << name << std::right << std::setw(10) << us_per_ms * ms << " us +- "
            << us_per_ms * sigma << '\n';
    };
    out << "cost model of " << fit.frames << " frames, median " << std::setprecision(4) << fit.median_ms << " ms\n";
    write_price("frame", fit.prices.frame, fit.sigma.frame);
    for (const sfsm::WorkEntry& entry : sfsm::work_table)
        write_price(entry.name, fit.prices[entry.kind], fit.sigma[entry.kind]);
    out << "R2 " << fit.r2 << "; percentiles of time / model - 1";
    for (std::size_t i = 0; i < fit.percents.size(); ++i)
        out << (i == 0 ? ": " : ", ") << fit.percents[i] << " %: " << percent(fit.residual[i]);
    out << '\n';
}

Json fit_json(const sim::CostFit& fit) {
    Json json;
    json["frames"] = fit.frames;
    json["median_ms"] = number(fit.median_ms);
    json["r2"] = number(fit.r2);
    json["prices_ms"] = prices_json(fit.prices);
    json["sigma_ms"] = prices_json(fit.sigma);
    Json& residual = json["residual"] = Json::object();
    for (std::size_t i = 0; i < fit.percents.size(); ++i)
        residual["p" + std::to_string(static_cast<int>(fit.percents[i]))] = number(fit.residual[i]);
    return json;
}

}  // namespace apps
