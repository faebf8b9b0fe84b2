// The predictive law where no forecast is at hand: it learns what the one axis of decisions (detail.h) costs, and turns
// to the detail that is predicted to meet the aim.
#pragma once

#include <array>
#include <cstddef>

#include "sfsm/aim.h"
#include "sfsm/ceiling.h"
#include "sfsm/drift.h"
#include "sfsm/refresh.h"
#include "sfsm/retest.h"

namespace sfsm {

class AxisLaw {
public:
    explicit AxisLaw(Aim& aim);  // the aim must outlive the law

    // A frame with a usable time. Ignored while there is no range.
    void observe(const FrameSample& sample);

    // Puts decision number `frame`, counted from 0, into the aim's status; its target and range are usable.
    void decide(std::int64_t frame);

    // Another target: what was too dear for the old one may be tried again.
    void retarget() { ceiling_.forget(); }

private:
    static constexpr int longest_reach_wait = 256;  // [decisions] between tests of less detail out of reach

    struct Drawn {
        Decision decision;
        double detail = 1;
        bool is_retest = false;
    };

    struct Heard {
        std::int64_t frame = 0;
        double ms = 0;  // 0: none yet
        Amounts amounts;
        double log_load = 0;  // of the frame, over the first one's
    };

    void turn();
    void follow(std::int64_t frame);
    double ms_of_known_load(const FrameSample& sample, const Amounts& amounts, double detail);
    Drawn next_drawn(bool is_given_up);
    void hear_retest(const Amounts& amounts, double ms);
    double sure_detail(double wanted, double least_ms) const;
    void turn_to(double detail, double now_ms, double aim_ms);
    void turn_out_of_reach(double detail, double over_aim);
    double log_over_model(const Heard& heard) const;
    bool is_following() const;
    bool is_out_of_reach() const;
    double predicted_ms(double detail) const;
    double detail_for(double ms) const;
    Drawn drawn_as(const Decision& decision) const;
    void remember(const Drawn& drawn);
    void tell() const;

    Aim& aim_;
    CostModel costs_;  // term 0: what every frame has; then one a step of detail
    Refresh refresh_;
    Ceiling ceiling_;
    Drift drift_;
    Heard newest_;
    Retest reach_retest_{longest_reach_wait}, cap_retest_{longest_cap_wait};
    double detail_ = 1;
    std::array<Drawn, 16> drawn_{};  // the newest decisions; L may have moved since, so each with its detail
    std::size_t drawn_count_ = 0;
};

}  // namespace sfsm
