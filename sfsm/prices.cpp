#include "sfsm/prices.h"

#include "sfsm/same_bits.h"

namespace sfsm {

double cost_of(const Work& work, const Prices& prices) {
    double ms = prices.frame;
    for (std::size_t i = 0; i < work_kinds; ++i) ms += prices.each[i] * counted(work.counts[i]);
    return ms;
}

}  // namespace sfsm
