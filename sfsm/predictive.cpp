#include "sfsm/predictive.h"

#include <algorithm>

#include "sfsm/detail.h"
#include "sfsm/same_bits.h"
#include "sfsm/usable.h"

namespace sfsm {
namespace {

// Where nobody says how far people are visible: twice as far as the farthest D that is listed, as the first step of the
// list is of everybody.
double range_of(const Forecast& forecast) {
    double farthest = 0;
    for (const Step& step : forecast.motion)
        if (is_usable(step.setting)) farthest = std::max(farthest, step.setting);
    return is_usable(2 * farthest) ? 2 * farthest : unknown_range;
}

}  // namespace

PredictiveLaw::PredictiveLaw(const PredictiveOptions& options, Drawing drawing) : drawing_(drawing) {
    options.validate();
    aim_.options = options;
    by_forecast_.emplace(aim_, drawing_);
    by_axis_.emplace(aim_);
}

// What work costs is learned all the time, so that it is known when a forecast comes.
void PredictiveLaw::observe(const FrameSample& sample) {
    if (!is_usable(sample.ms)) {
        ++aim_.status.bad_samples;
        return;
    }
    FrameSample paired = sample;
    if (!pairing_.pair(paired)) return;
    aim_.status.last_ms = paired.ms;
    by_forecast_->observe(paired);
    if (!has_forecast_) by_axis_->observe(paired);
}

Decision PredictiveLaw::decide(const FrameRequest& request) {
    take(request);
    if (aim_.asked_ms > 0) {
        aim_.begin();
        if (has_forecast_) {
            by_forecast_->decide(*request.forecast, pairing_.count());
        } else {
            by_axis_->decide(pairing_.count());
        }
    }
    pairing_.add(aim_.status.decision);
    return aim_.status.decision;
}

void PredictiveLaw::take(const FrameRequest& request) {
    if (is_usable(request.target_ms)) {
        if (request.target_ms != aim_.asked_ms) by_axis_->retarget();
        aim_.status.target_ms = aim_.asked_ms = request.target_ms;
    }
    has_forecast_ = request.forecast && !request.forecast->motion.empty() && !request.forecast->shapes.empty();
    if (is_usable(request.range)) given_range_ = request.range;
    aim_.range = given_range_;
    if (given_range_ == 0) aim_.range = has_forecast_ ? range_of(*request.forecast) : unknown_range;
}

void PredictiveLaw::reset() {
    Aim fresh;
    fresh.options = aim_.options;
    fresh.asked_ms = fresh.status.target_ms = aim_.asked_ms;
    aim_ = fresh;
    by_forecast_.emplace(aim_, drawing_);
    by_axis_.emplace(aim_);
    pairing_.forget();
}

}  // namespace sfsm
