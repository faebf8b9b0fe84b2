// MangoHud's rows: one a frame, or, with log_interval, one now and then.
#pragma once

#include "sfsm/recordings/stream_frames.h"

namespace sfsm {

// The raw rows become frames. Their unit is the one in which most frame times are the inverse of the fps beside them:
// milliseconds, or, of older versions, microseconds. If their elapsed times say that they are samples, each becomes as
// many frames as fit in the time since the one before; a rest is carried on, and the first only begins the clock. A gap
// of over ten usual ones is a pause, and stands for a usual one. Throws std::runtime_error, beginning with `name`, if
// samples stand for more than 20 million frames.
void take_mangohud_rows(StreamFrames& stream, const std::string& name);

}  // namespace sfsm
