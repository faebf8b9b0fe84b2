#include "render/rules.h"

#include <algorithm>
#include <cmath>

#include "figures/points.h"
#include "motion/schedule.h"

namespace render {

DrawingRule::Shape KnobRule::shape_of(const Subject& subject) const {
    const figures::Choices& choices = forecaster_.choices(subject.character);
    const auto splat_area = static_cast<float>(decision_.splat_size * decision_.splat_size);
    if (!(splat_area > 0)) return {choices.exact(), 0.0f};
    return {choices.at(subject.demand / splat_area), subject.demand / splat_area};
}

bool KnobRule::is_splat(const Subject& subject) const {
    return decision_.splat_size > 0 &&
           forecaster_.serves_block(subject.character, subject.demand, decision_.splat_size);
}

int KnobRule::period_of(const Subject& subject) const {
    if (decision_.state == sfsm::State::original) return 1;
    return motion::update_period(subject.depth, static_cast<float>(decision_.motion_distance), theta_);
}

void RateRule::decide(double rate, float density) {
    const std::size_t cell = forecaster_.cell_of(rate);
    forecaster_.exchange().find_terms(rate, cell, terms_);
    forecaster_.find_paces(rate, paces_);
    splat_size_ = std::min(forecaster_.has_cells() ? static_cast<double>(terms_.cell) / figures::cell_share
                                                   : std::sqrt(static_cast<double>(density)) * terms_.spacing,
                           sfsm::max_splat_size);
}

DrawingRule::Shape RateRule::shape_of(const Subject& subject) const {
    const figures::Choices& choices = forecaster_.choices(subject.character);
    const Exchange::Terms::Sizes sizes = terms_.sizes(subject.character, subject.place);
    const float least = forecaster_.least_samples(subject.character, subject.allowed);
    const float samples = std::max(subject.surface / (sizes.spacing * sizes.spacing), least);
    const bool is_mesh = !(subject.surface < sizes.mesh_from) || least > choices.most_samples();
    return {is_mesh ? choices.exact() : choices.samples_at(samples), samples};
}

bool RateRule::is_splat(const Subject& subject) const {
    return subject.surface <= terms_.sizes(subject.character, subject.place).splat_to &&
           forecaster_.may_be_splat(subject.character, subject.allowed);
}

// A class' period, unless that is too long for somebody.
int RateRule::period_of(const Subject& subject) const {
    const int wanted = paces_.period(subject.character, subject.role, subject.pixels_per_metre);
    if (wanted == 1 || !std::isfinite(subject.allowed)) return wanted;
    const MotionBounds& bounds = forecaster_.bounds(subject.character).motion;
    const MotionBound& bound = (subject.is_block ? bounds.far : bounds.single)[static_cast<std::size_t>(subject.role)];
    int best = 1;
    for (const int period : paced_periods)
        if (period <= wanted && bound[static_cast<std::size_t>(period)] <= subject.allowed) best = period;
    return best;
}

}  // namespace render
