// A recording's figures and frames to read: for people, for programs, and as a table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "sfsm/frame_times/differences.h"
#include "sfsm/frame_times/figures.h"
#include "sfsm/frame_times/stutters.h"
#include "sfsm/recordings/frame_record.h"
#include "sfsm/report/report.h"

namespace apps {

// Null for what is no number.
nlohmann::ordered_json number(double value);

// Keys end in their unit, shares are in [0, 1]; null for what is no number. `stutters` are those of the same recording.
nlohmann::ordered_json figures_json(const sfsm::Figures& figures, std::span<const sfsm::Stutter> stutters);

// A list of objects, one a figure.
nlohmann::ordered_json differences_json(std::span<const sfsm::Difference> differences);

// A table, a line a figure and a column a recording, one or more: sfsm/report/numbers.h.
void write_figures(std::ostream& out, std::span<const sfsm::ReportedRecording> recordings);

// A table, a line a figure: of both, the change, and where it lies with 95 %; "clear" where that is on one side of
// none.
void write_differences(std::ostream& out, std::string_view first, std::string_view second,
                       std::span<const sfsm::Difference> differences);

// The frames as they were understood, a row each: run, frame (from 0), time_s (when it begins, after the first did),
// frame_time_ms, cpu_ms, gpu_ms, display_ms, animation_error_ms, dropped (1 or 0), compilations. What isn't told is
// empty. read_recording reads the same records back, to the bit; of several runs in one file each by its name.
void write_frames_csv(std::ostream& out, std::string_view run, std::span<const sfsm::FrameRecord> frames, bool header);

}  // namespace apps
