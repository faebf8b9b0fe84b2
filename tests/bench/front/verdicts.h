// What a front says of the default law: held against all that its own rates could have given, against rivals in the
// same time, and against itself as it was before rates; and what the frames' own expectations are worth. By FLIP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/front/scene.h"

namespace bench::front {

// Ways to draw that a law could have gone by instead, taken together: the least FLIP that one of their settings has.
struct Contender {
    std::string name;
    std::vector<std::string> families;  // of rows
};

// A choice of the default law. All ratios: 1 is as good, less is better than what it is held against; empty where
// nothing of that was measured in so little time.
struct Case {
    std::int64_t people = 0;
    std::string view;
    double target_ms = 0;
    double ms = 0, flip = 0;           // of what it chose
    std::optional<double> over_rates;  // its FLIP over the least of rates in its time
    // Whether the finest native drawing, which has the least FLIP of all native rows of the view, is as fast as the
    // target.
    bool finest_fits = false;
    // Where it isn't: the law's FLIP beyond the finest's, over each contender's in the law's time. As Verdicts says.
    std::vector<std::optional<double>> over_rivals;
    std::optional<double> over_before;  // its FLIP over that before rates in the same time

    std::string name() const;  // "20,000 people, still, 16.6 ms"
};

// How the FLIP that frames expected of themselves goes with what was measured, over rows of rates and laws' choices.
struct Expectation {
    std::size_t rows = 0;
    double rank_correlation = 0;  // Spearman's, [-1, 1]; 0 where either is the same everywhere
    double worst = 0;             // the largest |expected / measured - 1|
    std::string worst_of;         // which row that is
};

// What changes from frame to frame and should not, where the camera moves along the path: summed over the choices of
// the default law, and over those of the same law where it can set D and S alone.
struct Flicker {
    double by_rates = 0, by_knobs = 0;  // [of 255]
    int pairs = 0;
};

struct Verdicts {
    std::vector<Contender> rivals;
    std::vector<Case> cases;  // scene by scene, in the rows' order
    Expectation expectation;
    Flicker flicker;
};

Verdicts verdicts_of(const std::vector<Scene>& scenes);

// A line of them: over all cases that something can be said of.
struct Summary {
    std::string what;
    std::size_t cases = 0, of = 0;  // that have a ratio; that might have had one
    double median = 0, worst = 0;   // ratios; 0 without any case
    std::string worst_of;           // which case that is
};
std::vector<Summary> summaries(const Verdicts& verdicts);

// For a terminal, a line a summary; each with its end.
std::string verdicts_text(const Verdicts& verdicts);

// The least FLIP of the families' settings in exactly `ms`: that of the front of them, in a straight line of the time's
// logarithm from setting to setting. Nothing: none is so fast.
std::optional<double> least_flip(const std::vector<Row>& rows, const std::vector<std::string>& families, double ms);

// Spearman's, where equal values share the mean of their ranks; 0 where all of one are equal. As many of both.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace bench::front
