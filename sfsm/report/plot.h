// Where numbers lie in a picture: axes, and curves thinned to what can be seen. page/parts.js and page/plot.js are its
// twins.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sfsm::report {

// Numbers low..high along begin..end [px]. What lies beyond is put at the nearer end, NaN nowhere.
struct Axis {
    double low = 0, high = 1;
    double begin = 0, end = 1;

    double operator()(double value) const;
};

// Round numbers inside the axis, at most `most` and 1 more.
std::vector<double> ticks(const Axis& axis, int most);

// As short as a tick's label can be.
std::string tick_text(double value);

// Neighbouring frames [begin, end) that share a column of the picture. Nothing known of any: low > high.
struct Bucket {
    std::int64_t begin = 0, end = 0;
    float low = 0, high = 0;

    bool is_empty() const { return low > high; }
};

// Of values [begin, end).
Bucket bucket(std::span<const float> values, std::int64_t begin, std::int64_t end);

// One bucket a frame as long as no more than two share a column, else one a column: no spike is lost.
std::vector<Bucket> thin(std::span<const float> values, int columns);

// The top of an axis that shows the times of all runs well, whatever a few of them are: 1.25 times what 95 % of them do
// not exceed, but not over 4 times their median nor under 1.5 times the highest target; the highest time where that is
// less. Of nothing: 1.
double fitted_top(std::span<const float> times, std::span<const float> targets);

}  // namespace sfsm::report
