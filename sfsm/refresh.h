// What can be learned from times that a display rounds up to whole refreshes. Such a time says only between which two
// refreshes the frame was ready. A frame that is always in time doesn't say how much time it had left.
#pragma once

#include "sfsm/cost_model.h"

namespace sfsm {

// Stands between times and a model. Times are taken for rounded ones when several in a row are the target or a whole
// multiple of it, to six digits. Then the model is told its own prediction, as long as that lies between the same two
// refreshes; and its gain is lowered little by little, until 2 % of the frames miss their refresh.
class Refresh {
public:
    void observe(CostModel& model, const Amounts& amounts, double ms, double target_ms);

private:
    void drift(CostModel& model, bool is_late);

    int rounded_ = 0;  // rounded times in a row, counted to a few
    int late_ = 0;     // late frames in a row
    int near_ = 0;     // [frames] for which a refresh that was missed still counts as not long ago
    double target_ms_ = 0;
};

}  // namespace sfsm
