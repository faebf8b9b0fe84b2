// What replay says of recordings: their figures, how they differ, and what laws would have made of them.
#pragma once

#include "apps/replay_options.h"

namespace apps {

// Reads, runs the laws that are asked for, and writes what is asked for: table, JSON, CSV, page, picture. Throws
// std::runtime_error with one line; then nothing is written.
void review(const ReplayOptions& options);

}  // namespace apps
