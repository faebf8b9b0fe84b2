// What frames take, by the clock and of all the process' threads together.
#pragma once

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <utility>
#include <vector>

namespace bench {

// The value that `share` in [0, 1] of them are below; between two of an even number the upper. At least one value.
inline double quantile(std::vector<double> values, double share) {
    assert(!values.empty());
    const auto rank = std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

inline double median(std::vector<double> values) {
    return quantile(std::move(values), 0.5);
}

// [ms]
struct Times {
    std::vector<double> wall, process;

    template <typename Work>
    void take(Work work) {
        const auto process_ms = [] {
            timespec now{};
            clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
            return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
        };
        using milliseconds = std::chrono::duration<double, std::milli>;
        const double process_start = process_ms();
        const auto start = std::chrono::steady_clock::now();
        work();
        wall.push_back(milliseconds(std::chrono::steady_clock::now() - start).count());
        process.push_back(process_ms() - process_start);
    }
};

}  // namespace bench
