// A status in words: why the newest decision was taken, and what is believed.
#pragma once

#include <string>

#include "sfsm/status.h"

namespace sfsm {

// Lines with their ends. The first ones say what was decided and why, then what was asked, aimed at and predicted; then
// what frames wait for, drift, ceiling and the correction of forecasts, where there are any; then all prices that are
// known, each with 1 sigma in shares of it. Whatever the locale.
std::string status_text(const Status& status);

// "state 2 (points), D 24.11 m, S 2.5 px, rate 1.2e-06 px".
std::string decision_text(const Decision& decision);

// With so many digits, but never fewer than a whole number has: "0.36", "120".
std::string short_number(double value, int digits);

// With four digits: "16.67 ms", "1.2 us", "5.31 ns".
std::string duration_text(double ms);

// With two digits: "4.2 %".
std::string percent_text(double share);

// A duration and 1 sigma of it: "5.31 ns +- 4.2 %".
std::string estimate_text(double ms, double sigma_ms);

}  // namespace sfsm
