#include "sfsm/cost_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

constexpr double first_noise = 0.05;                     // relative
constexpr double least_noise = 0.001, most_noise = 0.3;  // relative
constexpr double slowest_noise = 0.015;                  // [share] that the estimate of noise moves by per sample
constexpr double huber = 3;                              // [sigmas] from which a time is an outlier
constexpr double small_step = 0.05;                      // [ln] a residual that needs no further turn
constexpr int most_turns = 6;
constexpr double well_known = 0.5;     // [sigmas of noise] uncertainty below which a frame tells of the tail
constexpr double heaviest = 2;         // [normal tails] no heavier one hides a shift
constexpr int gain_life = 4096;        // [samples] after which the gain becomes the prices' own
constexpr double gain_memory = 60;     // [samples] that the gain is averaged over
constexpr double price_walk = 0.0003;  // [share of price and spread] a price may drift per sample
constexpr double least_walker = 0.02;  // [first guess] a cheaper price drifts as if it cost this much
constexpr double most_price = 1e4, least_fixed = 1e-4;  // [first guess]
constexpr double disagreement = 8;                      // [sigmas of noise] two times this far apart are outliers
constexpr double likeness = 2;                          // [sigmas] within which a gain is the one before the last shift
constexpr double most_recall = 0.1;                     // [ln] and within which it must be, however large a sigma is
constexpr double recall_worth = 16;                     // [frames] the gain before counts like so many new frames
constexpr double most_log_gain = 60;
constexpr double strangely_off = 3;  // ln of 20
constexpr double known = 0.5;        // [ln] uncertainty from which on no time is strange
constexpr int most_strange = 8;      // [times] strange in a row; from then on they are what frames take now
constexpr double least_log_ms = -40, most_log_ms = 40;
// The median of |a - b| of two normal numbers of spread 1.
constexpr double median_difference = 0.9539;

// The most there can be is what a law without a forecast has: the loop of it is unrolled.
template <std::size_t most>
double dot(const std::array<double, most>& a, const std::array<double, most>& b, int n) {
    double sum = 0;
    if (n == static_cast<int>(most)) {
        for (std::size_t i = 0; i < most; ++i) sum += a[i] * b[i];
        return sum;
    }
    for (int i = 0; i < n; ++i) sum += a[i] * b[i];
    return sum;
}

}  // namespace

CostModel::CostModel(const PriceBelief& belief) : belief_(belief), states_(belief.terms + 1), noise_(first_noise) {
    assert(belief.terms >= 1 && belief.terms <= most_terms);
    believe();
}

void CostModel::believe() {
    for (int i = 1; i < states_; ++i) {
        double correlation = 1;
        for (int j = i; j < states_; ++j) {
            spread_[j][i] = spread_[i][j] = correlation * belief_.spread[i - 1] * belief_.spread[j - 1];
            correlation *= i == 1 ? 0 : belief_.likeness;
        }
    }
}

void CostModel::relearn(const Amounts& amounts, double ms) {
    start(amounts, ms);
    for (Vector& row : spread_) row.fill(0);
    believe();
    detector_.clear();
    left_variance_ = -1;
}

void CostModel::nudge(double log_gain) {
    state_[0] += log_gain;
    limit();
}

void CostModel::start(const Amounts& amounts, double ms) {
    state_.fill(1);
    state_[0] = 0;
    log_scale_ = std::log(ms) - std::log(std::accumulate(amounts.of.begin(), amounts.of.begin() + amounts.terms, 0.0));
    scale_ = std::exp(log_scale_);
}

void CostModel::observe(const Amounts& amounts, double ms) {
    const Seen seen{amounts, std::clamp(std::log(ms), least_log_ms, most_log_ms)};
    if (is_ready() && is_strange(seen)) {
        if (++strange_ < most_strange) return;
    } else {
        strange_ = 0;
    }
    if (samples_ == 0) start(amounts, ms);
    if (samples_ == 1) {
        // Of two first times the shorter is the better guess.
        if (seen.log_ms < log_ms(amounts)) start(amounts, ms);
    }
    recent_[static_cast<std::size_t>(samples_ % ShiftDetector::window)] = seen;
    if (++samples_ % gain_life == 0) fold_gain();
    forget();
    learn_noise(seen);
    const int shown = detector_.add(surprise(correct(seen)));
    if (shown > 0) take_shift(shown);
}

bool CostModel::is_strange(const Seen& seen) const {
    return std::abs(seen.log_ms - log_ms(seen.amounts)) > strangely_off && predict(seen.amounts).uncertainty < known;
}

double CostModel::cost_of(const Amounts& amounts) const {
    double sum = 0;
    for (int i = 0; i < belief_.terms; ++i) sum += state_[i + 1] * amounts.of[i];
    return sum;
}

double CostModel::log_time(const Amounts& amounts, Vector& gradient) const {
    const double sum = cost_of(amounts);
    gradient[0] = 1;
    for (int i = 0; i < belief_.terms; ++i) gradient[i + 1] = amounts.of[i] / sum;
    return log_scale_ + state_[0] + std::log(sum);
}

// One step of the filter. Returns the residual in units of its standard deviation. The time is not linear in what is
// estimated, so a large step is taken again from where it led, until it changes little.
double CostModel::correct(const Seen& seen) {
    const Vector before = state_;
    Vector gradient, covariance;
    double standardised = 0, weight = 1, variance = 1;
    for (int turn = 0; turn < most_turns; ++turn) {
        const double log_ms = log_time(seen.amounts, gradient);
        double expected = log_ms;  // of the state before, on the tangent here
        for (int i = 0; i < states_; ++i) {
            expected += gradient[i] * (before[i] - state_[i]);
            covariance[i] = dot(spread_[i], gradient, states_);
        }
        variance = dot(covariance, gradient, states_) + mean_noise() * mean_noise();
        const double residual = seen.log_ms - expected;
        if (turn == 0) {
            standardised = residual / std::sqrt(variance);
            weight = std::abs(standardised) > huber ? huber / std::abs(standardised) : 1;
        }
        for (int i = 0; i < states_; ++i) state_[i] = before[i] + weight * residual * covariance[i] / variance;
        limit();
        if (std::abs(residual) < small_step || weight < 1) break;
    }
    for (int i = 0; i < states_; ++i) {
        for (int j = 0; j < states_; ++j) spread_[i][j] -= weight * covariance[i] / variance * covariance[j];
    }
    return standardised;
}

// Two slow frames in a row would be a shift, were the noise normal. Of a heavy tail they come by chance, so they are
// measured by the tail: up to a point, since a model that is wrong looks like a tail, too.
double CostModel::surprise(double standardised) const {
    if (standardised <= 0) return standardised;
    return standardised / std::clamp(tail() / (Tail::normal * mean_noise()), 1.0, heaviest);
}

// A price below its least is moved up to it. The prices that are correlated with it move along: else part of the time
// would be explained by nothing.
void CostModel::limit() {
    state_[0] = std::clamp(state_[0], -most_log_gain, most_log_gain);
    const auto least = [this](int i) { return std::max(belief_.least[i - 1], i == 1 ? least_fixed : 0.0); };
    for (int pass = 0; pass < belief_.terms; ++pass) {
        int worst = 0;
        double farthest = 0;  // standard deviations, squared
        for (int i = 1; i < states_; ++i) {
            const double lack = least(i) - state_[i];
            if (lack <= 0 || lack * lack <= farthest * spread_[i][i]) continue;
            worst = i;
            farthest = lack * lack / spread_[i][i];
        }
        if (worst == 0 || !std::isfinite(farthest)) break;
        const double step = (least(worst) - state_[worst]) / spread_[worst][worst];
        for (int i = 1; i < states_; ++i) state_[i] += spread_[i][worst] * step;
        state_[worst] = least(worst);
    }
    for (int i = 1; i < states_; ++i) state_[i] = std::clamp(state_[i], least(i), most_price);
}

void CostModel::forget() {
    const double walk = noise() / gain_memory;
    spread_[0][0] += walk * walk;
    for (int i = 1; i < states_; ++i) {
        const double believed = belief_.spread[i - 1];
        const double step = price_walk * believed * std::max(state_[i], least_walker);
        if (spread_[i][i] < believed * believed) spread_[i][i] += step * step;
    }
}

// Times tell only gain times price, so what is learned of one over time the other may take back, each going its way for
// ever. The same times are predicted, with the same uncertainty, by a gain of 1 and prices that have taken it over.
void CostModel::fold_gain() {
    const double gain = std::exp(state_[0]);
    for (int i = 1; i < states_; ++i) {
        state_[i] *= gain;
        for (int j = 0; j < states_; ++j) {
            spread_[i][j] *= gain;
            spread_[j][i] *= gain;
        }
    }
    left_log_gain_ -= state_[0];
    state_[0] = 0;
}

// Moves the noise a step towards the median difference between neighbours. The step doesn't depend on the difference,
// so outliers don't count. Nor do frames whose time was not known well; for the tail it has to be known better still,
// since a price that is wrong looks like one.
void CostModel::learn_noise(const Seen& seen) {
    const Prediction prediction = predict(seen.amounts);
    if (prediction.uncertainty > mean_noise()) return;
    const double residual = seen.log_ms - prediction.log_ms;
    const double change = residual - last_residual_, difference = std::abs(change);
    last_residual_ = residual;
    if (prediction.uncertainty < well_known * mean_noise()) tail_.add(residual, noise());
    if (residuals_++ == 0) return;
    memory_.add(change, noise_);
    const double step = 1 + std::max(slowest_noise, 1.0 / residuals_);
    residuals_ = std::min(residuals_, 1000);
    noise_ = difference > median_difference * noise_ ? noise_ * step : noise_ / step;
    noise_ = std::clamp(noise_, least_noise, most_noise);
}

// The newest `count` times tell of another level: the gain is forgotten and they are heard again. But two times that
// tell of two different levels are two outliers.
void CostModel::take_shift(int count) {
    const auto newest = [&](int i) -> const Seen& {
        return recent_[static_cast<std::size_t>((samples_ - i) % ShiftDetector::window)];
    };
    double least = most_log_ms, most = 0;
    for (int i = 1; i <= count; ++i) {
        const double residual = std::abs(newest(i).log_ms - log_ms(newest(i).amounts));
        least = std::min(least, residual);
        most = std::max(most, residual);
    }
    if (count == 2 && most - least > disagreement * mean_noise()) return;
    detector_.clear();
    ++shifts_;
    const double log_gain = state_[0], variance = spread_[0][0];
    for (int i = 0; i < states_; ++i) spread_[0][i] = spread_[i][0] = 0;
    spread_[0][0] = least * least + mean_noise() * mean_noise();
    for (int i = count; i >= 1; --i) correct(newest(i));
    if (left_variance_ >= 0) recall(left_log_gain_, left_variance_);
    left_log_gain_ = log_gain;
    left_variance_ = variance;
}

// Loads often come back. A gain that is like the one before the last shift is taken for that one.
void CostModel::recall(double log_gain, double variance) {
    const double likely = likeness * std::sqrt(spread_[0][0] + variance);
    if (std::abs(state_[0] - log_gain) > std::min(likely, most_recall)) return;
    const double residual = log_gain - state_[0];
    const double total = spread_[0][0] + variance + mean_noise() * mean_noise() / recall_worth;
    Vector covariance = spread_[0];
    for (int i = 0; i < states_; ++i) {
        state_[i] += covariance[i] / total * residual;
        for (int j = 0; j < states_; ++j) spread_[i][j] -= covariance[i] / total * covariance[j];
    }
    limit();
}

Prediction CostModel::predict(const Amounts& amounts) const {
    Prediction prediction;
    Vector gradient;
    prediction.log_ms = log_time(amounts, gradient);
    double variance = 0;
    for (int i = 0; i < states_; ++i) variance += gradient[i] * dot(spread_[i], gradient, states_);
    prediction.uncertainty = std::sqrt(std::max(variance, 0.0));
    return prediction;
}

double CostModel::log_ms(const Amounts& amounts) const {
    return log_scale_ + state_[0] + std::log(cost_of(amounts));
}

double CostModel::gain() const {
    return std::exp(state_[0]);
}

double CostModel::price(int term) const {
    return scale_ * state_[term + 1];
}

std::array<double, most_terms> CostModel::cost_sigmas() const {
    std::array<double, most_terms> sigmas{};
    const double scale = std::exp(log_scale_ + state_[0]);
    for (int i = 0; i < belief_.terms; ++i) {
        const double price = state_[i + 1];
        const double variance = price * price * spread_[0][0] + 2 * price * spread_[0][i + 1] + spread_[i + 1][i + 1];
        sigmas[i] = scale * std::sqrt(std::max(variance, 0.0));
    }
    return sigmas;
}

double CostModel::price_uncertainty(int term) const {
    return scale_ * std::sqrt(std::max(spread_[term + 1][term + 1], 0.0));
}

}  // namespace sfsm
