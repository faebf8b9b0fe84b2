// What work costs.
#pragma once

#include <array>

#include "sfsm/work.h"

namespace sfsm {

// Times [ms], each >= 0; NaN where one isn't known.
struct Prices {
    double frame = 0;                       // of what every frame has, whatever is drawn
    std::array<double, work_kinds> each{};  // of one of each kind

    constexpr double operator[](WorkKind kind) const { return each[index_of(kind)]; }
    constexpr double& operator[](WorkKind kind) { return each[index_of(kind)]; }
};

// All the same.
constexpr Prices equal_prices(double ms) {
    Prices prices{ms, {}};
    prices.each.fill(ms);
    return prices;
}

constexpr Prices operator*(double factor, Prices prices) {
    prices.frame *= factor;
    for (double& ms : prices.each) ms *= factor;
    return prices;
}

// What a frame of this work takes [ms].
double cost_of(const Work& work, const Prices& prices);

}  // namespace sfsm
