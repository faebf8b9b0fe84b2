// Separable filters of pictures' planes, a row at a time on all cores: the same bits on any number of threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <vector>

namespace bench {

// One number a pixel, rows from the top.
struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;

    double* row(int y) { return values.data() + static_cast<std::size_t>(y) * width; }
    const double* row(int y) const { return values.data() + static_cast<std::size_t>(y) * width; }
};

// Around their middle: an odd number of them.
using Taps = std::vector<double>;

// What lies outside of a picture.
enum class Border {
    goes_on,  // its outermost pixels, again and again
    is_cut,   // nothing: the taps that are inside are made to sum to 1
};

Plane filtered_across(const Plane& plane, const Taps& taps, Border border);  // along the rows
Plane filtered_down(const Plane& plane, const Taps& taps, Border border);    // along the columns

// Calls work(y) for each row.
template <typename Work>
void for_each_row(int height, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const tbb::blocked_range<int>& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y) work(y);
    });
}

}  // namespace bench
