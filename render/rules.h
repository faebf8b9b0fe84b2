// What laws decide, as rules: by D and S, alike for everybody, or by the rate.
#pragma once

#include <span>

#include "render/drawing_rule.h"
#include "render/error_bounds.h"
#include "render/forecaster.h"
#include "render/rate_forecaster.h"
#include "sfsm/decision.h"

namespace render {

// Lyu et al. 2018: beyond D people move less often (eq. 1), and points are S pixels.
class KnobRule final : public DrawingRule {
public:
    // Both must outlive it. `theta`: SelectOptions'.
    KnobRule(const sfsm::Decision& decision, const Forecaster& forecaster, float theta)
        : decision_(decision), forecaster_(forecaster), theta_(theta) {}

    Shape shape_of(const Subject& subject) const override;
    bool is_splat(const Subject& subject) const override;
    int period_of(const Subject& subject) const override;
    double splat_size() const override { return decision_.splat_size; }

private:
    const sfsm::Decision& decision_;
    const Forecaster& forecaster_;
    float theta_;
};

// Everybody as the exchange has it at the rate (exchange.h).
class RateRule final : public DrawingRule {
public:
    explicit RateRule(const RateForecaster& forecaster) : forecaster_(forecaster) {}

    // Of the frame that the forecaster knows; `density`: points a splat-sized square where points have a size.
    void decide(double rate, float density);

    Shape shape_of(const Subject& subject) const override;
    bool is_splat(const Subject& subject) const override;
    int period_of(const Subject& subject) const override;
    double splat_size() const override { return splat_size_; }

private:
    const RateForecaster& forecaster_;
    Exchange::Terms terms_;
    Paces paces_;
    double splat_size_ = 1;
};

}  // namespace render
