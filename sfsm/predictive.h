// The default law: it learns what frames cost and draws the finest one that is predicted to meet the target. With a
// forecast it decides by that (by_forecast.h), without one along the one axis of decisions (by_axis.h).
// docs/controller.md tells the story.
#pragma once

#include <optional>

#include "sfsm/aim.h"
#include "sfsm/by_axis.h"
#include "sfsm/by_forecast.h"
#include "sfsm/controller.h"
#include "sfsm/pairing.h"
#include "sfsm/predictive_options.h"

namespace sfsm {

class PredictiveLaw final : public Controller {
public:
    // `drawing`: by what the frames are drawn. Throws as validate() does.
    explicit PredictiveLaw(const PredictiveOptions& options = {}, Drawing drawing = Drawing::opengl);
    PredictiveLaw(const PredictiveLaw&) = delete;  // its two halves refer to its aim

    void observe(const FrameSample& sample) override;
    Decision decide(const FrameRequest& request) override;
    void reset() override;
    const Status& status() const override { return aim_.status; }

private:
    void take(const FrameRequest& request);

    Drawing drawing_;
    Aim aim_;
    std::optional<ForecastLaw> by_forecast_;  // always there; made anew by reset()
    std::optional<AxisLaw> by_axis_;
    Pairing pairing_;
    double given_range_ = 0;     // [m]; 0: none yet
    bool has_forecast_ = false;  // of the newest decision
};

}  // namespace sfsm
