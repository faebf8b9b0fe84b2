#include "sfsm/predictive_options.h"

#include <stdexcept>
#include <string>

#include "sfsm/same_bits.h"

namespace sfsm {

void PredictiveOptions::validate() const {
    const auto require = [](bool holds, const char* rule) {
        if (!holds) throw std::invalid_argument(std::string("predictive law: expected ") + rule);
    };
    require(headroom >= 0 && headroom <= 3, "headroom in [0, 3]");
    require(most_headroom >= 0 && most_headroom <= 0.5, "most_headroom in [0, 0.5]");
    require(tail_limit >= 1 && tail_limit <= 2, "tail_limit in [1, 2]");
    require(lowest_aim > 0 && lowest_aim <= 1, "lowest_aim in (0, 1]");
    require(caution >= 0 && caution <= 3, "caution in [0, 3]");
    require(probes >= 0, "probes from 0");
    require(band >= 0 && band <= 0.2, "band in [0, 0.2]");
    require(band_sigmas >= 0 && band_sigmas <= 6, "band_sigmas in [0, 6]");
    require(worthwhile >= 0 && worthwhile <= 1, "worthwhile in [0, 1]");
    require(better >= 0 && better <= 1, "better in [0, 1]");
}

}  // namespace sfsm
