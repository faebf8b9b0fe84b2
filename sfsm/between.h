// A number between two others, in a straight line.
#pragma once

namespace sfsm {

// `a` at share 0, `b` at 1; share in [0, 1]. It is what std::lerp is, but the same bits with every library and, being
// in no header, with every compiler's flags (same_bits.h).
double between(double a, double b, double share);

}  // namespace sfsm
