#include "sfsm/replay.h"

#include <cassert>
#include <cmath>
#include <stdexcept>

#include "sfsm/number_text.h"
#include "sfsm/same_bits.h"
#include "sfsm/text.h"
#include "sfsm/trace_columns.h"

namespace sfsm {
namespace {

std::string found_setting(const Trace& trace, const std::pair<const std::string, std::string>& setting) {
    return (trace.name.empty() ? "" : trace.name + ": ") + "found setting " + setting.first + "=" +
           shown(setting.second);
}

}  // namespace

RunRows run_rows(std::span<const TraceRow> rows) {
    return {rows.size(), [rows](std::size_t i) -> const TraceRow& { return rows[i]; }};
}

std::vector<Replayed> replay(Controller& law, std::span<const TraceRow> rows, int delay) {
    return replay(law, run_rows(rows), delay);
}

std::vector<Replayed> replay(Controller& law, const RunRows& rows, int delay) {
    Replaying replaying(law, delay);
    std::vector<Replayed> replayed;
    replayed.reserve(rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) replayed.push_back(replaying.next(rows.at(i)));
    return replayed;
}

Replaying::Replaying(Controller& law, int delay) : law_(law), delay_(delay) {
    assert(delay >= 0 && delay <= max_delay);
}

Replayed Replaying::next(const TraceRow& row) {
    for (; !under_way_.empty() && under_way_.front().frame < row.frame - delay_; under_way_.pop_front()) {
        if (!std::isnan(under_way_.front().ms)) law_.observe(under_way_.front());
    }
    const Forecast forecast = row.forecast();
    const Decision decision = law_.decide({row.target_ms, row.range, row.has_forecast() ? &forecast : nullptr});
    under_way_.push_back({row.frame, row.frame_ms, decision, row.work});
    return {decision, law_.status().predicted_ms};
}

int trace_delay(const Trace& trace) {
    const auto found = trace.settings.find("delay");
    if (found == trace.settings.end()) return 0;
    const std::optional<std::int64_t> delay = parse_integer(found->second);
    if (!delay || *delay < 0 || *delay > max_delay)
        throw std::runtime_error(found_setting(trace, *found) + ", expected a whole number in [0, " +
                                 std::to_string(max_delay) + "]");
    return static_cast<int>(*delay);
}

Drawing trace_drawing(const Trace& trace) {
    const auto found = trace.settings.find("draw");
    if (found == trace.settings.end()) return Drawing::opengl;
    const std::optional<Drawing> drawing = drawing_named(found->second);
    if (drawing) return *drawing;
    std::string message = found_setting(trace, *found) + ", expected one of:";
    for (const std::string_view name : drawing_names) message.append(" ").append(name);
    throw std::runtime_error(message);
}

std::optional<FirstDifference> first_difference(std::span<const TraceRow> rows, std::span<const Replayed> replayed) {
    assert(rows.size() == replayed.size());
    // Numbers are written so that they read back to the same bits: equal texts are equal bits.
    TraceRow again;
    std::string recorded, decided;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        again.decision = replayed[i].decision;
        for (const TraceColumn& column : trace_columns()) {
            if (!column.is_decided) continue;
            recorded.clear();
            decided.clear();
            column.write(recorded, rows[i]);
            column.write(decided, again);
            if (recorded == decided) continue;
            return FirstDifference{rows[i].frame, std::string(column.name), *parse_double(recorded), *parse_double(decided)};
        }
    }
    return std::nullopt;
}

}  // namespace sfsm
