// Times that a display rounds up to whole refreshes: what can still be learned of them. Such a time says only between
// which two refreshes the frame was ready, so a frame that is always in time hides how much time it has to spare.
#pragma once

#include "sfsm/cost_model.h"

namespace sfsm {

// Stands between times and a model. Times that are the target, or whole multiples of it, to six digits and several
// times running, are taken for rounded ones: the model is told what it predicted while that lies between the
// refreshes, and its gain is let down little by little until 2 % of the frames miss their refresh.
class Refresh {
public:
    void observe(CostModel& model, const Amounts& amounts, double ms, double target_ms);

private:
    void drift(CostModel& model, bool is_late);

    int rounded_ = 0;  // times running, counted to a few
    int late_ = 0;     // in a row
    int near_ = 0;     // over 0: a refresh has been missed not long ago
    double target_ms_ = 0;
};

}  // namespace sfsm
