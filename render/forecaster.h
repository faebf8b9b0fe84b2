// Turns what a survey saw into a forecast: histograms over the visible people, then the price list of each step.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "render/staleness.h"
#include "scene/crowd.h"
#include "sfsm/forecast.h"

namespace render {

class Forecaster {
public:
    // Of one character: how many points a person who needs `points` of them is drawn with; 0 = triangles.
    using DrawnPoints = std::function<std::uint32_t(float points)>;
    struct Kind {
        std::uint32_t triangles = 0;
        float density = 0;  // SelectOptions::density
        DrawnPoints drawn_points;
        std::array<Staleness, scene::role_count> staleness{};  // by role
    };

    Forecaster() = default;
    explicit Forecaster(std::vector<Kind> kinds);

    // Forgets the last frame; people come with depths in (0, range].
    void begin(float range);
    // One visible person of a kind: view depth [m], points needed at S = 1 px, and pixels that a metre covers at their
    // depth.
    void add(std::size_t kind, scene::Role role, float depth, float points_at_unit_splat, float pixels_per_metre);
    // `theta` is equation 1's. Valid until the next begin().
    sfsm::Forecast finish(float theta);

private:
    static constexpr int depth_bins = 64;
    static constexpr int point_bins = 512;  // sixteenths of an octave from 2^-8 on
    static constexpr int motion_steps = 7;
    static constexpr int splat_steps = 28;  // triangles, then quarter octaves from 0.35 px to 32 px

    void price_motion(float theta);
    void price_shapes();
    // Points of people in a bin under S: looked up, since it depends on the kind and their ratio alone.
    static int point_bin(float points);
    static float bin_points(int bin);

    // Of one kind and role: pixels per metre, summed over people, by depth.
    using Pixels = std::array<double, depth_bins>;
    std::vector<Kind> kinds_;
    float range_ = 1;
    std::int64_t people_ = 0;
    std::array<std::int64_t, depth_bins> depths_;                // people
    std::vector<std::array<Pixels, scene::role_count>> pixels_;  // per kind
    std::vector<std::array<std::int32_t, point_bins>> points_;   // per kind: people by points needed at S = 1
    std::vector<std::array<std::uint32_t, point_bins>> drawn_;   // per kind: points drawn for points needed
    std::array<sfsm::Step, motion_steps> motion_;
    std::array<sfsm::Step, splat_steps> shapes_;
};

}  // namespace render
