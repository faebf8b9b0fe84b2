// Recordings that are tables: every format of formats.h.
#pragma once

#include <string>

#include "sfsm/recordings/formats.h"
#include "sfsm/recordings/recording.h"
#include "sfsm/recordings/stream_frames.h"

namespace sfsm {

class LineReader;

// From the first line on; `hear` as read_recording has it. Throws std::runtime_error as read_recording says.
Collected read_csv_recording(LineReader& lines, const ColumnWish& wish, const HearFrames& hear);

// The note on a last line that has no line end.
std::string cut_line_note(const LineReader& lines);

}  // namespace sfsm
