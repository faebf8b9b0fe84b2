// Recordings that are tables: every format of formats.h.
#pragma once

#include "sfsm/recordings/stream_frames.h"

namespace sfsm {

class LineReader;

// From the first line on. Throws std::runtime_error as read_recording says.
Collected read_csv_recording(LineReader& lines);

}  // namespace sfsm
