// How far forecasts are off: the work that frames drew, compared with the work that was foreseen for them. Renderers
// count people in bins, and laws interpolate between steps, so a forecast may be some per cent wrong for as long as a
// view lasts. Some renderers only guess: a kind of work may be foreseen at half or at twice what is drawn. Prices can't
// mend either: they are learned from the work that was drawn.
#pragma once

#include <array>
#include <cstdint>

#include "sfsm/cost_model.h"
#include "sfsm/decision.h"

namespace sfsm {

// Drawn and foreseen work are compared by the times the model predicts for them.
// - A slow mean makes up for frames that are off by little. One frame moves it little, however far it is off.
// - A kind of work whose error takes a tenth of the frame's time is believed at once, when two frames in a row that
//   draw it are off alike.
class Foresight {
public:
    Foresight() { factor_.fill(1); }

    // The work foreseen for decision number `frame`, counted from 0.
    void foresee(std::int64_t frame, const Decision& decision, const Amounts& amounts);

    // The work that the frame drew; of the model's terms. A frame that was not foreseen tells nothing.
    void observe(const FrameSample& sample, const Amounts& amounts, const CostModel& model);

    // Drawn over foreseen, of the kind of a term in [1, most_terms): in [1/8, 8].
    double factor(int term) const { return factor_[static_cast<std::size_t>(term)]; }

    // The work that will be drawn where so much is foreseen, kind by kind.
    Amounts corrected(Amounts foreseen) const;

    // ln(drawn / corrected), a slow mean; 0 while forecasts are right.
    double bias() const { return bias_; }

private:
    struct Foreseen {
        std::int64_t frame = 0;
        Decision decision;
        Amounts amounts;
    };

    bool learn_factors(const Amounts& foreseen, const Amounts& drawn, const CostModel& model);

    std::array<Foreseen, 32> foreseen_{};  // a ring
    std::array<double, most_terms> factor_{};
    double bias_ = 0;
    int heard_ = 0;                              // frames, counted to a few
    std::array<double, most_terms> surprise_{};  // [share of the time] by which each kind was last off
};

}  // namespace sfsm
