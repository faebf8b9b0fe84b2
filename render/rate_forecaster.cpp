#include "render/rate_forecaster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/octaves.h"

namespace render {

namespace {

constexpr float first_size = -8, bins_per_octave = 4;
// Of a rate at which cells change: there they don't yet (Exchange::step_below), and nothing is between.
constexpr double just_below = 1 - 1.0 / 512;
static_assert(1 / just_below < sfsm::least_rise);

float bin_at(float surface) {
    return (octaves(surface) - first_size) * bins_per_octave;
}

// Of a place among bins, which may lie between them.
double size_of(double bin) {
    const double octave = bin / static_cast<double>(bins_per_octave), whole = std::floor(octave);
    return std::exp2(static_cast<double>(first_size) + whole) * (1 + octave - whole);
}

double middle_of(std::size_t bin) {
    return size_of(static_cast<double>(bin) + 0.5);
}

// To so many parts of one: traces keep every digit.
double rounded(double value, double parts) {
    return std::isfinite(value) ? std::round(parts * value) / parts : value;
}

}  // namespace

RateForecaster::RateForecaster(std::vector<Kind> kinds, const figures::Way& way)
    : kinds_(std::move(kinds)),
      way_(&way),
      prices_(kinds_.size()),
      ends_(kinds_.size()),
      rows_(kinds_.size() * Exchange::shares * 2) {
    std::vector<Exchange::Kind> exchanged;
    std::vector<PaceForecaster::Kind> moved;
    for (const Kind& kind : kinds_) {
        exchanged.push_back(kind.exchanged);
        moved.push_back({kind.staleness, kind.bounds, kind.exchanged.area, kind.reach});
    }
    exchange_ = Exchange(exchanged, way);
    movers_ = PaceForecaster(std::move(moved), way);
    know_kinds();
    know_places();
    know_levels();
}

void RateForecaster::know_kinds() {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        const Exchange::Kind& kind = kinds_[i].exchanged;
        const sfsm::Work& mesh = kind.choices->all()[kind.choices->exact()].level.work;
        Prices& prices = prices_[i];
        prices.triangles = static_cast<double>(mesh[sfsm::WorkKind::triangle]);
        prices.mesh_singles = static_cast<double>(mesh[sfsm::WorkKind::single]);
        prices.most = static_cast<double>(kind.choices->most_samples());
        prices.by_ones = !(prices.most > 0) || kind.choices->all()[kind.choices->samples_at(1)].level.by_ones;
        for (std::size_t bin = 0; bin < size_bins; ++bin) {
            const double height = kind.height * std::sqrt(middle_of(bin) / kind.area);
            prices.mesh_errors[bin] = way_->error.of_mesh(height);
            prices.splat_errors[bin] = way_->error.of_splat(height);
        }
        find_ends(i, {});
    }
}

void RateForecaster::know_places() {
    for (std::size_t cell = 0; cell < exchange_.cells().size(); ++cell)
        for (int step = 0; step < Exchange::steps; ++step)
            for (int place = 0; place < Exchange::shares; ++place)
                for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
                    const auto sizes = exchange_.at_step(step, cell).sizes(kind, static_cast<float>(place));
                    places_.push_back({bin_at(sizes.mesh_from), bin_at(sizes.splat_to)});
                }
}

// Everybody of a bin is between two levels somewhere: the mean over the bin.
void RateForecaster::know_levels() {
    constexpr int parts = 8;
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        const figures::Choices& choices = *kinds_[kind].exchanged.choices;
        prices_[kind].first_levels = levels_.size();
        for (int step = 0; step < Exchange::steps && !prices_[kind].by_ones; ++step) {
            Levels& levels = levels_.emplace_back();
            const double spacing = static_cast<double>(exchange_.at_step(step, 0).spacing);
            for (std::size_t bin = 0; bin < size_bins; ++bin)
                for (int part = 0; part < parts; ++part) {
                    const double size = size_of(static_cast<double>(bin) + (part + 0.5) / parts);
                    const auto demand = static_cast<float>(size / (spacing * spacing));
                    const figures::Level& level = choices.all()[choices.samples_at(demand)].level;
                    const auto count = static_cast<double>(level.work[sfsm::WorkKind::point]);
                    levels.counts[bin] += count / parts;
                    levels.errors[bin] += way_->error.of_points(std::sqrt(size / count), 1) / parts;
                }
        }
    }
}

// Under no limit only few points and many are ends.
void RateForecaster::find_ends(std::size_t kind, const ErrorLimit& limit) {
    const Kind& of = kinds_[kind];
    Ends& ends = ends_[kind];
    const double most = prices_[kind].most;
    ends.few_errors.resize(exchange_.cells().size());
    ends.most_errors.resize(exchange_.cells().size());
    ends.mesh_from = ends.splat_to = size_bins;
    for (std::size_t bin = 0; bin < size_bins; ++bin) {
        const double size = middle_of(bin);
        const float allowed = limit.off_of(of.reach, std::sqrt(size / of.exchanged.area));
        const auto least = static_cast<double>(least_samples(kind, allowed));
        if (!(least <= most)) ends.mesh_from = std::min(ends.mesh_from, static_cast<double>(bin));
        if (!may_be_splat(kind, allowed)) ends.splat_to = std::min(ends.splat_to, static_cast<double>(bin));
        ends.fewest[bin] = std::min(std::max<double>(least, prices_[kind].by_ones ? figures::fewest_points : 1), most);
        for (std::size_t cell = 0; cell < exchange_.cells().size() && most > 0; ++cell) {
            const auto error = [&](double count) {
                return way_->error.of_points(std::sqrt(size / count), exchange_.cells()[cell]);
            };
            ends.few_errors[cell][bin] = error(ends.fewest[bin]);
            ends.most_errors[cell][bin] = error(most);
        }
    }
}

void RateForecaster::begin(const View& view, const ErrorLimit& limit) {
    limit_ = limit;
    if (limit.is_set() || is_limited_)
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) find_ends(kind, limit);
    is_limited_ = limit.is_set();
    pixels_ = static_cast<double>(view.width) * view.height;
    shown_ = 0;
    near_ = {};
    for (Row& row : rows_) {
        for (int bin = row.first; bin <= row.last; ++bin) {
            const auto at = static_cast<std::size_t>(bin);
            row.people[at] = row.surface[at] = row.shown[at] = 0;
        }
        row.first = size_bins;
        row.last = -1;
    }
    movers_.begin();
}

// Who is between two of the shares that are known counts in part with either.
void RateForecaster::add(const Group& group) {
    if (group.people <= 0) return;
    const auto people = static_cast<double>(group.people), surface = people * static_cast<double>(group.surface);
    const double shown = 0.25 * surface * static_cast<double>(group.share * group.on_screen);
    shown_ += shown;
    movers_.add(group.kind, group.role, group.people, shown, group.depth, group.pixels_per_metre, group.surface);
    const int bin = std::clamp(static_cast<int>(bin_at(group.surface)), 0, size_bins - 1);
    const auto at = static_cast<std::size_t>(bin);
    if (group.is_near) {
        near_.triangles += people * prices_[group.kind].triangles;
        near_.singles += people * prices_[group.kind].mesh_singles;
        near_.error += shown * prices_[group.kind].mesh_errors[at];
        return;
    }
    const int place = std::min(static_cast<int>(group.place), Exchange::shares - 2);
    const double next = static_cast<double>(group.place) - place;
    add_to(rows_[index_of(group.kind, place, group.is_block)], at,
           {(1 - next) * people, (1 - next) * surface, (1 - next) * shown});
    if (next > 0)
        add_to(rows_[index_of(group.kind, place + 1, group.is_block)], at,
               {next * people, next * surface, next * shown});
}

void RateForecaster::add_to(Row& row, std::size_t bin, const Amount& amount) {
    row.first = std::min(row.first, static_cast<int>(bin));
    row.last = std::max(row.last, static_cast<int>(bin));
    row.people[bin] += amount.people;
    row.surface[bin] += amount.surface;
    row.shown[bin] += amount.shown;
}

float RateForecaster::least_samples(std::size_t kind, float allowed) const {
    if (!std::isfinite(allowed)) return 0;
    const Covering& covering = kinds_[kind].bounds->covering;
    const auto most = static_cast<std::uint32_t>(choices(kind).most_samples());
    if (!(covering.radius(most) <= allowed)) return std::numeric_limits<float>::infinity();
    std::uint32_t few = 0, enough = most;
    while (enough - few > 1) {
        const std::uint32_t middle = few + (enough - few) / 2;
        (covering.radius(middle) <= allowed ? enough : few) = middle;
    }
    return static_cast<float>(enough);
}

bool RateForecaster::may_be_splat(std::size_t kind, float allowed) const {
    if (!std::isfinite(allowed)) return true;
    const ErrorBounds& bounds = *kinds_[kind].bounds;
    float off = bounds.size;
    for (const MotionBound& bound : bounds.motion.far) off = std::max(off, bound[1]);
    return off <= allowed;
}

double RateForecaster::covered() const {
    return std::min(shown_ / pixels_, 1.0);
}

std::span<const sfsm::RateStep> RateForecaster::finish() {
    const auto moves = movers_.finish(limit_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (rows_[i].first <= rows_[i].last) sum_up(rows_[i], i / (2 * Exchange::shares));
    steps_.clear();
    std::size_t cell = 0;
    for (std::size_t step = 0; step < Exchange::steps; ++step) {
        const double rate = Exchange::rate_of(static_cast<int>(step));
        const Sum before = price_all(step, cell);
        const std::size_t best = step % Exchange::steps_an_octave == 0 ? best_cell(step, cell, before) : cell;
        if (best != cell && step > 0) add_step(rounded(rate * just_below, 1e7), before, moves[step]);
        add_step(rate, best == cell ? before : price_all(step, best), moves[step]);
        cells_[step] = cell = best;
    }
    return steps_;
}

// Losses never shrink along the list.
void RateForecaster::add_step(double rate, const Sum& sum, const PaceForecaster::Price& moves) {
    const double least_loss = steps_.empty() ? 0 : steps_.back().loss;
    sfsm::RateStep& out = steps_.emplace_back();
    out.rate = rate;
    describe(sum, moves, out);
    out.loss = std::max(out.loss, least_loss);
}

void RateForecaster::describe(const Sum& sum, const PaceForecaster::Price& moves, sfsm::RateStep& out) const {
    constexpr double usual_density = 1.2;
    out.work[sfsm::WorkKind::triangle] = std::llround(sum.triangles);
    out.work[sfsm::WorkKind::point] = std::llround(sum.points);
    out.work[sfsm::WorkKind::single] = std::llround(sum.singles);
    out.work[sfsm::WorkKind::motion_update] = std::llround(moves.updates);
    out.motion_distance = rounded(moves.nearest, 10);
    if (sum.simplified) {
        const double size = std::sqrt(usual_density * sum.sampled / (sum.points + sum.splats));
        out.splat_size = rounded(std::min(size, sfsm::max_splat_size), 1e3);
        out.state = sfsm::State::points;
    } else if (std::isfinite(out.motion_distance)) {
        out.state = sfsm::State::slowed;
    }
    out.loss = rounded((sum.error + moves.error) / pixels_, 1e6);
}

// The cells that cost least, but none finer than `cell`, which comes to `now`. Cells take time by how many there are.
std::size_t RateForecaster::best_cell(std::size_t step, std::size_t cell, const Sum& now) const {
    constexpr double worth_a_change = 0.97;  // pictures of other cells look different, and costs aren't known better
    const double rate = Exchange::rate_of(static_cast<int>(step));
    const auto cost_of = [&](const Sum& sum, std::size_t at) {
        const double side = exchange_.cells()[at];
        const double resampled = at > 0 ? way_->effort.resampling * covered() * pixels_ / (side * side) : 0;
        return sum.error + rate * (sum.pieces(way_->effort) + resampled);
    };
    std::size_t best = cell;
    double least = worth_a_change * cost_of(now, cell);
    for (std::size_t at = cell + 1; at < exchange_.cells().size(); ++at) {
        const double cost = cost_of(price_all(step, at), at);
        if (!(cost < least)) continue;
        least = cost;
        best = at;
    }
    return best;
}

RateForecaster::Sum RateForecaster::price_all(std::size_t step, std::size_t cell) const {
    const Exchange::Terms& terms = exchange_.at_step(static_cast<int>(step), cell);
    Sum sum = near_;
    for (int place = 0; place < Exchange::shares; ++place) {
        const double spacing = std::exp2(static_cast<double>(terms.spacings[static_cast<std::size_t>(place)]));
        const double error = way_->error.of_points(spacing, static_cast<double>(terms.cell));
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
            for (const bool is_block : {false, true}) {
                const Row& row = rows_[index_of(kind, place, is_block)];
                if (row.first <= row.last) price_row(row, kind, is_block, {step, cell, place, spacing, error}, sum);
            }
    }
    return sum;
}

const RateForecaster::Below& RateForecaster::Row::at(float place, Below& between) const {
    if (!(place > static_cast<float>(first))) return below[static_cast<std::size_t>(first)];
    if (!(place < static_cast<float>(last + 1))) return below[static_cast<std::size_t>(last) + 1];
    const auto low = static_cast<std::size_t>(place);
    const float share = place - static_cast<float>(low);
    const Below &a = below[low], &b = below[low + 1];
    for (std::size_t i = 0; i < Below::count; ++i) between.sums[i] = a.sums[i] + share * (b.sums[i] - a.sums[i]);
    return between;
}

void RateForecaster::sum_up(Row& row, std::size_t kind) const {
    const Prices& prices = prices_[kind];
    const Ends& ends = ends_[kind];
    row.below[static_cast<std::size_t>(row.first)] = {};
    for (auto bin = static_cast<std::size_t>(row.first); bin <= static_cast<std::size_t>(row.last); ++bin) {
        std::array<float, Below::count>& sums = row.below[bin + 1].sums = row.below[bin].sums;
        const auto add = [&](std::size_t sum, double amount) { sums[sum] += static_cast<float>(amount); };
        add(Below::people, row.people[bin]);
        add(Below::surface, row.surface[bin]);
        add(Below::shown, row.shown[bin]);
        add(Below::mesh_error, row.shown[bin] * prices.mesh_errors[bin]);
        add(Below::splat_error, row.shown[bin] * prices.splat_errors[bin]);
        for (std::size_t cell = 0; cell < exchange_.cells().size(); ++cell) {
            add(Below::few_error + cell, row.shown[bin] * ends.few_errors[cell][bin]);
            add(Below::most_error + cell, row.shown[bin] * ends.most_errors[cell][bin]);
        }
    }
}

// From the smallest on: splats, as few points as there may be, points by their spacing, all of a model's, meshes.
void RateForecaster::price_row(const Row& row, std::size_t kind, bool is_block, const Setting& setting,
                               Sum& sum) const {
    const Prices& prices = prices_[kind];
    if (is_limited_ || !prices.by_ones) return price_bins(row, kind, is_block, setting, sum);
    const Places places = places_of(setting, kind);
    const double square = setting.spacing * setting.spacing;
    const double fewest = std::min<double>(figures::fewest_points, prices.most);
    const float splat_to = is_block ? places.splat_to : 0;
    const float mesh_from = std::max(splat_to, places.mesh_from);
    const float few_to = std::clamp(bin_at(static_cast<float>(fewest * square)), splat_to, mesh_from);
    const float most_from = std::clamp(bin_at(static_cast<float>(prices.most * square)), few_to, mesh_from);
    std::array<Below, 4> room;
    const Below &splats = row.at(splat_to, room[0]), &few = row.at(few_to, room[1]), &most = row.at(most_from, room[2]),
                &mesh = row.at(mesh_from, room[3]), &all = row.below[static_cast<std::size_t>(row.last) + 1];
    const auto between = [](const Below& a, const Below& b, std::size_t which) {
        return static_cast<double>(b[which] - a[which]);
    };
    const double meshed = between(mesh, all, Below::people), pointed = between(splats, mesh, Below::people);
    sum.triangles += meshed * prices.triangles;
    sum.singles += meshed * prices.mesh_singles + pointed;
    sum.splats += static_cast<double>(splats[Below::people]);
    // Each has a last point in part.
    sum.points += fewest * between(splats, few, Below::people) + between(few, most, Below::surface) / square +
                  0.5 * between(few, most, Below::people) + prices.most * between(most, mesh, Below::people);
    sum.sampled += static_cast<double>(mesh[Below::surface]);
    sum.error +=
        static_cast<double>(splats[Below::splat_error]) * way_->error.times_in_cells(exchange_.cells()[setting.cell]) +
        between(splats, few, Below::few_error + setting.cell) + setting.error * between(few, most, Below::shown) +
        between(most, mesh, Below::most_error + setting.cell) + between(mesh, all, Below::mesh_error);
    sum.simplified |= pointed > 0 || splats[Below::people] > 0;
}

// Bin by bin: where points come in levels, or each size needs some number of them.
void RateForecaster::price_bins(const Row& row, std::size_t kind, bool is_block, const Setting& setting,
                                Sum& sum) const {
    const Prices& prices = prices_[kind];
    const Ends& ends = ends_[kind];
    const Levels* levels = prices.by_ones ? nullptr : &levels_[prices.first_levels + setting.step];
    const Places places = places_of(setting, kind);
    const double mesh_from = std::min(static_cast<double>(places.mesh_from), ends.mesh_from);
    const double splat_to = is_block ? std::min(static_cast<double>(places.splat_to), ends.splat_to) : 0;
    const double points_a_pixel = 1 / (setting.spacing * setting.spacing);
    const double splat_factor = way_->error.times_in_cells(exchange_.cells()[setting.cell]);
    const Bins &few_errors = ends.few_errors[setting.cell], &most_errors = ends.most_errors[setting.cell];
    double meshed = 0, pointed = 0, splatted = 0, points = 0, sampled = 0, error = 0;
    for (auto bin = static_cast<std::size_t>(row.first); bin <= static_cast<std::size_t>(row.last); ++bin) {
        const double people = row.people[bin], at = static_cast<double>(bin);
        const double as_splats = std::clamp(splat_to - at, 0.0, 1.0);
        const double as_mesh = (1 - as_splats) * std::clamp(at + 1 - mesh_from, 0.0, 1.0);
        const double as_points = 1 - as_splats - as_mesh;
        double asked = row.surface[bin] * points_a_pixel, points_error = setting.error;
        if (levels) asked = people * levels->counts[bin], points_error = levels->errors[bin];
        const double few = people * ends.fewest[bin], most = people * prices.most;
        if (asked < few) {
            asked = few;
            points_error = few_errors[bin];
        } else if (asked > most) {
            asked = most;
            points_error = most_errors[bin];
        } else if (!levels) {
            asked += 0.5 * people;
        }
        meshed += as_mesh * people;
        pointed += as_points * people;
        splatted += as_splats * people;
        points += as_points * asked;
        sampled += (1 - as_mesh) * row.surface[bin];
        error += row.shown[bin] * (as_mesh * prices.mesh_errors[bin] + as_points * points_error +
                                   as_splats * prices.splat_errors[bin] * splat_factor);
    }
    sum.triangles += meshed * prices.triangles;
    sum.singles += meshed * prices.mesh_singles + pointed;
    sum.splats += splatted;
    sum.points += points;
    sum.sampled += sampled;
    sum.error += error;
    sum.simplified |= pointed + splatted > 0;
}

}  // namespace render
