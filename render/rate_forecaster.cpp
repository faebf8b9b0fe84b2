#include "render/rate_forecaster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace render {

namespace {

constexpr double first_size = -8, bins_per_octave = 4;
constexpr float first_place = -4, places_per_octave = 2;
constexpr std::array periods = {1, 2, 3, 4, 6, 8, 12, 16, 24, motion::max_period};

// The bits of a positive float are its logarithm, piecewise linear: near enough, and free.
constexpr int mantissa_bits = 23;

float octaves(float value) {
    constexpr float one = 1 << mantissa_bits;
    return static_cast<float>(std::bit_cast<std::uint32_t>(value)) / one - 127;
}

double bin_at(float surface) {
    return (static_cast<double>(octaves(surface)) - first_size) * bins_per_octave;
}

double size_of(int bin) {
    const double octave = (bin + 0.5) / bins_per_octave, whole = std::floor(octave);
    return std::exp2(first_size + whole) * (1 + octave - whole);
}

// To so many parts of one: traces keep every digit.
double rounded(double value, double parts) {
    return std::isfinite(value) ? std::round(parts * value) / parts : value;
}

// The share of a bin that lies above a place among bins.
double share_above(int bin, double place) {
    return std::clamp(bin + 1 - place, 0.0, 1.0);
}

}  // namespace

int Paces::place_of(float pixels_per_metre) {
    const float place = places_per_octave * (octaves(pixels_per_metre) - first_place);
    return static_cast<int>(std::clamp(place, 0.0f, static_cast<float>(places - 1)));
}

RateForecaster::RateForecaster(std::vector<Kind> kinds, const figures::Way& way, double max_error)
    : kinds_(std::move(kinds)),
      way_(&way),
      mesh_errors_(kinds_.size()),
      splat_errors_(kinds_.size()),
      max_error_(max_error),
      rows_(kinds_.size() * Exchange::shares * 2),
      motion_(kinds_.size()),
      paces_(kinds_.size()) {
    std::vector<Exchange::Kind> exchanged;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        const Exchange::Kind& kind = exchanged.emplace_back(kinds_[i].exchanged);
        for (int bin = 0; bin < size_bins; ++bin) {
            const double height = kind.height * std::sqrt(size_of(bin) / kind.area);
            mesh_errors_[i][static_cast<std::size_t>(bin)] = way.error.of_mesh(height);
            splat_errors_[i][static_cast<std::size_t>(bin)] = way.error.of_splat(height);
        }
    }
    exchange_ = Exchange(exchanged, way);
}

// Aside of the picture's middle what is off by some metres is off by more pixels, and so is what is nearer than a
// person's middle: of whom is four radii away by a third.
void RateForecaster::begin(const View& view) {
    constexpr double nearer = 4.0 / 3;
    pixels_ = static_cast<double>(view.width) * view.height;
    allowed_ = max_error_ /
               (nearer * std::hypot(1.0, static_cast<double>(view.tan_half_x), static_cast<double>(view.tan_half_y)));
    shown_ = 0;
    for (Row& row : rows_) {
        for (int bin = row.first; bin <= row.last; ++bin) row.bins[static_cast<std::size_t>(bin)] = {};
        row.first = size_bins;
        row.last = -1;
    }
    for (auto& roles : motion_) roles.fill({});
}

void RateForecaster::add(const Group& group) {
    if (group.people <= 0) return;
    const auto people = static_cast<double>(group.people), surface = static_cast<double>(group.surface);
    const double shown = people * surface / 4 * static_cast<double>(group.share) * static_cast<double>(group.on_screen);
    shown_ += shown;
    const int bin = std::clamp(static_cast<int>(bin_at(group.surface)), 0, size_bins - 1);
    const auto place = static_cast<int>(group.place + 0.5f);
    Row& into = rows_[index_of(group.kind, place, group.is_block)];
    into.first = std::min(into.first, bin);
    into.last = std::max(into.last, bin);
    Bin& sum = into.bins[static_cast<std::size_t>(bin)];
    sum.people += group.people;
    sum.surface += people * surface;
    sum.shown += shown;
    Motion& motion = motion_[group.kind][static_cast<std::size_t>(group.role)]
                            [static_cast<std::size_t>(Paces::place_of(group.pixels_per_metre))];
    motion.nearest = motion.people == 0 ? group.depth : std::min(motion.nearest, group.depth);
    motion.pixels_per_metre = std::max(motion.pixels_per_metre, group.pixels_per_metre);
    motion.largest_pixels = std::max(motion.largest_pixels,
                                     std::sqrt(group.surface / static_cast<float>(kinds_[group.kind].exchanged.area)));
    motion.people += group.people;
    motion.shown += shown;
}

float RateForecaster::least_samples(std::size_t kind, float surface) const {
    if (!std::isfinite(allowed_)) return 0;
    const Kind& of = kinds_[kind];
    const auto radius = static_cast<float>(allowed_ / std::sqrt(static_cast<double>(surface) / of.exchanged.area));
    const auto most = static_cast<std::uint32_t>(of.exchanged.choices->most_samples());
    if (!(of.bounds->covering.radius(most) <= radius)) return std::numeric_limits<float>::infinity();
    std::uint32_t few = 0, enough = most;
    while (enough - few > 1) {
        const std::uint32_t middle = few + (enough - few) / 2;
        (of.bounds->covering.radius(middle) <= radius ? enough : few) = middle;
    }
    return static_cast<float>(enough);
}

bool RateForecaster::may_be_splat(std::size_t kind, float surface) const {
    if (!std::isfinite(allowed_)) return true;
    const Kind& of = kinds_[kind];
    const double pixels = std::sqrt(static_cast<double>(surface) / of.exchanged.area);
    double off = static_cast<double>(of.bounds->size);
    for (const MotionBound& bound : of.bounds->motion.far) off = std::max(off, static_cast<double>(bound[1]));
    return off * pixels <= allowed_;
}

double RateForecaster::covered() const {
    return std::min(shown_ / pixels_, 1.0);
}

std::span<const sfsm::RateStep> RateForecaster::finish() {
    for (auto& roles : paces_.all())
        for (auto& places : roles) places.fill(1);
    double most_loss = 0;
    std::size_t cell = 0;
    for (int step = 0; step < Exchange::steps; ++step) {
        sfsm::RateStep& out = steps_[static_cast<std::size_t>(step)];
        out = {};
        out.rate = Exchange::rate_of(step);
        Sum sum = price_shapes(step, cell);
        cells_[static_cast<std::size_t>(step)] = cell;
        price_motion(step, out, sum.error);
        out.work[sfsm::WorkKind::triangle] = std::llround(sum.triangles);
        out.work[sfsm::WorkKind::point] = std::llround(sum.points);
        out.work[sfsm::WorkKind::single] = std::llround(sum.singles);
        constexpr double usual_density = 1.2;
        if (sum.simplified) {
            out.splat_size =
                std::min(std::sqrt(usual_density * sum.sampled / (sum.points + sum.splats)), sfsm::max_splat_size);
            out.state = sfsm::State::points;
        } else if (std::isfinite(out.motion_distance)) {
            out.state = sfsm::State::slowed;
        }
        most_loss = out.loss = std::max(most_loss, rounded(sum.error / pixels_, 1e6));
        out.splat_size = rounded(out.splat_size, 1e3);
        out.motion_distance = rounded(out.motion_distance, 10);
    }
    return steps_;
}

// In the cells that cost least, but none finer than at lower rates. Cells take time by how many there are.
RateForecaster::Sum RateForecaster::price_shapes(int step, std::size_t& cell) const {
    const double rate = Exchange::rate_of(step);
    const auto cost_of = [&](const Sum& sum, std::size_t at) {
        const double side = exchange_.cells()[at];
        const double resampled = at > 0 ? way_->effort.resampling * covered() * pixels_ / (side * side) : 0;
        return sum.error + rate * (sum.pieces(way_->effort) + resampled);
    };
    Sum best = price_all(exchange_.at_step(step, cell));
    double least = cost_of(best, cell);
    for (std::size_t at = cell + 1; at < exchange_.cells().size(); ++at) {
        const Sum sum = price_all(exchange_.at_step(step, at));
        const double cost = cost_of(sum, at);
        if (!(cost < least)) break;
        best = sum;
        least = cost;
        cell = at;
    }
    return best;
}

RateForecaster::Sum RateForecaster::price_all(const Exchange::Terms& terms) const {
    Sum sum;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
        for (int place = 0; place < Exchange::shares; ++place)
            for (const bool is_block : {false, true}) {
                const Row& row = rows_[index_of(kind, place, is_block)];
                if (row.first <= row.last) price_row(row, kind, place, is_block, terms, sum);
            }
    return sum;
}

void RateForecaster::price_row(const Row& row, std::size_t kind, int place, bool is_block, const Exchange::Terms& terms,
                               Sum& sum) const {
    const figures::Choices& choices = *kinds_[kind].exchanged.choices;
    const Exchange::Terms::Sizes sizes = terms.sizes(kind, static_cast<float>(place));
    const auto spacing = static_cast<double>(sizes.spacing), cell = static_cast<double>(terms.cell);
    const double mesh_from = bin_at(sizes.mesh_from);
    const double splat_to = is_block ? bin_at(sizes.splat_to) : 0;
    const sfsm::Work& mesh = choices.all()[choices.exact()].level.work;
    const double points_error = way_->error.of_points(spacing, cell);
    const double cell_factor = way_->error.times_in_cells(cell);
    for (int bin = row.first; bin <= row.last; ++bin) {
        const auto index = static_cast<std::size_t>(bin);
        const Bin& of = row.bins[index];
        if (of.people == 0) continue;
        const auto people = static_cast<double>(of.people);
        const auto surface = static_cast<float>(of.surface / people);
        const float least = least_samples(kind, surface);
        const double as_splats = is_block && may_be_splat(kind, surface) ? 1 - share_above(bin, splat_to) : 0;
        const double as_mesh = (1 - as_splats) * (least > choices.most_samples() ? 1 : share_above(bin, mesh_from));
        const double as_points = 1 - as_splats - as_mesh;
        sum.triangles += as_mesh * people * static_cast<double>(mesh[sfsm::WorkKind::triangle]);
        sum.singles += as_mesh * people * static_cast<double>(mesh[sfsm::WorkKind::single]);
        sum.error += of.shown * (as_mesh * mesh_errors_[kind][index] + as_points * points_error +
                                 as_splats * splat_errors_[kind][index] * cell_factor);
        if (as_splats > 0) {
            sum.splats += as_splats * people;
            sum.sampled += as_splats * of.surface;
            sum.simplified = true;
        }
        if (as_points > 0) {
            const float demand = std::max(surface / (sizes.spacing * sizes.spacing), least);
            const figures::Level& level = choices.all()[choices.samples_at(demand)].level;
            const double count =
                level.by_ones ? std::clamp<double>(demand, std::min(figures::fewest_points, level.count), level.count)
                              : static_cast<double>(level.work[sfsm::WorkKind::point]);
            sum.points += as_points * people * count;
            sum.singles += as_points * people * static_cast<double>(level.work[sfsm::WorkKind::single]);
            sum.sampled += as_points * of.surface;
            sum.simplified = true;
        }
    }
}

bool RateForecaster::may_wait(const Kind& kind, std::size_t role, const Motion& motion, int period) const {
    if (!std::isfinite(allowed_)) return true;
    const float off = kind.bounds->motion.single[role][static_cast<std::size_t>(period)] * motion.largest_pixels;
    return static_cast<double>(off) <= allowed_;
}

// The period of least cost from `from` on: error that a late surface makes, against updates.
int RateForecaster::best_period(const Kind& kind, std::size_t role, const Motion& motion, double rate, int from) const {
    const auto people = static_cast<double>(motion.people);
    const auto cost = [&](int period) {
        const double off =
            static_cast<double>(kind.staleness[role][static_cast<std::size_t>(period)] * motion.pixels_per_metre);
        return motion.shown * way_->error.of_motion(off) + rate * people * way_->effort.update / period;
    };
    int best = from;
    double least = cost(from);
    for (const int period : periods) {
        if (period <= from) continue;
        if (!may_wait(kind, role, motion, period)) break;
        const double here = cost(period);
        if (here < least) least = here, best = period;
    }
    return best;
}

void RateForecaster::price_motion(int step, sfsm::RateStep& out, double& error) {
    double updates = 0;
    out.motion_distance = std::numeric_limits<double>::infinity();
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
        for (std::size_t role = 0; role < scene::role_count; ++role)
            for (int place = 0; place < Paces::places; ++place) {
                const Motion& motion = motion_[kind][role][static_cast<std::size_t>(place)];
                if (motion.people == 0) continue;
                int& period = paces_.period(kind, role, place);
                period = best_period(kinds_[kind], role, motion, Exchange::rate_of(step), period);
                updates += static_cast<double>(motion.people) / period;
                if (period == 1) continue;
                const double off = static_cast<double>(kinds_[kind].staleness[role][static_cast<std::size_t>(period)] *
                                                       motion.pixels_per_metre);
                error += motion.shown * way_->error.of_motion(off);
                out.motion_distance = std::min(out.motion_distance, static_cast<double>(motion.nearest));
            }
    out.work[sfsm::WorkKind::motion_update] = std::llround(updates);
}

void RateForecaster::find_paces(double rate, Paces& paces) const {
    paces.all().resize(kinds_.size());
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
        for (std::size_t role = 0; role < scene::role_count; ++role)
            for (int place = 0; place < Paces::places; ++place) {
                const Motion& motion = motion_[kind][role][static_cast<std::size_t>(place)];
                paces.period(kind, role, place) =
                    motion.people == 0 ? 1 : best_period(kinds_[kind], role, motion, rate, 1);
            }
}

}  // namespace render
