#include "sfsm/report/plot.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace sfsm::report {
namespace {

// The smallest of the sorted values that at least `share` of them do not exceed.
double ranked(const std::vector<double>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

Bucket bucket(std::span<const float> values, std::int64_t begin, std::int64_t end) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Bucket bucket{begin, end, infinity, -infinity};
    for (const float value : values.subspan(begin, end - begin)) {
        if (value <= bucket.low) bucket.low = value;
        if (value >= bucket.high) bucket.high = value;
    }
    return bucket;
}

double Axis::operator()(double value) const {
    const double share = (std::clamp(value, low, high) - low) / (high - low);
    return begin + share * (end - begin);
}

std::vector<double> ticks(const Axis& axis, int most) {
    const double rough = (axis.high - axis.low) / most;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0}) {
        if (factor * power >= rough) step = factor * power;
    }
    std::vector<double> values;
    const double first = std::ceil(axis.low / step);
    for (double i = first; i * step <= axis.high && i <= first + most; ++i) values.push_back(i * step);
    return values;
}

std::string tick_text(double value) {
    constexpr int figures = 6;
    char text[32];
    const auto end =
        std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value, std::chars_format::general, figures);
    return {text, end.ptr};
}

std::vector<Bucket> thin(std::span<const float> values, int columns) {
    const auto frames = static_cast<std::int64_t>(values.size());
    const std::int64_t buckets = frames <= 2 * columns ? frames : columns;
    std::vector<Bucket> thinned;
    for (std::int64_t i = 0; i < buckets; ++i) {
        thinned.push_back(bucket(values, i * frames / buckets, (i + 1) * frames / buckets));
    }
    return thinned;
}

double fitted_top(std::span<const float> times, std::span<const float> targets) {
    std::vector<double> sorted;
    for (const float time : times) {
        if (std::isfinite(time)) sorted.push_back(time);
    }
    std::sort(sorted.begin(), sorted.end());
    double target = 0;
    for (const float value : targets) {
        if (std::isfinite(value)) target = std::max<double>(target, value);
    }
    const double least = 1.5 * target;
    if (sorted.empty()) return least > 0 ? least : 1;
    const double robust = std::min(1.25 * ranked(sorted, 0.95), 4 * ranked(sorted, 0.5));
    const double top = std::min(1.05 * sorted.back(), std::max(least, robust));
    const double shown = std::max(top, 1.1 * target);
    return shown > 0 ? shown : 1;
}

}  // namespace sfsm::report
