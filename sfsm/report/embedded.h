// A report's runs as the page's script reads them.
#pragma once

#include <iosfwd>

#include "sfsm/report/report.h"

namespace sfsm::report {

// JSON, safe inside a <script>: {"runs": [{"name", "frames", "series": {"target_ms", "frame_ms", "predicted_ms",
// "motion_distance", "splat_size", "state": {"values", "counts"}}}]}. `values` is base64 of little-endian float32, of
// state uint8; to the bit as they are in the report. `counts` is base64 of little-endian uint32, how often each value
// comes in a row; an empty string where each comes once.
void write_embedded(std::ostream& out, const Report& report);

}  // namespace sfsm::report
