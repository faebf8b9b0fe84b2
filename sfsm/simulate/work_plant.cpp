#include "sfsm/simulate/work_plant.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sfsm::simulate {
namespace {

constexpr double smallest_splat = 0.2;  // [px]; the paper's finest
constexpr double nearest_share = 0.01;  // of L: D is nowhere less
constexpr int motion_steps = 12;        // of a forecast, even in D, below "everybody moves"
constexpr double splat_steps_per_octave = 4;
constexpr int splat_steps = 24;       // from 0.5 px to max_splat_size
constexpr int distances_tried = 100;  // for the optimum
constexpr int bisections = 40;

// D / L, as far as it matters.
double share_of(const Decision& decision, const View& view) {
    if (decision.state == State::original) return 1;
    const double share = decision.motion_distance / view.range;
    return share > nearest_share ? std::min(share, 1.0) : nearest_share;
}

double nearer_than(double share, const View& view) {
    return std::pow(share, view.farness);
}

// How many updates a person gets in a frame, on average.
double updates_each(double share, const View& view) {
    const double near = nearer_than(share, view);
    return near + (1 - near) / (1 + view.theta * view.range * (1 - share));
}

double motion_loss(double share, const View& view) {
    const double period = 1 + view.theta * view.range * (1 - share);
    return (1 - nearer_than(share, view)) * 0.5 * (period - 1) * view.surface_px;
}

double splat_loss(double size) {
    return 0.5 * size;
}

double usable_splat(const Decision& decision) {
    return std::clamp(decision.splat_size, smallest_splat, max_splat_size);
}

Work work_of(const Decision& decision, const View& view) {
    Work work;
    work[WorkKind::person] = work[WorkKind::single] = std::llround(view.people);
    work[WorkKind::motion_update] = std::llround(view.people * updates_each(share_of(decision, view), view));
    if (decision.state == State::points) {
        work[WorkKind::point] = std::llround(view.people * view.points_each / usable_splat(decision));
    } else {
        work[WorkKind::triangle] = std::llround(view.people * view.triangles_each);
    }
    return work;
}

Work foreseen_work(const Decision& decision, const View& view) {
    Work work = work_of(decision, view);
    const auto misjudge = [&](WorkKind kind, double factor) {
        work[kind] = std::llround(factor * static_cast<double>(work[kind]));
    };
    misjudge(WorkKind::person, view.foresight.person);
    misjudge(WorkKind::single, view.foresight.person);
    misjudge(WorkKind::triangle, view.foresight.triangle);
    misjudge(WorkKind::point, view.foresight.point);
    misjudge(WorkKind::motion_update, view.foresight.update);
    return work;
}

double loss_of(const Decision& decision, const View& view) {
    const double shapes = decision.state == State::points ? splat_loss(usable_splat(decision)) : 0.0;
    return motion_loss(share_of(decision, view), view) + shapes;
}

double cost_of(const Decision& decision, const View& view, const Prices& prices) {
    return sfsm::cost_of(work_of(decision, view), prices);
}

Decision triangles_at(double share, const View& view) {
    return {State::slowed, share * view.range, 0};
}

// The longest D with triangles that meets the limit.
std::optional<Decision> triangles_within(double limit_ms, const View& view, const Prices& prices) {
    double low = nearest_share, high = 1;
    if (cost_of(triangles_at(low, view), view, prices) > limit_ms) return {};
    for (int i = 0; i < bisections; ++i) {
        const double middle = (low + high) / 2;
        (cost_of(triangles_at(middle, view), view, prices) <= limit_ms ? low : high) = middle;
    }
    return triangles_at(low, view);
}

// The smallest splats at this D that meet the limit.
std::optional<Decision> points_within(double limit_ms, double share, const View& view, const Prices& prices) {
    Decision decision{State::points, share * view.range, max_splat_size};
    Work work = work_of(decision, view);
    work[WorkKind::point] = 0;
    const double left_ms = limit_ms - sfsm::cost_of(work, prices);
    const double at_one_px = prices[WorkKind::point] * view.people * view.points_each;
    if (left_ms * max_splat_size < at_one_px) return {};
    decision.splat_size = std::max(smallest_splat, at_one_px / left_ms);
    return decision;
}

}  // namespace

View between(const View& from, const View& to, double share) {
    const auto mix = [=](double a, double b) { return a + (b - a) * share; };
    return {mix(from.people, to.people),
            mix(from.range, to.range),
            mix(from.farness, to.farness),
            mix(from.theta, to.theta),
            mix(from.triangles_each, to.triangles_each),
            mix(from.points_each, to.points_each),
            mix(from.surface_px, to.surface_px),
            {mix(from.foresight.person, to.foresight.person), mix(from.foresight.triangle, to.foresight.triangle),
             mix(from.foresight.point, to.foresight.point), mix(from.foresight.update, to.foresight.update)}};
}

WorkPlant::WorkPlant(const Prices& prices, std::vector<View> views, ViewAt view_at, Unforeseen unforeseen)
    : prices_(prices), views_(std::move(views)), view_at_(std::move(view_at)), unforeseen_(std::move(unforeseen)) {
    tables_.reserve(views_.size());
    for (const View& view : views_) {
        Tables& tables = tables_.emplace_back(tables_of(view));
        tables.forecast = {only_on<WorkAxis::frame>(foreseen_work({}, view)), tables.motion, tables.shapes};
    }
}

WorkPlant::Tables WorkPlant::tables_of(const View& view) {
    Tables tables;
    for (int i = 0; i <= motion_steps; ++i) {
        const double share = std::max(nearest_share, 1 - static_cast<double>(i) / motion_steps);
        const Decision decision = i == 0 ? Decision{} : triangles_at(share, view);
        tables.motion.push_back({decision.motion_distance, only_on<WorkAxis::motion>(foreseen_work(decision, view)),
                                 motion_loss(share, view)});
    }
    tables.shapes.push_back({0, only_on<WorkAxis::shape>(foreseen_work({}, view)), 0});
    for (int i = 0; i <= splat_steps; ++i) {
        const double size = max_splat_size * std::exp2((i - splat_steps) / splat_steps_per_octave);
        const Work work = foreseen_work({State::points, view.range, size}, view);
        tables.shapes.push_back({size, only_on<WorkAxis::shape>(work), splat_loss(size)});
    }
    return tables;
}

double WorkPlant::range(std::int64_t frame) const {
    return view(frame).range;
}

const Forecast* WorkPlant::forecast(std::int64_t frame) const {
    return unforeseen_.is_silent ? nullptr : &tables_[view_at_(frame)].forecast;
}

double WorkPlant::cost_ms(std::int64_t frame, const Decision& decision) const {
    return load(frame) * cost_of(decision, view(frame), prices_) + unpriced_ms(frame);
}

Work WorkPlant::work(std::int64_t frame, const Decision& decision) const {
    return work_of(decision, view(frame));
}

double WorkPlant::detail(std::int64_t frame, const Decision& decision) const {
    return 1 / (1 + loss_of(decision, view(frame)));
}

Decision WorkPlant::optimum(std::int64_t frame, double limit_ms) const {
    const View& seen = view(frame);
    const double limit = (limit_ms - unpriced_ms(frame)) / load(frame);
    if (cost_of(Decision{}, seen, prices_) <= limit) return {};
    Decision best{State::points, nearest_share * seen.range, max_splat_size};
    const auto consider = [&](const std::optional<Decision>& decision) {
        if (decision && loss_of(*decision, seen) < loss_of(best, seen)) best = *decision;
    };
    consider(triangles_within(limit, seen, prices_));
    for (int i = 0; i < distances_tried; ++i) {
        const double share = 1 - (1 - nearest_share) * i / (distances_tried - 1);
        consider(points_within(limit, share, seen, prices_));
    }
    return best;
}

}  // namespace sfsm::simulate
