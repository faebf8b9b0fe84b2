// The settings of the predictive law. Times and losses are compared as shares; a sigma is a standard deviation.
#pragma once

namespace sfsm {

struct PredictiveOptions {
    // The aim: how far below the target frames are aimed.
    double headroom = 0.25;         // [sigmas of one frame's noise], [0, 3]
    double most_headroom = 0.0075;  // [share of the target] the headroom is never more, [0, 0.5]
    double tail_limit = 1.05;       // [share of the target] the slowest frames but 3 % are to take no more, [1, 2]
    double lowest_aim = 0.92;       // [share of the target] but for them it is lowered no further, (0, 1]
    double caution = 0.25;          // [sigmas of the prediction] and lower by this, since it may be wrong, [0, 3]

    // A decision is kept while its predicted time is as near to the aim as the wider of these two.
    double band = 0.006;       // [share of the aim], [0, 0.2]
    double band_sigmas = 2.6;  // [sigmas of the prediction], [0, 6]
    double better = 0.1;       // [share of the loss] another decision must save to be taken all the same, [0, 1]

    double worthwhile = 0.25;  // [share of the miss] that detail may cost at most where it is out of reach, [0, 1]
    int probes = 2;            // single frames drawn to learn what motion costs, and as many for points, >= 0

    // Throws std::invalid_argument naming the first broken rule.
    void validate() const;
};

}  // namespace sfsm
