// Seeded runs of several kinds.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sfsm/random.h"
#include "sfsm/recordings/frame_record.h"

namespace sfsm {

inline std::vector<FrameRecord> run_of(const std::vector<double>& times) {
    std::vector<FrameRecord> frames(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) frames[i].frame_ms = times[i];
    return frames;
}

// Numbers of a seed, one after the other.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : seed_(mix(seed)) {}
    double uniform() { return unit(stream(seed_, next_++)); }  // [0, 1)
    double normal() {                                          // Box and Muller
        constexpr double turn = 6.283185307179586;
        return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(turn * uniform());
    }

private:
    std::uint64_t seed_, next_ = 0;
};

enum class Kind { smooth, spiky, bimodal, ties, gaps };
inline const std::vector<std::pair<Kind, std::string>> kinds = {{Kind::smooth, "smooth"},
                                                                {Kind::spiky, "spiky"},
                                                                {Kind::bimodal, "bimodal"},
                                                                {Kind::ties, "ties"},
                                                                {Kind::gaps, "gaps"}};

inline double time_of(Kind kind, std::size_t frame, Numbers& numbers) {
    const double jitter = numbers.uniform();
    switch (kind) {
        case Kind::smooth:
            return 16 + std::sin(0.01 * static_cast<double>(frame)) + jitter;
        case Kind::spiky:
            return numbers.uniform() < 0.03 ? 30 + 200 * jitter : 7 + jitter;
        case Kind::bimodal:
            return (numbers.uniform() < 0.4 ? 8 : 16) + 0.5 * jitter;
        case Kind::ties:
            return 1 + std::floor(4 * jitter) + (numbers.uniform() < 0.05 ? 20 : 0);
        case Kind::gaps:
            return numbers.uniform() < 0.2 ? FrameRecord::untold : 5 + 30 * jitter * jitter * jitter;
    }
    return 0;
}

inline std::vector<double> times_of(Kind kind, std::size_t frames, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> times;
    for (std::size_t i = 0; i < frames; ++i) times.push_back(time_of(kind, i, numbers));
    return times;
}

}  // namespace sfsm
