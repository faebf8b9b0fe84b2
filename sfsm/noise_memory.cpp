#include "sfsm/noise_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr int memory = 400;   // [frames]
constexpr int enough = 60;    // [frames]
constexpr double clip = 4;    // [sigmas]
constexpr double sure = 0.5;  // correlation
constexpr double most = 0.92;
constexpr double exact = 0.003;  // [relative] less noise than that is prices that are wrong

}  // namespace

void NoiseMemory::add(double difference, double noise) {
    const double d = std::clamp(difference / noise, -clip, clip);
    const double before = std::exchange(last_, d);
    heard_ = std::min(heard_ + 1, memory);
    squares_ += (d * d - squares_) / heard_;
    products_ += (d * before - products_) / heard_;
    const double found = squares_ > 0 ? 1 + 2 * products_ / squares_ : 0;
    const bool is_known = heard_ >= enough && found >= sure && noise >= exact;
    correlation_ = is_known ? std::min(found, most) : 0;
    of_a_frame_ = std::sqrt(1 / (1 - correlation_));
    of_a_mean_ = of_a_frame_ * std::sqrt((1 + correlation_) / (1 - correlation_));
}

}  // namespace sfsm
