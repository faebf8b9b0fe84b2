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
constexpr int bins_per_splat_step = bins_per_octave / 2;  // a quarter octave of S is half an octave of points
constexpr double steps_per_octave = 4;
constexpr std::array<double, 6> motion_shares = {5.0 / 6, 2.0 / 3, 1.0 / 2, 1.0 / 3, 1.0 / 6, 0.01};  // D / L

}  // namespace

// The bits of a positive float are its logarithm, piecewise linear: near enough, and free.
int Forecaster::point_bin(float points) {
    return std::clamp(static_cast<int>(std::bit_cast<std::uint32_t>(points) >> bin_shift) - first_bin, 0,
                      point_bins - 1);
}

float Forecaster::bin_points(int bin) {
    const auto half_a_bin = 1u << (bin_shift - 1);
    return std::bit_cast<float>((static_cast<std::uint32_t>(bin + first_bin) << bin_shift) + half_a_bin);
}

Forecaster::Forecaster(std::vector<Kind> kinds)
    : kinds_(std::move(kinds)), pixels_(kinds_.size()), points_(kinds_.size()), drawn_(kinds_.size()) {
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
        for (int bin = 0; bin < point_bins; ++bin) drawn_[kind][bin] = kinds_[kind].drawn_points(bin_points(bin));
}

void Forecaster::begin(float range) {
    range_ = range;
    people_ = 0;
    depths_.fill(0);
    for (auto& roles : pixels_) roles.fill({});
    for (auto& histogram : points_) histogram.fill(0);
}

void Forecaster::add(std::size_t kind, scene::Role role, float depth, float points_at_unit_splat,
                     float pixels_per_metre) {
    ++people_;
    const int bin = std::min(static_cast<int>(depth / range_ * depth_bins), depth_bins - 1);
    ++depths_[bin];
    pixels_[kind][static_cast<std::size_t>(role)][bin] += pixels_per_metre;
    ++points_[kind][point_bin(points_at_unit_splat)];
}

sfsm::Forecast Forecaster::finish(float theta) {
    price_motion(theta);
    price_shapes();
    return {people_, motion_, shapes_};
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

// An outline of splats is off by up to half a splat, and no splat outgrows its person's silhouette.
void Forecaster::price_shapes() {
    const double everybody = std::max<double>(1.0, static_cast<double>(people_));
    for (int step = 0; step < splat_steps; ++step) {
        sfsm::Step& out = shapes_[step];
        out = {};
        out.setting = step == 0 ? 0.0 : sfsm::max_splat_size * std::exp2((step - (splat_steps - 1)) / steps_per_octave);
        // Points go with 1 / S^2, which shifts bins: S = 32 px is ten octaves of points down.
        const int shift = step == 0 ? 0 : (step - (splat_steps - 1)) * bins_per_splat_step + 10 * bins_per_octave;
        double loss = 0;
        for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
            for (int bin = 0; bin < point_bins; ++bin) {
                const std::int64_t people = points_[kind][bin];
                if (people == 0) continue;
                const std::uint32_t drawn = step == 0 ? 0 : drawn_[kind][std::clamp(bin - shift, 0, point_bins - 1)];
                if (drawn == 0) {
                    out.work[sfsm::WorkKind::triangle] += people * kinds_[kind].triangles;
                } else {
                    const double silhouette = 0.5 * std::sqrt(bin_points(bin) / kinds_[kind].density);
                    out.work[sfsm::WorkKind::point] += people * drawn;
                    loss += static_cast<double>(people) * 0.5 * std::min(out.setting, silhouette);
                }
            }
        }
        out.loss_px = loss / everybody;
    }
}

}  // namespace render
