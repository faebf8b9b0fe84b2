// Turns what a survey saw into a forecast: histograms over the visible people, then the price list of each step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "figures/choices.h"
#include "render/staleness.h"
#include "scene/crowd.h"
#include "sfsm/forecast.h"

namespace render {

class Forecaster {
public:
    struct Kind {
        figures::Choices choices;
        std::array<Staleness, scene::role_count> staleness{};  // by role
        // What some equally frequent people of the kind ask for, in shares of what those of a block do on average: they
        // aren't all as tall. Never empty, each > 0.
        std::vector<float> spread{1.0f};
    };

    Forecaster() = default;
    // `density`: SelectOptions::density. `way` must outlive it.
    Forecaster(std::vector<Kind> kinds, const figures::Way& way, float density);

    // Forgets the last frame; people come with depths in (0, range].
    void begin(float range);
    // One visible person of a kind: view depth [m], their demand at S = 1 px (figures/representation.h), and pixels
    // that a metre covers at their depth.
    void add(std::size_t kind, scene::Role role, float depth, float demand_at_unit_splat, float pixels_per_metre);
    // Several people of a kind and role who are all about as far, and of a block that can be drawn as one.
    // `demand_at_unit_splat` is that of people of mean size; how sizes differ is the kind's own.
    void add_block(std::size_t kind, scene::Role role, std::int64_t people, float depth, float demand_at_unit_splat,
                   float pixels_per_metre);
    // Whether people of a block, who ask for that at S = 1 px, are drawn as one at S > 0 [px]: what the steps foresee.
    bool serves_block(std::size_t kind, float demand_at_unit_splat, double splat_size) const;
    const figures::Choices& choices(std::size_t kind) const { return kinds_[kind].choices; }
    // `theta` is equation 1's. Valid until the next begin().
    sfsm::Forecast finish(float theta);

private:
    static constexpr int depth_bins = 64;
    static constexpr int demand_bins = 512;  // sixteenths of an octave from 2^-8 on
    static constexpr int motion_steps = 7;
    static constexpr int shape_steps = 28;  // S = 0, then quarter octaves from 0.35 px to 32 px

    void count(std::size_t kind, scene::Role role, std::int64_t people, float depth, float pixels_per_metre);
    void price_motion(float theta);
    void price_shapes();
    void price_shapes_of(std::size_t kind);
    template <typename Visit>
    void for_each_share(std::size_t kind, int bin, Visit visit) const;
    static int asked(int bin, int shift);
    static int bin_of(float demand);
    static float demand_of(int bin);

    // Of one kind and role: pixels per metre, summed over people, by depth.
    using Pixels = std::array<double, depth_bins>;
    const figures::Way* way_ = nullptr;
    std::vector<Kind> kinds_;
    std::array<double, demand_bins> silhouettes_{};  // [px] the side of a square as large as a bin's people
    float range_ = 1;
    std::int64_t people_ = 0;
    std::array<std::int64_t, depth_bins> depths_;                // people
    std::vector<std::array<Pixels, scene::role_count>> pixels_;  // per kind
    // Per kind, at S = 1 px: people, and of those of blocks by what people of mean size ask for.
    std::vector<std::array<std::int32_t, demand_bins>> people_by_demand_, people_of_blocks_;
    std::array<std::int32_t, demand_bins> drawn_alone_{};  // of the kind and step that are priced
    // Per kind: what serves a bin's demand. Under S demand goes with 1 / S^2, which is a shift of bins: looked up.
    std::vector<std::array<std::uint32_t, demand_bins>> choices_;
    std::array<sfsm::Step, motion_steps> motion_;
    std::array<sfsm::Step, shape_steps> shapes_;
};

}  // namespace render
