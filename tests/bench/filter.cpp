#include "tests/bench/filter.h"

#include <algorithm>

namespace bench {

namespace {

// out += tap * in, element by element: the loop that all the time goes to.
void add(double* __restrict out, const double* __restrict in, double tap, int count) {
    for (int i = 0; i < count; ++i) out[i] += tap * in[i];
}

// The sum of the taps that are inside at `at` of `count`.
double weight_inside(const Taps& taps, int at, int count) {
    const int radius = static_cast<int>(taps.size() / 2);
    double sum = 0;
    for (int i = std::max(-radius, -at); i <= std::min(radius, count - 1 - at); ++i)
        sum += taps[static_cast<std::size_t>(i + radius)];
    return sum;
}

}  // namespace

Plane filtered_across(const Plane& plane, const Taps& taps, Border border) {
    const int radius = static_cast<int>(taps.size() / 2), width = plane.width;
    std::vector<double> scale;
    for (int x = 0; border == Border::is_cut && x < width; ++x) scale.push_back(1 / weight_inside(taps, x, width));
    Plane out{width, plane.height, std::vector<double>(plane.values.size())};
    for_each_row(plane.height, [&](int y) {
        const double* in = plane.row(y);
        const bool goes_on = border == Border::goes_on;
        std::vector<double> padded(static_cast<std::size_t>(width) + 2 * radius);
        std::fill_n(padded.begin(), radius, goes_on ? in[0] : 0.0);
        std::copy(in, in + width, padded.begin() + radius);
        std::fill_n(padded.end() - radius, radius, goes_on ? in[width - 1] : 0.0);
        for (std::size_t i = 0; i < taps.size(); ++i) add(out.row(y), padded.data() + i, taps[i], width);
        for (std::size_t x = 0; x < scale.size(); ++x) out.row(y)[x] *= scale[x];
    });
    return out;
}

Plane filtered_down(const Plane& plane, const Taps& taps, Border border) {
    const int radius = static_cast<int>(taps.size() / 2), height = plane.height;
    Plane out{plane.width, height, std::vector<double>(plane.values.size())};
    for_each_row(height, [&](int y) {
        for (int i = -radius; i <= radius; ++i) {
            const bool inside = y + i >= 0 && y + i < height;
            if (!inside && border == Border::is_cut) continue;
            add(out.row(y), plane.row(std::clamp(y + i, 0, height - 1)), taps[static_cast<std::size_t>(i + radius)],
                plane.width);
        }
        if (border == Border::goes_on) return;
        const double scale = 1 / weight_inside(taps, y, height);
        for (int x = 0; x < plane.width; ++x) out.row(y)[x] *= scale;
    });
    return out;
}

}  // namespace bench
