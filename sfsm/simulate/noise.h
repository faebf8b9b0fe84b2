// Random numbers that are a function of (seed, frame, stream) alone: whatever a law decides, and whichever law it is,
// frame k of seed s meets the same noise. Standard distributions differ between platforms; these don't.
#pragma once

#include <cstdint>

namespace sfsm::simulate {

// Which of a frame's numbers: streams are independent of each other.
enum class Stream : std::uint64_t { noise = 1, spike = 2, spike_size = 3, stamp = 4, chi = 5 };

// Uniform in (0, 1), both ends left out.
double uniform_at(std::uint64_t seed, std::int64_t frame, Stream stream);

// Standard normal (Box and Muller 1958).
double normal_at(std::uint64_t seed, std::int64_t frame, Stream stream);

// Student's t of 3 degrees of freedom, over its deviation: one in 72 is beyond 3.
double heavy_tailed_at(std::uint64_t seed, std::int64_t frame, Stream stream);

// Correlated from frame to frame, of deviation 1: AR(1) with `correlation` in [0, 1). 0: normal. Else a sum of
// uniforms, as near to normal as it is long; what is older than a thousandth of its weight is left out. Cost: 66
// uniforms at 0.9.
double correlated_normal_at(std::uint64_t seed, std::int64_t frame, Stream stream, double correlation);

}  // namespace sfsm::simulate
