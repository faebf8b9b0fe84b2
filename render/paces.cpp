#include "render/paces.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/octaves.h"

namespace render {

int Paces::place_of(float pixels_per_metre) {
    constexpr float first = -4, per_octave = 2;
    const float place = per_octave * (octaves(pixels_per_metre) - first);
    return static_cast<int>(std::clamp(place, 0.0f, static_cast<float>(places - 1)));
}

PaceForecaster::PaceForecaster(std::vector<Kind> kinds, const figures::Way& way)
    : kinds_(std::move(kinds)), way_(&way), classes_(kinds_.size() * scene::role_count * Paces::places) {
    for (int step = 0; step < Exchange::steps; ++step) rates_[static_cast<std::size_t>(step)] = Exchange::rate_of(step);
    present_.reserve(classes_.size());
    options_.reserve(classes_.size());
}

void PaceForecaster::begin() {
    for (const std::uint32_t index : present_) classes_[index] = {};
    present_.clear();
}

std::span<const PaceForecaster::Price> PaceForecaster::finish(const ErrorLimit& limit) {
    prices_.fill({});
    options_.resize(present_.size());
    for (std::size_t i = 0; i < present_.size(); ++i) {
        solve(present_[i], limit, options_[i]);
        price(options_[i]);
    }
    return prices_;
}

// Periods that are best at some rate: the lower hull of error over updates.
void PaceForecaster::solve(std::uint32_t index, const ErrorLimit& limit, Options& options) const {
    const Class& of = classes_[index];
    const std::size_t role = index / Paces::places % scene::role_count;
    const Kind& kind = kinds_[index / Paces::places / scene::role_count];
    const double pixels = of.shown > 0 ? of.pixels / of.shown : 0;
    const double scale = std::sqrt(static_cast<double>(of.largest) / kind.area);  // [px / model unit]
    const float allowed = limit.off_of(kind.reach, scale);
    const double work = static_cast<double>(of.people) * way_->effort.update;  // of moving everybody once
    options.of = index;
    options.count = 0;
    for (const int period : paced_periods) {
        const auto at = static_cast<std::size_t>(period);
        if (period > 1 && !(kind.bounds->motion.single[role][at] <= allowed)) break;
        const double off = static_cast<double>(kind.staleness[role][at]) * pixels;
        options.add(period, period > 1 ? of.shown * way_->error.of_motion(off) : 0, work / period);
    }
}

void PaceForecaster::Options::add(int period, double error, double updates) {
    double rate = 0;
    while (count > 0) {
        const Option& before = list[count - 1];
        rate = (error - before.error) / (before.updates - updates);
        if (count == 1 || rate > before.rate) break;
        --count;
    }
    list[count++] = {rate, error, updates, period};
}

void PaceForecaster::price(const Options& options) {
    const Class& of = classes_[options.of];
    std::size_t step = 0;
    for (std::size_t at = 0; at < options.count; ++at) {
        const Option& option = options.list[at];
        const double to = at + 1 < options.count ? options.list[at + 1].rate : std::numeric_limits<double>::infinity();
        const double updates = static_cast<double>(of.people) / option.period;
        for (; step < rates_.size() && !(to < rates_[step]); ++step) {
            Price& price = prices_[step];
            price.updates += updates;
            price.error += option.error;
            if (option.period > 1) price.nearest = std::min(price.nearest, static_cast<double>(of.nearest));
        }
    }
}

void PaceForecaster::find(double rate, Paces& paces) const {
    paces.reset(kinds_.size());
    for (const Options& options : options_) {
        std::size_t at = 0;
        while (at + 1 < options.count && options.list[at + 1].rate < rate) ++at;
        const std::uint32_t roles = options.of / Paces::places;
        paces.period(roles / scene::role_count, roles % scene::role_count,
                     static_cast<int>(options.of % Paces::places)) = options.list[at].period;
    }
}

}  // namespace render
