#include "render/forecaster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "motion/schedule.h"
#include "sfsm/decision.h"

namespace render {

namespace {

constexpr int bins_per_octave = 16;
constexpr int mantissa_bits = 23;
constexpr int bin_shift = mantissa_bits - 4;              // four bits of mantissa: sixteen bins an octave
constexpr int first_bin = (127 - 8) * bins_per_octave;    // of 2^-8
constexpr int bins_per_shape_step = bins_per_octave / 2;  // a quarter octave of S is half an octave of points
constexpr double steps_per_octave = 4;
constexpr std::array<double, 6> motion_shares = {5.0 / 6, 2.0 / 3, 1.0 / 2, 1.0 / 3, 1.0 / 6, 0.01};  // D / L

}  // namespace

// The bits of a positive float are its logarithm, piecewise linear: near enough, and free.
int Forecaster::bin_of(float demand) {
    return std::clamp(static_cast<int>(std::bit_cast<std::uint32_t>(demand) >> bin_shift) - first_bin, 0,
                      demand_bins - 1);
}

float Forecaster::demand_of(int bin) {
    const auto half_a_bin = 1u << (bin_shift - 1);
    return std::bit_cast<float>((static_cast<std::uint32_t>(bin + first_bin) << bin_shift) + half_a_bin);
}

// Where a bin's people are for a larger S.
int Forecaster::asked(int bin, int shift) {
    return std::clamp(bin - shift, 0, demand_bins - 1);
}

bool Forecaster::serves_block(std::size_t kind, float demand_at_unit_splat, double splat_size) const {
    // Of steps it is a whole number.
    const int shift = static_cast<int>(std::floor(2 * bins_per_octave * std::log2(splat_size) + 1e-6));
    return demand_of(asked(bin_of(demand_at_unit_splat), shift)) <= kinds_[kind].choices.block_reach();
}

Forecaster::Forecaster(std::vector<Kind> kinds, const figures::Way& way, float density)
    : way_(&way),
      kinds_(std::move(kinds)),
      pixels_(kinds_.size()),
      people_by_demand_(kinds_.size()),
      people_of_blocks_(kinds_.size()),
      choices_(kinds_.size()) {
    for (int bin = 0; bin < demand_bins; ++bin) {
        silhouettes_[bin] = 0.5 * std::sqrt(demand_of(bin) / density);
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
            choices_[kind][bin] = kinds_[kind].choices.at(demand_of(bin));
    }
}

void Forecaster::begin(float range) {
    range_ = range;
    people_ = 0;
    depths_.fill(0);
    for (auto& roles : pixels_) roles.fill({});
    for (auto& histogram : people_by_demand_) histogram.fill(0);
    for (auto& histogram : people_of_blocks_) histogram.fill(0);
}

void Forecaster::count(std::size_t kind, scene::Role role, std::int64_t people, float depth, float pixels_per_metre) {
    people_ += people;
    const int bin = std::min(static_cast<int>(depth / range_ * depth_bins), depth_bins - 1);
    depths_[bin] += people;
    pixels_[kind][static_cast<std::size_t>(role)][bin] +=
        static_cast<double>(people) * static_cast<double>(pixels_per_metre);
}

void Forecaster::add(std::size_t kind, scene::Role role, float depth, float demand_at_unit_splat,
                     float pixels_per_metre) {
    count(kind, role, 1, depth, pixels_per_metre);
    ++people_by_demand_[kind][bin_of(demand_at_unit_splat)];
}

void Forecaster::add_block(std::size_t kind, scene::Role role, std::int64_t people, float depth,
                           float demand_at_unit_splat, float pixels_per_metre) {
    count(kind, role, people, depth, pixels_per_metre);
    people_of_blocks_[kind][bin_of(demand_at_unit_splat)] += static_cast<std::int32_t>(people);
}

// Shares out a bin of blocks' people over what they ask for. What rounding leaves goes on to the next share, so that
// everybody is counted once.
template <typename Visit>
void Forecaster::for_each_share(std::size_t kind, int bin, Visit visit) const {
    const std::vector<float>& spread = kinds_[kind].spread;
    const auto shares = static_cast<std::int64_t>(spread.size());
    std::int64_t rest = shares / 2;  // [people / shares]
    for (const float share : spread) {
        rest += people_of_blocks_[kind][bin];
        visit(bin_of(share * demand_of(bin)), static_cast<std::int32_t>(rest / shares));
        rest %= shares;
    }
}

sfsm::Forecast Forecaster::finish(float theta) {
    price_motion(theta);
    price_shapes();
    return {sfsm::Work{people_}, motion_, shapes_};
}

// Who moves every f-th frame is due in a frame with a chance of 1 / f, and any of 0 to f - 1 frames old.
void Forecaster::price_motion(float theta) {
    const double everybody = std::max<double>(1.0, static_cast<double>(people_));
    for (int step = 0; step < motion_steps; ++step) {
        sfsm::Step& out = motion_[step];
        out = {};
        out.setting = step == 0 ? std::numeric_limits<double>::infinity() : motion_shares[step - 1] * range_;
        double updates = 0, loss = 0;
        for (int bin = 0; bin < depth_bins; ++bin) {
            const float depth = (static_cast<float>(bin) + 0.5f) / depth_bins * range_;
            const int period = step == 0 ? 1 : motion::update_period(depth, static_cast<float>(out.setting), theta);
            updates += static_cast<double>(depths_[bin]) / period;
            for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
                for (std::size_t role = 0; role < scene::role_count; ++role)
                    loss += pixels_[kind][role][bin] * static_cast<double>(kinds_[kind].staleness[role][period]);
        }
        out.work[sfsm::WorkKind::motion_update] = std::llround(updates);
        out.loss_px = loss / everybody;
    }
}

void Forecaster::price_shapes() {
    for (int step = 0; step < shape_steps; ++step) {
        shapes_[step] = {};
        if (step > 0)
            shapes_[step].setting = sfsm::max_splat_size * std::exp2((step - (shape_steps - 1)) / steps_per_octave);
    }
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) price_shapes_of(kind);
    const double everybody = std::max<double>(1.0, static_cast<double>(people_));
    for (sfsm::Step& step : shapes_) step.loss_px /= everybody;
}

// The greater S is, the more blocks are drawn as one: from the smallest S on, people leave those who are drawn alone.
void Forecaster::price_shapes_of(std::size_t kind) {
    const figures::Choices& choices = kinds_[kind].choices;
    drawn_alone_ = people_by_demand_[kind];
    for (int bin = 0; bin < demand_bins; ++bin)
        if (people_of_blocks_[kind][bin] > 0)
            for_each_share(kind, bin, [&](int to, std::int32_t people) { drawn_alone_[to] += people; });
    int first_alone = 0;  // of blocks' bins
    for (int step = 0; step < shape_steps; ++step) {
        sfsm::Step& out = shapes_[step];
        // S = 32 px is ten octaves of demand down.
        const int shift = (step - (shape_steps - 1)) * bins_per_shape_step + 10 * bins_per_octave;
        const auto add = [&](std::uint32_t choice, int bin, std::int64_t people) {
            const auto& [representation, level] = choices.all()[choice];
            out.work += figures::part_of(level, demand_of(asked(bin, shift))).work * people;
            out.loss_px += static_cast<double>(people) *
                           way_->representations[representation].outline_px(out.setting, silhouettes_[bin]);
        };
        while (step > 0 && first_alone < demand_bins && demand_of(asked(first_alone, shift)) <= choices.block_reach())
            for_each_share(kind, first_alone++, [&](int to, std::int32_t people) { drawn_alone_[to] -= people; });
        for (int bin = 0; bin < first_alone; ++bin)
            if (const std::int64_t people = people_of_blocks_[kind][bin]; people > 0)
                add(choices.in_block_at(demand_of(asked(bin, shift))), bin, people);
        for (int bin = 0; bin < demand_bins; ++bin)
            if (const std::int64_t people = drawn_alone_[bin]; people > 0)
                add(step == 0 ? choices.exact() : choices_[kind][asked(bin, shift)], bin, people);
    }
}

}  // namespace render
