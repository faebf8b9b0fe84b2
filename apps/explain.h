// Why a law decides a frame of a trace as it does, in words.
#pragma once

#include <cstdint>
#include <ostream>

#include "sfsm/simulate/scorecard.h"
#include "sfsm/trace.h"

namespace apps {

// Feeds the law all that was known before that frame, with the recorded times, and writes what was asked of it, what it
// believed and foresaw, what it decides and why. The law is none that knows costs beforehand. Throws std::runtime_error
// if the trace has no such frame.
void write_explanation(std::ostream& out, const sfsm::Trace& trace, std::int64_t frame,
                       const sfsm::simulate::Contestant& law);

}  // namespace apps
