// A program may make its swap chain anew, at a change of resolution or of its window: the run goes on.
#pragma once

#include <string_view>
#include <vector>

#include "sfsm/recordings/stream_frames.h"

namespace sfsm {

// Streams of one process that follow one another become one stream, in their order, with a note. Those that overlap in
// time stay apart: the busiest takes in what doesn't overlap it, then the next. Times are the presents' where they are
// numbers, else the order of lines. Streams without a span stay as they are.
void join_swap_chains(std::vector<StreamFrames>& streams);

// Whether they name one: equal, or equal as hexadecimal numbers ("0x00a0" and "A0").
bool is_same_chain(std::string_view a, std::string_view b);

}  // namespace sfsm
