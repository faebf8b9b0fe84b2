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
    know_settings();
    know_levels();
    know_weights();
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].column = i % columns();
    below_.resize(rows_.size() * (size_bins + 1) + 1);
    for (Share& share : shares_) {
        share.summed.reserve(2 * kinds_.size());
        share.binned.reserve(2 * kinds_.size());
    }
}

void RateForecaster::know_kinds() {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        const Exchange::Kind& kind = kinds_[i].exchanged;
        const sfsm::Work& mesh = kind.choices->all()[kind.choices->exact()].level.work;
        Prices& prices = prices_[i];
        prices.triangles = static_cast<double>(mesh[sfsm::WorkKind::triangle]);
        prices.most = static_cast<double>(kind.choices->most_samples());
        prices.fewest = std::min<double>(figures::fewest_points, prices.most);
        prices.by_ones = !(prices.most > 0) || kind.choices->all()[kind.choices->samples_at(1)].level.by_ones;
        for (std::size_t bin = 0; bin < size_bins; ++bin) {
            const double height = kind.height * std::sqrt(middle_of(bin) / kind.area);
            prices.mesh_errors[bin] = way_->error.of_mesh(height);
            prices.splat_errors[bin] = way_->error.of_splat(height);
        }
        find_ends(i, {});
    }
}

void RateForecaster::know_settings() {
    for (std::size_t cell = 0; cell < exchange_.cells().size(); ++cell)
        for (std::size_t step = 0; step < Exchange::steps; ++step)
            for (std::size_t place = 0; place < Exchange::shares; ++place) {
                const Exchange::Terms& terms = exchange_.at_step(static_cast<int>(step), cell);
                const double spacing = std::exp2(static_cast<double>(terms.spacings[place]));
                const double error = way_->error.of_points(spacing, static_cast<double>(terms.cell));
                settings_.push_back({step, cell, spacing * spacing, error, borders_.size()});
                for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
                    know_borders(settings_.back(), kind, terms.sizes(kind, static_cast<float>(place)));
            }
}

// From the smallest on: splats, as few points as there may be, points by their spacing, all of a model's, meshes.
void RateForecaster::know_borders(const Setting& setting, std::size_t kind, const Exchange::Terms::Sizes& sizes) {
    const auto size_of_points = [&](double count) { return bin_at(static_cast<float>(count * setting.square)); };
    for (const float splats_to : {0.0f, bin_at(sizes.splat_to)}) {
        const float meshes_from = std::max(splats_to, bin_at(sizes.mesh_from));
        const float few_to = std::clamp(size_of_points(prices_[kind].fewest), splats_to, meshes_from);
        const float most_from = std::clamp(size_of_points(prices_[kind].most), few_to, meshes_from);
        borders_.push_back({splats_to, few_to, most_from, meshes_from});
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

// Under no limit.
void RateForecaster::know_weights() {
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
        for (std::size_t bin = 0; bin < size_bins; ++bin) {
            const Prices& prices = prices_[kind];
            std::array<float, SizeSums::count>& sums = weights_.emplace_back().sums;
            const auto set = [&](std::size_t sum, double weight) { sums[sum] = static_cast<float>(weight); };
            for (const std::size_t sum : {SizeSums::people, SizeSums::surface, SizeSums::shown}) set(sum, 1);
            set(SizeSums::triangles, prices.triangles);
            set(SizeSums::few_points, prices.fewest);
            set(SizeSums::most_points, prices.most);
            set(SizeSums::mesh_error, prices.mesh_errors[bin]);
            set(SizeSums::splat_error, prices.splat_errors[bin]);
            for (std::size_t cell = 0; cell < exchange_.cells().size(); ++cell) {
                set(SizeSums::few_error + cell, ends_[kind].few_errors[cell][bin]);
                set(SizeSums::most_error + cell, ends_[kind].most_errors[cell][bin]);
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
        for (int bin = row.first; bin <= row.last; ++bin) row.bins[static_cast<std::size_t>(bin)] = {};
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
        near_.singles += people;
        near_.error += shown * prices_[group.kind].mesh_errors[at];
        return;
    }
    const std::size_t place = std::min(static_cast<std::size_t>(group.place), std::size_t{Exchange::shares} - 2);
    const double next = static_cast<double>(group.place) - static_cast<double>(place);
    Row* row = &rows_[place * columns() + column_of(group.kind, group.is_block)];
    add_to(row[0], at, {(1 - next) * people, (1 - next) * surface, (1 - next) * shown});
    if (next > 0) add_to(row[columns()], at, {next * people, next * surface, next * shown});
}

void RateForecaster::add_to(Row& row, std::size_t bin, const SizeBin& people) {
    row.first = std::min(row.first, static_cast<int>(bin));
    row.last = std::max(row.last, static_cast<int>(bin));
    row.bins[bin].people += people.people;
    row.bins[bin].surface += people.surface;
    row.bins[bin].shown += people.shown;
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

double RateForecaster::canvas_px() const {
    return std::max(pixels_, shown_);
}

double RateForecaster::covered() const {
    return std::min(shown_ / pixels_, 1.0);
}

std::span<const sfsm::RateStep> RateForecaster::finish() {
    const auto moves = movers_.finish(limit_);
    sort_rows();
    steps_.clear();
    std::size_t cell = 0;
    for (std::size_t step = 0; step < Exchange::steps; ++step) {
        const double rate = Exchange::rate_of(static_cast<int>(step));
        const InCells before{cell, price_all(step, cell)};
        const InCells best = step % Exchange::steps_an_octave == 0 ? best_cells(step, before) : before;
        if (best.cell != cell && step > 0) add_step(rounded(rate * just_below, 1e7), before.sum, moves[step]);
        add_step(rate, best.sum, moves[step]);
        cells_[step] = cell = best.cell;
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
    out.loss = rounded((sum.error + moves.error) / canvas_px(), 1e6);
}

// The cells that cost least, but none finer than now. Cells take time by how many there are.
RateForecaster::InCells RateForecaster::best_cells(std::size_t step, const InCells& now) const {
    constexpr double worth_a_change = 0.97;  // pictures of other cells look different, and costs aren't known better
    const double rate = Exchange::rate_of(static_cast<int>(step));
    const auto cost_of = [&](const InCells& all) {
        const double side = exchange_.cells()[all.cell];
        const double resampled = all.cell > 0 ? way_->effort.resampling * covered() * pixels_ / (side * side) : 0;
        return all.sum.error + rate * (all.sum.pieces(way_->effort) + resampled);
    };
    InCells best = now;
    double least = worth_a_change * cost_of(now);
    for (std::size_t cell = now.cell + 1; cell < exchange_.cells().size(); ++cell) {
        const InCells all{cell, price_all(step, cell)};
        const double cost = cost_of(all);
        if (!(cost < least)) continue;
        least = cost;
        best = all;
    }
    return best;
}

RateForecaster::Sum RateForecaster::price_all(std::size_t step, std::size_t cell) const {
    Sum sum = near_;
    for (std::size_t place = 0; place < Exchange::shares; ++place) {
        const Setting& setting = settings_[(cell * Exchange::steps + step) * Exchange::shares + place];
        const std::span<const SizedRow> rows = shares_[place].summed;
        for (std::size_t i = 0; i < rows.size(); i += most_sized_rows)
            price_parts(divide(rows.subspan(i, std::min(most_sized_rows, rows.size() - i)), &borders_[setting.borders]),
                        setting, sum);
        for (const Row* row : shares_[place].binned) price_bins(*row, setting, sum);
    }
    return sum;
}

void RateForecaster::sort_rows() {
    SizeSums* below = below_.data();
    for (std::size_t place = 0; place < Exchange::shares; ++place) {
        Share& share = shares_[place];
        share.summed.clear();
        share.binned.clear();
        for (const Row& row : std::span(rows_).subspan(place * columns(), columns())) {
            if (row.first > row.last) continue;
            if (is_limited_ || !prices_[row.column / 2].by_ones) {
                share.binned.push_back(&row);
            } else {
                share.summed.push_back(sum_up(row, below));
                below += row.last - row.first + 2;
            }
        }
    }
}

SizedRow RateForecaster::sum_up(const Row& row, SizeSums* below) const {
    const auto first = static_cast<std::size_t>(row.first), count = static_cast<std::size_t>(row.last + 1) - first;
    render::sum_up(std::span(row.bins).subspan(first, count), &weights_[row.column / 2 * size_bins + first], below);
    return {below, below + count, static_cast<float>(first), static_cast<float>(count),
            static_cast<std::uint32_t>(row.column)};
}

// Sums of everybody of some rows at once: what a kind is worth is in them.
void RateForecaster::price_parts(const SizeParts& parts, const Setting& setting, Sum& sum) const {
    const double pointed = parts.few[SizeSums::people] + parts.spaced[SizeSums::people] + parts.most[SizeSums::people];
    sum.triangles += parts.meshes[SizeSums::triangles];
    sum.singles += parts.meshes[SizeSums::people] + pointed;
    sum.splats += parts.splats[SizeSums::people];
    // Each has a last point in part.
    sum.points += parts.few[SizeSums::few_points] + parts.spaced[SizeSums::surface] / setting.square +
                  0.5 * parts.spaced[SizeSums::people] + parts.most[SizeSums::most_points];
    for (const SizeSums* part : {&parts.splats, &parts.few, &parts.spaced, &parts.most})
        sum.sampled += (*part)[SizeSums::surface];
    sum.error += parts.splats[SizeSums::splat_error] * way_->error.times_in_cells(exchange_.cells()[setting.cell]) +
                 parts.few[SizeSums::few_error + setting.cell] + setting.error * parts.spaced[SizeSums::shown] +
                 parts.most[SizeSums::most_error + setting.cell] + parts.meshes[SizeSums::mesh_error];
    sum.simplified |= pointed > 0 || parts.splats[SizeSums::people] > 0;
}

// Bin by bin: where points come in levels, or each size needs some number of them.
void RateForecaster::price_bins(const Row& row, const Setting& setting, Sum& sum) const {
    const std::size_t kind = row.column / 2;
    const Prices& prices = prices_[kind];
    const Ends& ends = ends_[kind];
    const Levels* levels = prices.by_ones ? nullptr : &levels_[prices.first_levels + setting.step];
    // Those alone are meshes wherever points are worse; those of blocks not below splats.
    const SizeBorders &alone = borders_[setting.borders + column_of(kind, false)],
                      &own = borders_[setting.borders + row.column];
    const double mesh_from = std::min(static_cast<double>(alone.meshes_from), ends.mesh_from);
    const double splat_to = std::min(static_cast<double>(own.splats_to), ends.splat_to);
    const double points_a_pixel = 1 / setting.square;
    const double splat_factor = way_->error.times_in_cells(exchange_.cells()[setting.cell]);
    const Bins &few_errors = ends.few_errors[setting.cell], &most_errors = ends.most_errors[setting.cell];
    double meshed = 0, pointed = 0, splatted = 0, points = 0, sampled = 0, error = 0;
    for (auto bin = static_cast<std::size_t>(row.first); bin <= static_cast<std::size_t>(row.last); ++bin) {
        const double people = row.bins[bin].people, surface = row.bins[bin].surface, at = static_cast<double>(bin);
        const double as_splats = std::clamp(splat_to - at, 0.0, 1.0);
        const double as_mesh = (1 - as_splats) * std::clamp(at + 1 - mesh_from, 0.0, 1.0);
        const double as_points = 1 - as_splats - as_mesh;
        double asked = surface * points_a_pixel, points_error = setting.error;
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
        sampled += (1 - as_mesh) * surface;
        error += row.bins[bin].shown * (as_mesh * prices.mesh_errors[bin] + as_points * points_error +
                                        as_splats * prices.splat_errors[bin] * splat_factor);
    }
    sum.triangles += meshed * prices.triangles;
    sum.singles += meshed + pointed;
    sum.splats += splatted;
    sum.points += points;
    sum.sampled += sampled;
    sum.error += error;
    sum.simplified |= pointed + splatted > 0;
}

}  // namespace render
