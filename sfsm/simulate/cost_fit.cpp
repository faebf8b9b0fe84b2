#include "sfsm/simulate/cost_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "sfsm/simulate/least_squares.h"

namespace sfsm::simulate {
namespace {

constexpr std::size_t fewest_frames = 16;
constexpr double far_off = 1000;  // times the median: not a frame of this renderer

// Unknown 0 is the price of what every frame has; then comes one for each kind of work.
constexpr std::size_t frame = 0;
constexpr std::size_t unknown_of(WorkKind kind) {
    return 1 + index_of(kind);
}
constexpr double frame_share = 0.05;  // of a mean frame's pieces, believed of what every frame has
// 1 sigma of the believed price is the price. Where times have no noise at all, the belief decides only what is left
// open: this small, it moves no digit of what they tell.
constexpr double least_belief = 1e-10;
constexpr double level_weight = 0.1;  // of what the kinds of shapes take together: one is a better guess of the others

constexpr double huber = 1.345;             // sigmas; 95 % as good as least squares where all noise is normal
constexpr double sigma_of_median = 1.4826;  // a normal sigma over the median of absolute values
constexpr double least_sigma = 1e-12;
constexpr double least_share = 0.01;   // of the time: a model below that can't scale a residual
constexpr double equal_times = 1e-24;  // a variance of times, relative, that is rounding
constexpr int most_rounds = 60;
constexpr double settled = 1e-13;       // of a price, from one round to the next
constexpr double settled_noise = 1e-6;  // or in shares of the noise

struct Observation {
    Unknowns amounts{};  // at price 1 each takes what is believed of it, in medians of the times
    double time = 0;     // in the same
};

template <class Value>
double median(std::vector<Value> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double dot(const Unknowns& a, const Unknowns& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

bool has_prices(const Unknowns& prices) {
    return *std::max_element(prices.begin(), prices.end()) > 0;
}

double pieces_of(const Observation& seen) {
    double sum = 0;
    for (const double amount : seen.amounts) sum += amount;
    return sum;
}

// Amounts in pieces, times in ms; what every frame has is still nothing.
std::vector<Observation> observations_of(std::span<const TraceRow> rows, Drawing drawing) {
    std::vector<Observation> all;
    std::vector<double> times;
    for (const TraceRow& row : rows) {
        if (!is_frame_time(row.frame_ms)) continue;
        Observation& seen = all.emplace_back();
        for (const WorkEntry& entry : work_table)
            seen.amounts[unknown_of(entry.kind)] = entry.prior(drawing).fit_pieces * counted(row.work[entry.kind]);
        seen.time = row.frame_ms;
        times.push_back(row.frame_ms);
    }
    if (times.empty()) return all;
    const double usual = median(times);
    std::erase_if(all,
                  [=](const Observation& seen) { return seen.time > far_off * usual || seen.time < usual / far_off; });
    return all;
}

// What one unknown at 1 stands for.
struct Units {
    double median_ms = 1;
    double frame_pieces = 0;
    double ms_each = 0;  // of a piece
};

// Turns the observations into those units.
Units scale(std::vector<Observation>& all) {
    std::vector<double> times;
    double pieces = 0;
    for (const Observation& seen : all) {
        times.push_back(seen.time);
        pieces += pieces_of(seen) / static_cast<double>(all.size());
    }
    Units units;
    units.median_ms = median(times);
    units.frame_pieces = frame_share * pieces;
    std::vector<double> ms_each;
    for (Observation& seen : all) {
        seen.amounts[frame] = units.frame_pieces;
        ms_each.push_back(seen.time / pieces_of(seen));
    }
    units.ms_each = median(ms_each);
    for (Observation& seen : all) {
        for (double& amount : seen.amounts) amount *= units.ms_each / units.median_ms;
        seen.time /= units.median_ms;
    }
    return units;
}

// What a row's residual is relative to.
double modelled(const Observation& seen, const Unknowns& prices) {
    return std::max(dot(seen.amounts, prices), least_share * seen.time);
}

double residual(const Observation& seen, const Unknowns& prices) {
    return (seen.time - dot(seen.amounts, prices)) / modelled(seen, prices);
}

std::vector<double> residuals_of(const std::vector<Observation>& all, const Unknowns& prices) {
    std::vector<double> residuals;
    residuals.reserve(all.size());
    for (const Observation& seen : all) residuals.push_back(residual(seen, prices));
    return residuals;
}

double sigma_of(std::vector<double> residuals) {
    for (double& value : residuals) value = std::abs(value);
    return std::max(sigma_of_median * median(std::move(residuals)), least_sigma);
}

// A machine that is slow in one frame is slow in the next: of residuals r that share `likeness` with the one before,
// what is new is r(k) - likeness r(k - 1). Fitting that (Cochrane and Orcutt 1949) keeps a drift from being taken for
// the price of whatever drifted with it.
std::vector<double> news_of(std::vector<double> residuals, double likeness) {
    for (std::size_t i = residuals.size() - 1; i > 0; --i) residuals[i] -= likeness * residuals[i - 1];
    return residuals;
}

// Of neighbours, hitches clipped; 0 where it may be chance.
double likeness_of(std::vector<double> residuals) {
    constexpr double most = 0.95, chance = 3;  // chance: sigmas
    const double clip = 3 * sigma_of(residuals);
    double both = 0, squares = 0, before = 0;
    for (const double value : residuals) {
        const double now = std::clamp(value, -clip, clip);
        both += now * before;
        squares += now * now;
        before = now;
    }
    const double likeness = squares > 0 ? both / squares : 0;
    return likeness * std::sqrt(static_cast<double>(residuals.size())) > chance ? std::min(likeness, most) : 0;
}

// How sure the belief is of each price: 1 over its sigma. A kind whose count hardly changes (people, updates) tells
// nothing that a drift of the machine couldn't tell as well, so there the belief is very sure.
Unknowns sureness_of(const std::vector<Observation>& all, Drawing drawing) {
    constexpr double least_change = 1.5;  // of the 95th percentile over the 5th
    constexpr double sure = 100;
    Unknowns sureness{1};
    for (const WorkEntry& entry : work_table) {
        const std::size_t kind = unknown_of(entry.kind);
        sureness[kind] = 1 / entry.prior(drawing).fit_spread;
        if (entry.axis == WorkAxis::shape) continue;
        std::vector<double> amounts;
        for (const Observation& seen : all) amounts.push_back(seen.amounts[kind]);
        std::sort(amounts.begin(), amounts.end());
        const std::size_t tail = amounts.size() / 20;
        if (amounts[amounts.size() - 1 - tail] < least_change * amounts[tail]) sureness[kind] = sure;
    }
    return sureness;
}

// Each price is 1, give or take 1 over how sure that is. But the kinds of shapes (triangles, points) are rather as dear
// as each other, give or take as much.
void add_belief(LeastSquares& sum, double weight, const Unknowns& prices, const Unknowns& sureness) {
    const auto believe_in_one = [&](std::size_t unknown) {
        Unknowns coefficients{};
        coefficients[unknown] = weight * sureness[unknown];
        sum.add(coefficients, coefficients[unknown]);
    };
    believe_in_one(frame);
    for (const WorkEntry& entry : work_table)
        if (entry.axis != WorkAxis::shape) believe_in_one(unknown_of(entry.kind));

    constexpr auto& shapes = work_on<WorkAxis::shape>;
    double level = 1;
    for (const WorkKind kind : shapes) level = std::max(level, prices[unknown_of(kind)]);
    Unknowns together{};
    for (const WorkKind kind : shapes) {
        together[unknown_of(kind)] = level_weight * weight;
        if (kind == shapes.front()) continue;
        Unknowns difference{};
        difference[unknown_of(shapes.front())] = weight / level;
        difference[unknown_of(kind)] = -weight / level;
        sum.add(difference, 0);
    }
    sum.add(together, static_cast<double>(shapes.size()) * level_weight * weight);
}

// A row's equation, relative to its model.
struct Equation {
    Unknowns coefficients{};
    double value = 0;
};

Equation equation_of(const Observation& seen, const Unknowns& prices) {
    const double model = modelled(seen, prices);
    Equation equation{seen.amounts, seen.time / model};
    for (double& coefficient : equation.coefficients) coefficient /= model;
    return equation;
}

// The equations of one round: what is new in each row, as the last round's prices weigh it, down from `clip` on; and
// those of the belief, for which a frame is off by `noise`.
LeastSquares equations(const std::vector<Observation>& all, const Unknowns& prices, const Unknowns& sureness,
                       double likeness, double clip, double noise) {
    const std::vector<double> news = news_of(residuals_of(all, prices), likeness);
    LeastSquares sum;
    Equation before;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Equation now = equation_of(all[i], prices);
        const double off = std::abs(news[i]), weight = off > clip ? std::sqrt(clip / off) : 1.0;
        Unknowns coefficients = now.coefficients;
        for (std::size_t k = 0; k < coefficients.size(); ++k)
            coefficients[k] = weight * (coefficients[k] - likeness * before.coefficients[k]);
        sum.add(coefficients, weight * (now.value - likeness * before.value));
        before = now;
    }
    add_belief(sum, std::max(noise, least_belief), prices, sureness);
    return sum;
}

struct Solution {
    Unknowns prices{};
    Unknowns sigma{};
};

// Iteratively reweighted least squares from `solution` on. Without prices, in the first round, residuals are relative
// to the times, all weigh the same, and the belief decides only what is left open.
void refine(Solution& solution, const std::vector<Observation>& all, const Unknowns& sureness, double likeness) {
    double sigma = 0, change = 1;
    for (int round = 0; round < most_rounds && change > std::max(settled, settled_noise * sigma); ++round) {
        if (has_prices(solution.prices)) sigma = sigma_of(news_of(residuals_of(all, solution.prices), likeness));
        const double clip = sigma > 0 ? huber * sigma : std::numeric_limits<double>::infinity();
        const LeastSquares sum = equations(all, solution.prices, sureness, likeness, clip, sigma);
        const Unknowns before = solution.prices;
        solution.prices = sum.solve_non_negative();
        const Unknowns variances = sum.variances();
        change = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            solution.sigma[i] = sureness[i] > 1 ? 1 : sigma * std::sqrt(variances[i]);  // believed: a guess
            change = std::max(change, std::abs(solution.prices[i] - before[i]) / (1 + solution.prices[i]));
        }
    }
}

Solution solve(const std::vector<Observation>& all, const Unknowns& sureness) {
    Solution solution;
    refine(solution, all, sureness, 0);
    refine(solution, all, sureness, likeness_of(residuals_of(all, solution.prices)));
    return solution;
}

Prices prices_of(const Unknowns& unknown, const Units& units, Drawing drawing) {
    Prices prices;
    prices.frame = unknown[frame] * units.ms_each * units.frame_pieces;
    for (const WorkEntry& entry : work_table)
        prices[entry.kind] = unknown[unknown_of(entry.kind)] * units.ms_each * entry.prior(drawing).fit_pieces;
    return prices;
}

// How well the model explains the times: R2 and the percentiles.
void judge(CostFit& fit, const std::vector<Observation>& all, const Unknowns& prices) {
    double mean = 0, total = 0, left = 0;
    for (const Observation& seen : all) mean += seen.time / static_cast<double>(all.size());
    std::vector<double> residuals;
    for (const Observation& seen : all) {
        const double model = dot(seen.amounts, prices);
        total += (seen.time - mean) * (seen.time - mean);
        left += (seen.time - model) * (seen.time - model);
        residuals.push_back(residual(seen, prices));
    }
    fit.r2 = total > equal_times * static_cast<double>(all.size()) ? 1 - left / total : 0;
    std::sort(residuals.begin(), residuals.end());
    for (std::size_t i = 0; i < fit.residual.size(); ++i) {
        const double place = fit.percents[i] / 100 * static_cast<double>(residuals.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, residuals.size() - 1);
        fit.residual[i] = std::lerp(residuals[below], residuals[above], place - static_cast<double>(below));
    }
}

}  // namespace

CostFit fit_costs(std::span<const TraceRow> rows, Drawing drawing) {
    std::vector<Observation> all = observations_of(rows, drawing);
    if (all.size() < fewest_frames) {
        throw std::runtime_error("found " + std::to_string(all.size()) +
                                 " frames with a time, expected 16 to learn what work costs");
    }
    if (std::all_of(all.begin(), all.end(), [](const Observation& seen) { return pieces_of(seen) == 0; }))
        throw std::runtime_error("found no work counted in any frame, expected some in a column");
    const Units units = scale(all);
    const Solution solution = solve(all, sureness_of(all, drawing));
    CostFit fit;
    fit.prices = prices_of(solution.prices, units, drawing);
    fit.sigma = prices_of(solution.sigma, units, drawing);
    fit.frames = std::ssize(all);
    fit.median_ms = units.median_ms;
    judge(fit, all, solution.prices);
    return fit;
}

}  // namespace sfsm::simulate
