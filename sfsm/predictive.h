// The default law: it learns what frames cost and draws the finest one that is predicted to meet the target. With a
// forecast it decides by that (by_forecast.h), without one along the one axis of decisions (by_axis.h).
// docs/controller.md tells the story.
#pragma once

#include <cstdint>

#include "sfsm/aim.h"
#include "sfsm/by_axis.h"
#include "sfsm/by_forecast.h"
#include "sfsm/controller.h"
#include "sfsm/predictive_options.h"

namespace sfsm {

class PredictiveLaw final : public Controller {
public:
    // `drawing`: by what the frames are drawn. Throws as validate() does.
    explicit PredictiveLaw(const PredictiveOptions& options = {}, Drawing drawing = Drawing::opengl);
    PredictiveLaw(const PredictiveLaw&) = delete;  // its two halves refer to its aim

    void observe(const FrameSample& sample) override;
    Decision decide(const FrameRequest& request) override;
    const Status& status() const override { return aim_.status; }

private:
    Aim aim_;
    ForecastLaw by_forecast_;
    AxisLaw by_axis_{aim_};
    bool has_forecast_ = false;  // of the newest decision
    std::int64_t decisions_ = 0;
};

}  // namespace sfsm
