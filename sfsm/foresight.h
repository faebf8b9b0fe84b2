// How far forecasts are off: what frames turned out to draw, against what was foreseen for them. Renderers count people
// in bins, and steps are interpolated between, so a forecast may be some per cent wrong for as long as a view lasts;
// prices can't mend that, since they are learned from what was drawn.
#pragma once

#include <array>
#include <cstdint>

#include "sfsm/cost_model.h"
#include "sfsm/decision.h"

namespace sfsm {

class Foresight {
public:
    // The work foreseen for decision number `frame`, counted from 0.
    void foresee(std::int64_t frame, const Decision& decision, const Amounts& amounts);

    // The work that came of it; frames that were not foreseen tell nothing. Times are compared at the model's prices.
    void observe(const FrameSample& sample, const Amounts& amounts, const CostModel& model);

    // ln of drawn over foreseen, a slow mean; 0 while forecasts are right.
    double bias() const { return bias_; }

private:
    struct Foreseen {
        std::int64_t frame = 0;
        Decision decision;
        Amounts amounts;
    };
    std::array<Foreseen, 32> foreseen_{};  // a ring
    double bias_ = 0;
    int heard_ = 0;  // frames, counted to a few
};

}  // namespace sfsm
