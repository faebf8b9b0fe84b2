#include "sfsm/predictive.h"

#include "sfsm/same_bits.h"
#include "sfsm/usable.h"

namespace sfsm {

PredictiveLaw::PredictiveLaw(const PredictiveOptions& options, Drawing drawing) : by_forecast_(aim_, drawing) {
    options.validate();
    aim_.options = options;
}

// What work costs is learned all the time, so that it is known when a forecast comes.
void PredictiveLaw::observe(const FrameSample& sample) {
    if (!is_usable(sample.ms)) {
        ++aim_.status.bad_samples;
        return;
    }
    aim_.status.last_ms = sample.ms;
    by_forecast_.observe(sample);
    if (!has_forecast_) by_axis_.observe(sample);
}

Decision PredictiveLaw::decide(const FrameRequest& request) {
    if (is_usable(request.target_ms)) {
        if (request.target_ms != aim_.asked_ms) by_axis_.retarget();
        aim_.status.target_ms = aim_.asked_ms = request.target_ms;
    }
    if (is_usable(request.range)) aim_.range = request.range;
    has_forecast_ = request.forecast && !request.forecast->motion.empty() && !request.forecast->shapes.empty();
    if (aim_.asked_ms > 0 && aim_.range > 0) {
        aim_.begin();
        if (has_forecast_) {
            by_forecast_.decide(*request.forecast, decisions_);
        } else {
            by_axis_.decide(decisions_);
        }
    }
    ++decisions_;
    return aim_.status.decision;
}

}  // namespace sfsm
