// A recorded run fed through a law again.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sfsm/controller.h"
#include "sfsm/trace.h"

namespace sfsm {

// The latest that times may arrive [frames].
inline constexpr int max_delay = 16;

// What a law did before a frame.
struct Replayed {
    Decision decision;
    double predicted_ms = 0;  // Status's
};

// A recorded run fed through a law frame by frame. Before it decides frame k, it has observed the times of the frames
// up to k - 1 - delay; `delay` in [0, max_delay]. Open loop: each recorded time is taken for the time of the law's own
// decision. A row without a time is not observed.
class Replaying {
public:
    Replaying(Controller& law, int delay);  // the law must outlive it

    Replayed next(const TraceRow& row);

private:
    Controller& law_;
    int delay_;
    std::deque<FrameSample> under_way_;  // that have not arrived; NaN ms: never measured
};

// The rows of a run, be they kept or made as they are asked for: a row is what it is until another one is asked for.
struct RunRows {
    std::size_t count = 0;
    std::function<const TraceRow&(std::size_t)> at;
};
RunRows run_rows(std::span<const TraceRow> rows);  // which must outlive them

// What `law` decides at the rows' targets and ranges; one element a row.
std::vector<Replayed> replay(Controller& law, const RunRows& rows, int delay);
std::vector<Replayed> replay(Controller& law, std::span<const TraceRow> rows, int delay);

// The setting `delay`; 0 where the trace has none. Throws std::runtime_error when it is not a number in [0, max_delay].
int trace_delay(const Trace& trace);

// By what the trace's frames were drawn: the setting `draw`; OpenGL where the trace has none. Throws std::runtime_error
// when it names none.
Drawing trace_drawing(const Trace& trace);

// A number of a decision that differs from the recorded one in any bit.
struct FirstDifference {
    std::int64_t frame = 0;
    std::string field;  // the trace column
    double recorded = 0;
    double decided = 0;
};
std::optional<FirstDifference> first_difference(std::span<const TraceRow> rows, std::span<const Replayed> replayed);

}  // namespace sfsm
