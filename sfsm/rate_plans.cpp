#include "sfsm/rate_plans.h"

#include <algorithm>
#include <cmath>

#include "sfsm/between.h"
#include "sfsm/least_loss.h"
#include "sfsm/pair_plans.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double coarser_lesson = 4;   // times the rate of the first frame drawn to learn what points cost
constexpr int most_rounds = 6;         // to find the place that fills a budget
constexpr double close_enough = 1e-3;  // of the budget that may stay unused there

// Straight in logarithms; straight where a kind begins; where one ends, straight in logarithms of one more.
double count_between(double from, double to, double share) {
    if (from == to) return to;
    return to > 0 ? power_between(from, to, share) : power_between(1 + from, 1, share) - 1;
}

}  // namespace

// --- Places.

std::array<double, work_kinds> RatePlans::counts_at(const Place& place) const {
    const RateStep& b = forecast_.rates[place.at];
    const RateStep& a = place.share < 1 ? forecast_.rates[place.at - 1] : b;
    std::array<double, work_kinds> counts;
    for (const WorkEntry& entry : work_table) {
        const Work& frame = forecast_.frame;
        counts[index_of(entry.kind)] =
            entry.axis == WorkAxis::frame
                ? counted(frame[entry.kind])
                : count_between(counted(a.work[entry.kind]), counted(b.work[entry.kind]), place.share);
    }
    return counts;
}

double RatePlans::loss_at(const Place& place) const {
    const double b = forecast_.rates[place.at].loss;
    const double a = place.share < 1 ? forecast_.rates[place.at - 1].loss : b;
    return between(a, b, place.share) / flip_of_a_pixel;
}

Plan RatePlans::plan_of(const Place& place) const {
    const RateStep& b = forecast_.rates[place.at];
    const RateStep& a = place.share < 1 ? forecast_.rates[place.at - 1] : b;
    Plan plan;
    plan.state = b.state;
    plan.distance = between(std::min(range_, a.motion_distance), std::min(range_, b.motion_distance), place.share);
    plan.size = power_between(a.splat_size > 0 ? a.splat_size : b.splat_size, b.splat_size, place.share);
    plan.rate = power_between(a.rate, b.rate, place.share);
    plan.counts = counts_at(place);
    plan.loss = loss_at(place);
    return plan;
}

// Nothing is between the step and the one before.
bool RatePlans::is_leap(std::size_t at) const {
    return at > 0 && forecast_.rates[at].rate < least_rise * forecast_.rates[at - 1].rate;
}

// What its D and S alone would lose.
double RatePlans::lost_px(std::size_t step) const {
    const Decision decision = decision_of(plan_of({step, 1}));
    const double distance = std::min(decision.motion_distance, range_);
    return plan_at(forecast_, range_, distance, decision.splat_size).loss;
}

RatePlans::Place RatePlans::place_at_rate(double rate) const {
    const auto& rates = forecast_.rates;
    std::size_t at = 0;
    while (at + 1 < rates.size() && rates[at].rate < rate) ++at;
    if (at == 0 || !(rates[at].rate > rate && rates[at - 1].rate > 0)) return {at, 1};
    if (is_leap(at)) return {at - 1, 1};
    const double before = rates[at - 1].rate;
    return {at, std::clamp(std::log(rate / before) / std::log(rates[at].rate / before), 0.0, 1.0)};
}

RatePlans::Place RatePlans::place_at_px(double px) const {
    double before = 0;
    for (std::size_t at = 0; at < forecast_.rates.size(); ++at) {
        const double here = lost_px(at);
        if (here >= px)
            return {at, at > 0 && here > before && !is_leap(at) ? std::clamp((px - before) / (here - before), 0.0, 1.0)
                                                                : 1};
        before = here;
    }
    return {forecast_.rates.size() - 1, 1};
}

Plan RatePlans::at(const Decision& decision) const {
    if (decision.rate > 0) return plan_of(place_at_rate(decision.rate));
    return plan_of(place_at_px(PairPlans(forecast_, range_).at(decision).loss));
}

Decision RatePlans::renewed(const Decision& decision) const {
    Decision same = decision_of(at(decision));
    if (decision.rate > 0) same.rate = decision.rate;  // to the bit
    return same;
}

Decision RatePlans::decision_of(const Plan& plan) const {
    return sfsm::decision_of(plan, range_);
}

// --- What fits a time.

double RatePlans::step_ms(std::size_t step, const Prices& prices) const {
    double ms = prices.frame;
    for (const WorkEntry& entry : work_table) {
        const Work& work = entry.axis == WorkAxis::frame ? forecast_.frame : forecast_.rates[step].work;
        ms += prices[entry.kind] * counted(work[entry.kind]);
    }
    return ms;
}

RatePlans::Place RatePlans::cheapest_place(const Prices& prices) const {
    Place place{0, 1};
    double least_ms = step_ms(0, prices);
    for (std::size_t i = 1; i < forecast_.rates.size(); ++i) {
        const double ms = step_ms(i, prices);
        if (!is_cheaper(ms, least_ms)) continue;
        place.at = i;
        least_ms = ms;
    }
    return place;
}

RatePlans::Place RatePlans::fitting_place(const Prices& prices, double budget_ms) const {
    double before_ms = 0;
    for (std::size_t i = 0; i < forecast_.rates.size(); ++i) {
        const double ms = step_ms(i, prices);
        if (ms <= budget_ms)
            return i == 0 || is_leap(i) ? Place{i, 1} : filling_place(i, before_ms, ms, prices, budget_ms);
        before_ms = ms;
    }
    return cheapest_place(prices);
}

// Between a step that is too slow and the next, which fits. Time is convex in the share, as each count is: a chord from
// a place that is too slow to one that fits meets the budget at one that fits too.
RatePlans::Place RatePlans::filling_place(std::size_t at, double before_ms, double ms, const Prices& prices,
                                          double budget_ms) const {
    const auto ms_at = [&](double share) {
        Plan plan;
        plan.counts = counts_at({at, share});
        return plan_ms(plan, prices);
    };
    double slow = 0, slow_ms = before_ms, share = 1;
    for (int i = 0; i < most_rounds && ms < budget_ms * (1 - close_enough); ++i) {
        share = slow + (share - slow) * (slow_ms - budget_ms) / (slow_ms - ms);
        ms = ms_at(share);
        const double middle = (slow + share) / 2, middle_ms = ms_at(middle);
        if (middle_ms <= budget_ms) {
            share = middle;
            ms = middle_ms;
        } else {
            slow = middle;
            slow_ms = middle_ms;
        }
    }
    return {at, share};
}

// The cheapest place from there on that loses as little.
RatePlans::Place RatePlans::cheapest_alike(Place place, const Prices& prices) const {
    const double loss = loss_at(place);
    double least_ms = plan_ms(plan_of(place), prices);
    for (std::size_t i = place.at; i < forecast_.rates.size() && loss_at({i, 1}) <= loss; ++i) {
        const double ms = step_ms(i, prices);
        if (!is_cheaper(ms, least_ms)) continue;
        place = {i, 1};
        least_ms = ms;
    }
    return place;
}

Plan RatePlans::cheapest(const Prices& prices) const {
    return plan_of(cheapest_place(prices));
}

Plan RatePlans::least_loss(const Prices& prices, double budget_ms) const {
    return plan_of(cheapest_alike(fitting_place(prices, budget_ms), prices));
}

Plan RatePlans::worthwhile(const Prices& prices, double budget_ms) const {
    Plan best = least_loss(prices, budget_ms);
    double least = ms_of_detail(best, plan_ms(best, prices));
    for (std::size_t i = 0; i < forecast_.rates.size(); ++i) {
        const double ms = step_ms(i, prices);
        if (ms > budget_ms || !is_cheaper(ms * (1 + loss_at({i, 1})), least)) continue;
        best = plan_of({i, 1});
        least = ms_of_detail(best, ms);
    }
    return best;
}

// Of a loss that is hardly seen, a tenth is not worth a change of the picture.
bool RatePlans::is_better(const Plan& plan, const Plan& than, double share) const {
    return 1 + plan.loss < (1 + than.loss) * (1 - share);
}

// A place may be foreseen to draw a little of a kind that it never draws, as where the last triangles go between two
// steps. Their price stays unknown, but not what the frame takes.
Prediction RatePlans::once_drawn(const Prediction& prediction, double noise) const {
    return {prediction.log_ms, std::min(prediction.uncertainty, noise)};
}

// --- What can be learned.

// The step of a higher rate with the most points; the list's size where none has any.
std::size_t RatePlans::step_of_most_points(double rate) const {
    std::size_t found = forecast_.rates.size();
    std::int64_t most = 0;
    for (std::size_t i = 0; i < forecast_.rates.size(); ++i) {
        const RateStep& step = forecast_.rates[i];
        if (!(step.rate > rate && step.work[WorkKind::point] > most)) continue;
        found = i;
        most = step.work[WorkKind::point];
    }
    return found;
}

// How much people move comes with the rate: it can't be drawn alone.
std::optional<Plan> RatePlans::needed(Lesson lesson, const Plan& now, const Plan& cheapest) const {
    if (lesson == Lesson::motion || step_of_most_points(now.rate) == forecast_.rates.size()) return {};
    return cheapest;
}

// The most points there are on the way down, then fewer: two amounts tell points from what every frame has.
Plan RatePlans::lesson(Lesson, const Plan& now, int drawn) const {
    const std::size_t step = step_of_most_points(now.rate);
    if (drawn == 0) return plan_of({step, 1});
    return plan_of(place_at_rate(coarser_lesson * forecast_.rates[step].rate));
}

}  // namespace sfsm
