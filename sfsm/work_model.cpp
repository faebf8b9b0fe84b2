#include "sfsm/work_model.h"

#include <cmath>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double frame_share = 0.05;  // of the first frame's pieces, for what is there in every frame
constexpr double frame_spread = 1;    // of that belief, as WorkPrior::spread
constexpr std::array<double, drawings> slow_piece_ms = {30e-6, 20e-6};  // by Drawing
static_assert(1 + work_kinds <= most_terms);

PriceBelief belief_of(Drawing drawing) {
    PriceBelief all;
    all.terms = 1 + static_cast<int>(work_kinds);
    all.spread[0] = frame_spread;
    for (std::size_t i = 0; i < work_kinds; ++i) {
        const WorkPrior& prior = work_table[i].prior(drawing);
        all.spread[i + 1] = prior.spread;
        all.least[i + 1] = prior.least;
    }
    return all;
}

}  // namespace

WorkModel::WorkModel(Drawing drawing) : drawing_(drawing), costs_(belief_of(drawing)) {}

// Of each kind, in pieces.
Amounts WorkModel::amounts_from(const std::array<double, work_kinds>& counts) const {
    Amounts amounts;
    amounts.terms = 1 + static_cast<int>(work_kinds);
    amounts.of[0] = frame_amount_;
    for (std::size_t i = 0; i < work_kinds; ++i) amounts.of[i + 1] = work_table[i].prior(drawing_).pieces * counts[i];
    return amounts;
}

Amounts WorkModel::amounts_of(const Plan& plan) const {
    return amounts_from(plan.counts);
}

Amounts WorkModel::amounts_of(const Work& work) const {
    std::array<double, work_kinds> counts;
    for (std::size_t i = 0; i < work_kinds; ++i) counts[i] = counted(work.counts[i]);
    return amounts_from(counts);
}

void WorkModel::observe(const FrameSample& sample, double target_ms) {
    if (frame_amount_ == 0) {
        double pieces = 0;
        for (const double amount : amounts_of(sample.work).of) pieces += amount;
        frame_amount_ = frame_share * pieces;
    }
    const Amounts amounts = amounts_of(sample.work);
    if (costs_.is_ready()) foresight_.observe(sample, amounts, costs_);
    refresh_.observe(costs_, amounts, {sample.ms, sample.ms}, target_ms);
}

void WorkModel::foresee(std::int64_t frame, const Decision& decision, const Plan& plan) {
    foresight_.foresee(frame, decision, amounts_of(plan));
}

Prediction WorkModel::predict(const Plan& plan) const {
    Prediction prediction = costs_.predict(foresight_.corrected(amounts_of(plan)));
    prediction.log_ms += foresight_.bias();
    return prediction;
}

Prices WorkModel::prices() const {
    const double gain = costs_.gain();
    Prices prices;
    prices.frame = gain * costs_.price(0) * frame_amount_;
    for (std::size_t i = 0; i < work_kinds; ++i)
        prices.each[i] = gain * costs_.price(static_cast<int>(i) + 1) * work_table[i].prior(drawing_).pieces;
    return prices;
}

Prices WorkModel::price_sigmas() const {
    const std::array<double, most_terms> sigmas = costs_.cost_sigmas();
    Prices of_prices;
    of_prices.frame = sigmas[0] * frame_amount_;
    for (std::size_t i = 0; i < work_kinds; ++i)
        of_prices.each[i] = sigmas[i + 1] * work_table[i].prior(drawing_).pieces;
    return of_prices;
}

Prices WorkModel::foreseen_prices() const {
    Prices foreseen = std::exp(foresight_.bias()) * prices();
    for (std::size_t i = 0; i < work_kinds; ++i) foreseen.each[i] *= foresight_.factor(static_cast<int>(i) + 1);
    return foreseen;
}

Prices prices_of_a_slow_machine(Drawing drawing) {
    Prices prices;
    for (std::size_t i = 0; i < work_kinds; ++i)
        prices.each[i] = slow_piece_ms[index_of(drawing)] * work_table[i].prior(drawing).pieces;
    return prices;
}

}  // namespace sfsm
