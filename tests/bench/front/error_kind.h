// The errors that run time is held against, one of which a reader chooses.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tests/bench/front/row.h"

namespace bench::front {

struct ErrorKind {
    std::string_view id;       // "flip": a word of HTML
    std::string_view name;     // "FLIP"
    std::string_view unit;     // "dB", or empty
    std::string_view meaning;  // for the page
    int digits = 0;            // shown after the point
    bool more_is_better = false;
    double (*value)(const Row& row) = nullptr;

    // Less is better, whatever the error; -inf: the same picture; NaN: not known.
    double loss(const Row& row) const { return more_is_better ? -value(row) : value(row); }

    // Its height in a chart, where equal ratios of errors (of PSNR: differences) are equally high: log10 of the value,
    // or less decibels. -inf: the same picture.
    double height(const Row& row) const;

    // A value as text with its name and unit: "FLIP 0.0213", "PSNR 31.2 dB".
    std::string told(double of) const;
    std::string figure(double of) const;  // the number alone
};

// The first is shown first.
std::span<const ErrorKind> error_kinds();

}  // namespace bench::front
