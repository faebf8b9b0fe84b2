// A report's data as the page's script reads it.
#pragma once

#include <iosfwd>

#include "sfsm/report/report.h"

namespace sfsm::report {

// JSON, safe inside a <script>: {"target_ms", "causes", "recordings": [...], "runs": [...]}.
//
// A recording is {"name", "frames", "seconds", "series": {"frame_ms", "display_ms", ...}, "stutters"}, with the series
// that are told in any frame; a run {"name", "frames", "series": {"target_ms", ..., "state"}}.
//
// A series is {"width", "low"} or {"width", "low", "high"}: the least and the most of each `width` frames, which are
// the same where there is no "high". Either is one of
//   {"quantum", "packed"}: base64 of a varint a value. 0 is none, else it is 1 + the zigzag of the quanta from the last
//   value to this;
//   {"values", "counts"}: base64 of little-endian float32 (of states uint8), to the bit as they are; and of uint32 how
//   often each comes in a row, empty where each comes once.
// States of more frames than are kept are {"width", "slowed", "points"}: shares of each `width` frames in 1/255.
// Stutters are {"frames", "causes"}: base64 of uint32, and of uint8, a place in "causes" each.
void write_embedded(std::ostream& out, const Report& report);

}  // namespace sfsm::report
