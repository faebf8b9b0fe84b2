// How far forecasts are off: the work that frames drew, compared with the work that was foreseen for them. Renderers
// count people in bins, and laws interpolate between steps, so a forecast may be some per cent wrong for as long as a
// view lasts. Prices can't mend that: they are learned from the work that was drawn.
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

    // The work that the frame drew. Drawn and foreseen work are compared by the times the model predicts for them. A
    // frame that was not foreseen tells nothing.
    void observe(const FrameSample& sample, const Amounts& amounts, const CostModel& model);

    // ln(drawn / foreseen), a slow mean; 0 while forecasts are right.
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
