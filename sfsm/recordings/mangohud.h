// MangoHud's rows: one a frame, or, with log_interval, one now and then.
#pragma once

#include "sfsm/recordings/stream_frames.h"

namespace sfsm {

// A row's frametime [ms]. Older versions write it in whole microseconds, and then fps is its inverse.
double in_milliseconds(double frametime, double fps);

// If the rows' elapsed times say that they are samples: each becomes as many frames as fit in the time since the one
// before, and a rest is carried on. A sample stands for 1000 frames at most: what is longer was a pause. Else nothing
// changes. Throws std::runtime_error, beginning with `name`, if they would be more than 20 million frames.
void spread_samples(StreamFrames& stream, const std::string& name);

}  // namespace sfsm
