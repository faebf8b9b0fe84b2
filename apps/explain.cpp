#include "apps/explain.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/rerun.h"
#include "sfsm/pair_plans.h"
#include "sfsm/rate_plans.h"
#include "sfsm/replay.h"
#include "sfsm/status_text.h"

namespace apps {
namespace {

// All rows up to that frame, and it.
std::span<const sfsm::TraceRow> rows_until(const sfsm::Trace& trace, std::int64_t frame) {
    const auto found = std::ranges::find(trace.rows, frame, &sfsm::TraceRow::frame);
    if (found != trace.rows.end()) return {trace.rows.begin(), found + 1};
    throw std::runtime_error(trace.name + ": found no frame " + std::to_string(frame) + ", expected one from " +
                             std::to_string(trace.rows.front().frame) + " to " +
                             std::to_string(trace.rows.back().frame));
}

void write_asked(std::ostream& out, const sfsm::TraceRow& row) {
    out << "asked: " << sfsm::duration_text(row.target_ms) << ", L " << sfsm::short_number(row.range, 4) << " m, ";
    if (!row.has_forecast()) {
        out << "no forecast\n";
    } else if (row.rates.empty()) {
        out << "forecast of " << row.motion.size() << " steps of D and " << row.shapes.size() << " of S\n";
    } else {
        out << "forecast of " << row.rates.size() << " rates\n";
    }
}

// The newest time that had arrived; times may be missing.
void write_heard(std::ostream& out, std::span<const sfsm::TraceRow> rows, int delay) {
    for (std::size_t i = rows.size() - 1; i-- > 0;) {
        if (rows[i].frame >= rows.back().frame - delay || std::isnan(rows[i].frame_ms)) continue;
        out << "heard: frame " << rows[i].frame << " took " << sfsm::duration_text(rows[i].frame_ms)
            << ", the newest time there was\n";
        return;
    }
    out << "heard: no time yet\n";
}

sfsm::Plan plan_at(const sfsm::Forecast& forecast, double range, const sfsm::Decision& decision) {
    if (forecast.rates.empty()) return sfsm::PairPlans(forecast, range).at(decision);
    return sfsm::RatePlans(forecast, range).at(decision);
}

// What the forecast says that the decision draws, and what that is believed to take.
void write_foreseen(std::ostream& out, const sfsm::TraceRow& row, const sfsm::Status& status) {
    if (!row.has_forecast()) return;
    const sfsm::Forecast forecast = row.forecast();
    const sfsm::Plan plan = plan_at(forecast, row.range, status.decision);
    out << "foreseen of that:\n";
    if (std::isfinite(status.price_ms.frame))
        out << "  what every frame has: " << sfsm::estimate_text(status.price_ms.frame, status.price_sigma_ms.frame)
            << '\n';
    for (const sfsm::WorkEntry& entry : sfsm::work_table) {
        const double count = plan[entry.kind], ms = status.price_ms[entry.kind];
        if (!(count >= 0.5)) continue;
        out << "  " << std::llround(std::min(count, 1e15)) << " x " << entry.name;
        if (std::isfinite(ms)) {
            const double factor = status.foreseen_factor[sfsm::index_of(entry.kind)];
            out << ": " << sfsm::estimate_text(count * factor * ms, count * factor * status.price_sigma_ms[entry.kind]);
        }
        out << '\n';
    }
    out << "  lost: " << sfsm::percent_text(plan.loss / (1 + plan.loss)) << " of the detail\n";
}

void write_came(std::ostream& out, const sfsm::TraceRow& row, const sfsm::Decision& decided) {
    const bool is_other = sfsm::first_difference({&row, 1}, std::vector<sfsm::Replayed>{{decided, 0}}).has_value();
    out << "recorded: ";
    if (is_other) out << sfsm::decision_text(row.decision) << ", another decision; with it the frame took ";
    if (!is_other) out << "the same decision; the frame took ";
    out << (std::isnan(row.frame_ms) ? "an unknown time" : sfsm::duration_text(row.frame_ms)) << '\n';
}

}  // namespace

void write_explanation(std::ostream& out, const sfsm::Trace& trace, std::int64_t frame,
                       const sfsm::simulate::Contestant& law) {
    const std::span<const sfsm::TraceRow> rows = rows_until(trace, frame);
    const int delay = sfsm::trace_delay(trace);
    const std::unique_ptr<sfsm::Controller> controller = make_law(law, sfsm::trace_drawing(trace));
    sfsm::replay(*controller, rows, delay);
    const sfsm::Status& status = controller->status();
    out << trace.name << ": frame " << frame << ", law " << law.name << '\n';
    write_asked(out, rows.back());
    write_heard(out, rows, delay);
    out << sfsm::status_text(status);
    write_foreseen(out, rows.back(), status);
    write_came(out, rows.back(), status.decision);
}

}  // namespace apps
