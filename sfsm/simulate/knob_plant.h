// The toy plant of the scorecard and its relatives: one knob u that all decisions are read as, time = load * curve(u).
// It has no forecast and counts no work: what feedback alone can do is measured here.
#pragma once

#include <vector>

#include "sfsm/simulate/plant.h"

namespace sfsm::simulate {

using KnobCurve = double (*)(double u);

inline constexpr double least_knob = 0.05;

// Curves of u in [least_knob, 1], in shares of the nominal time.
double toy_curve(double u);      // 0.3 + 1.2 u
double wavy_curve(double u);     // the toy's and a wave on it that falls as u grows, in three places
double stepped_curve(double u);  // the toy's with u rounded down to eighths, as levels of detail do

struct KnobModel {
    double nominal_ms = 1000.0 / 60;  // what curve and load are shares of
    KnobCurve curve = toy_curve;
    OverFrames load;     // L(k) of controllers.md
    OverFrames cpu_ms;   // a frame takes no less, whatever the knob; empty: 0
    OverFrames range_m;  // L [m]; empty: 200
};

// time(k, u) = max(cpu_ms(k), load(k) * curve(u) * nominal_ms) with u = max(least_knob, detail_of(decision, L)).
class KnobPlant final : public Plant {
public:
    explicit KnobPlant(KnobModel model);

    double range(std::int64_t frame) const override;
    const Forecast* forecast(std::int64_t) const override { return nullptr; }
    double cost_ms(std::int64_t frame, const Decision& decision) const override;
    Work work(std::int64_t, const Decision&) const override { return {}; }
    double detail(std::int64_t frame, const Decision& decision) const override;  // u
    Decision optimum(std::int64_t frame, double limit_ms) const override;

private:
    double finest_knob(double limit) const;

    KnobModel model_;
    std::vector<double> curve_;  // at even steps of u, to search in
    double least_ = 0;           // of them
};

}  // namespace sfsm::simulate
