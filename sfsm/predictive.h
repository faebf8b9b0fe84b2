// The default law: it learns what work costs and draws the finest frame that is predicted to meet the target. With a
// forecast it answers a camera cut, a new target or a crowd pouring in within the frame they happen; without one it
// learns what the one axis of decisions (detail.h) costs. docs/controller.md tells the story.
#pragma once

#include <array>

#include "sfsm/ceiling.h"
#include "sfsm/controller.h"
#include "sfsm/cost_model.h"
#include "sfsm/foresight.h"
#include "sfsm/least_loss.h"
#include "sfsm/refresh.h"

namespace sfsm {

struct PredictiveOptions {
    double headroom = 0.25;         // frames are aimed at t less so many sigmas of a single frame's noise, [0, 3]
    double most_headroom = 0.0075;  // but at no less than (1 - this) t, [0, 0.5]
    double caution = 0.25;          // and lower by so many sigmas of what is not known of the decision, [0, 3]
    int probes = 2;                 // single frames spent on learning what motion costs, and as many on points, >= 0
    double band = 0.006;            // a decision is kept while predicted so near to its aim, relative, [0, 0.2]
    double band_sigmas = 2.6;       // or so many sigmas of the prediction, [0, 6]
    double worthwhile = 0.25;       // out of reach, detail is kept while it costs no more of the miss, [0, 1]
    double better = 0.1;            // share of loss for which another decision of equal time is taken, [0, 1]

    // Throws std::invalid_argument naming the first broken rule.
    void validate() const;
};

class PredictiveLaw final : public Controller {
public:
    explicit PredictiveLaw(const PredictiveOptions& options = {});  // throws as validate() does

    void observe(const FrameSample& sample) override;
    Decision decide(const FrameRequest& request) override;
    const Status& status() const override { return status_; }

private:
    struct Drawn {
        Decision decision;
        double detail = 1;
    };

    // A frame drawn to learn from, while the target is met and the price of motion or of points is unknown.
    struct Probe {
        int motion = 0, splats = 0;  // drawn so far
        Decision decision;
        int age = 0;  // decisions since; 0: none is on its way
    };

    void decide_on_axis();
    void turn_axis();
    void turn_to(double detail, double now_ms);
    void turn_out_of_reach(double detail, double over_aim);
    double axis_ms(double detail) const;
    void decide_from(const Forecast& forecast);
    double detail_for(double ms) const;
    double drawn_detail(const Decision& decision) const;
    Amounts amounts_of(const std::array<double, work_kinds>& counts) const;
    Decision decision_of(const Plan& plan) const;
    Plan plan_of(const Forecast& forecast, const Decision& decision) const;
    void choose(const Forecast& forecast);
    void probe(const Forecast& forecast);
    bool is_doubtful(const Plan& plan) const;
    Prediction predicted(const Plan& plan) const;
    Prices prices() const;
    bool is_kept(const Prediction& prediction, double aim_ms) const;
    double aim(const CostModel& model, double least_ms, double uncertainty) const;
    void believe(const Prediction& prediction, const CostModel& model);
    void believe_prices();
    Plan surely_fitting(const Forecast& forecast, const Prices& prices, const Plan& best, double least_ms,
                        double aim_ms) const;
    Plan first_guess(const Forecast& forecast) const;
    const char* reason_to_move(const Prediction& kept, double aim_ms, double least_ms) const;

    PredictiveOptions options_;
    Status status_;
    CostModel work_;           // terms: frame, then the kinds of work
    CostModel axis_;           // terms: frame, steps of detail
    double frame_amount_ = 0;  // of work_'s first term; 0 until work has been seen
    double target_ms_ = 0, range_ = 0;
    bool has_forecast_ = false;
    Foresight foresight_;
    std::int64_t decisions_ = 0;
    Decision kept_;  // with a forecast; what probes come back to
    Probe probe_;
    int since_choice_ = 0;  // decisions since kept_ changed
    double detail_ = 1;
    Ceiling ceiling_;
    Refresh work_refresh_, axis_refresh_;
    std::array<Drawn, 16> drawn_{};  // the newest decisions on the axis (L may have moved since)
    std::size_t drawn_count_ = 0;
};

}  // namespace sfsm
