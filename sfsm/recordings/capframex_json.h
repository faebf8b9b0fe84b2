// CapFrameX's own files: JSON, with "Info" and several "Runs", each with parallel arrays in its "CaptureData".
#pragma once

#include "sfsm/recordings/stream_frames.h"

namespace sfsm {

class LineReader;

// Every run becomes a stream; of several each is named "run 1", "run 2" ... as its swap chain. Parses as it reads and
// keeps only the arrays it needs. Throws std::runtime_error as read_recording says.
Collected read_capframex_json(LineReader& lines);

}  // namespace sfsm
