// Our own traces: CSV, one row a frame, a header line first, before it lines starting with '#' that carry the run's
// settings as "# key=value". Numbers are written so that they read back to the same bits.
#pragma once

#include <iosfwd>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sfsm/decision.h"
#include "sfsm/forecast.h"

namespace sfsm {

class LineReader;

struct TraceRow {
    std::int64_t frame = 0;
    double target_ms = 0;
    double frame_ms = 0;  // what the controller holds at the target; NaN = not measured
    double cpu_ms = 0;    // to record the frame
    double gpu_ms = 0;    // NaN where the driver cannot say
    double predicted_ms = std::numeric_limits<double>::quiet_NaN();  // Status's, of this frame; NaN: the law can't say
    Decision decision;                                               // the one this frame was drawn with
    double range = 0;                                                // L [m] given to the controller before this frame
    Work work;
    std::int64_t hidden = 0;           // people who are not drawn as the structure hides them
    std::optional<State> drawn_state;  // what became of the decision, if the renderer said so: at most its state

    // What the renderer promises of the frame; NaN: it can't say.
    double max_motion_error_px =
        std::numeric_limits<double>::quiet_NaN();                          // of anybody's surface, as they moved before
    double max_splat_error_px = std::numeric_limits<double>::quiet_NaN();  // of it to the nearest that is drawn of it
    double predicted_flip = std::numeric_limits<double>::quiet_NaN();      // mean over the frame, [0, 1]

    // The forecast given to the controller before this frame; all empty if there was none.
    std::vector<Step> motion, shapes;
    std::vector<RateStep> rates;
    bool has_forecast() const { return !motion.empty() && !shapes.empty(); }
    // As long as the row lives.
    Forecast forecast() const { return {only_on<WorkAxis::frame>(work), motion, shapes, rates}; }
};

struct Trace {
    std::map<std::string, std::string> settings;
    std::vector<TraceRow> rows;
    std::string name = {};  // of the file it was read from, for messages
    bool is_cut = false;    // the file ended within a row, which is left out
};

// trace_columns.h has the columns.
void write_trace_header(std::ostream& out, const std::map<std::string, std::string>& settings);
void write_trace_row(std::ostream& out, const TraceRow& row);

// Columns are found by name, unknown ones are skipped. A last line without a line end is left out: its last number may
// have been cut short. Throws std::runtime_error naming `name`, the line and what was expected there; the trace
// keeps `name`.
Trace read_trace(std::istream& in, const std::string& name);
Trace read_trace(LineReader& lines);  // from its first line on

}  // namespace sfsm
