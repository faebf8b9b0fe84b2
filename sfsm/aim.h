// What both ways of the predictive law share (by forecast and by axis): what they are asked for, which time they aim
// at, when a prediction is near enough to it, and what they say of themselves.
#pragma once

#include "sfsm/controller.h"
#include "sfsm/cost_model.h"
#include "sfsm/predictive_options.h"
#include "sfsm/refresh.h"

namespace sfsm {

// Status::reason.
inline constexpr const char* reason_to_guess = "no time is known yet: a guess";
inline constexpr const char* reason_to_test_cap = "frames wait: is less detail still in vain?";

inline constexpr int longest_cap_wait = 2048;  // [decisions] between tests of a cap that is slower than the target

struct Aim {
    PredictiveOptions options;
    double asked_ms = 0;   // the target that was asked for; 0: none yet
    double target_ms = 0;  // what can be had for it: the next refresh that fits, or an outside cap that is slower
    double range = 0;      // L [m]; 0: none yet
    Status status;
    const char* kept_reason = "start";  // Status::reason of what is kept between probes

    // A new decision: until it's said otherwise, what is kept is kept for its reason, and nothing is believed.
    void begin();

    // Another decision is kept from now on.
    void change(const char* reason);

    // Even the coarsest frame, `least_ms`, is slower than wanted.
    bool is_out_of_reach(const CostModel& model, double least_ms) const { return least_ms > wanted_ms(model); }

    // The time [ms] that frames are aimed at: below the target for the noise, and lower by `caution` times the
    // uncertainty. Where even the coarsest frame, `least_ms`, is too slow: as much above it as detail is worth.
    double aim_ms(const CostModel& model, double least_ms, double uncertainty) const;

    // The longest time [ms] that may be predicted for a decision that is known no better, when it is moved to. Less
    // than aim_ms() where it would be a leap in the dark: many times the time of the newest frame.
    double leap_ms(double uncertainty) const;

    // Frames are believed to wait for a cap that is slower than the target.
    bool is_capped(const Refresh& refresh) const;

    // Near enough to the aim to change nothing.
    bool is_kept(const Prediction& prediction, double aim_ms) const;

    // Status::reason for leaving what is predicted so.
    const char* reason_to_move(const Prediction& kept, double aim_ms, double least_ms) const;

    // Shows what frames are known to wait for, and what can be had then.
    void believe_waiting(const Refresh& refresh);

    // Shows what is believed of the next frame.
    void believe(const Prediction& prediction, const CostModel& model);

private:
    // [ms] Below the target for the noise.
    double wanted_ms(const CostModel& model) const;
};

}  // namespace sfsm
