// How often people move at each rate of exchange (exchange.h). They are classes: everybody in view of one character and
// role who is about as far.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "figures/way.h"
#include "render/error_bounds.h"
#include "render/error_limit.h"
#include "render/exchange.h"
#include "render/staleness.h"
#include "scene/crowd.h"

namespace render {

// Update periods [ticks], class by class.
class Paces {
public:
    static constexpr int places = 32;  // half octaves of pixels that a metre covers, from 2^-4 on
    static int place_of(float pixels_per_metre);

    // Everybody in every tick.
    void reset(std::size_t kinds) {
        Roles ones;
        for (auto& periods : ones) periods.fill(1);
        periods_.assign(kinds, ones);
    }
    int& period(std::size_t kind, std::size_t role, int place) {
        return periods_[kind][role][static_cast<std::size_t>(place)];
    }
    int period(std::size_t kind, scene::Role role, float pixels_per_metre) const {
        return periods_[kind][static_cast<std::size_t>(role)][static_cast<std::size_t>(place_of(pixels_per_metre))];
    }

private:
    using Roles = std::array<std::array<int, places>, scene::role_count>;
    std::vector<Roles> periods_;
};

// Update periods that are chosen from [ticks].
inline constexpr std::array paced_periods = {1, 2, 3, 4, 6, 8, 12, 16, 24, motion::max_period};

class PaceForecaster {
public:
    struct Kind {
        std::array<Staleness, scene::role_count> staleness{};  // by role
        const ErrorBounds* bounds = nullptr;
        double area = 0;  // of a surface [model units^2]
        float reach = 0;  // of a person from their middle [model units]
    };

    PaceForecaster() = default;
    // `way` must outlive it.
    PaceForecaster(std::vector<Kind> kinds, const figures::Way& way);

    // Forgets the last frame.
    void begin();
    // People of whose silhouettes `shown` pixels show together; each has a surface [px^2], and a metre covers so many
    // pixels there.
    void add(std::size_t kind, scene::Role role, std::int64_t people, double shown, float depth, float pixels_per_metre,
             float surface) {
        const std::size_t index = index_of(kind, static_cast<std::size_t>(role), Paces::place_of(pixels_per_metre));
        Class& into = classes_[index];
        if (into.people == 0) {
            present_.push_back(static_cast<std::uint32_t>(index));
            into.nearest = depth;
        }
        into.people += people;
        into.shown += shown;
        into.pixels += shown * static_cast<double>(pixels_per_metre);
        into.nearest = into.nearest < depth ? into.nearest : depth;
        into.largest = into.largest > surface ? into.largest : surface;
    }

    // What people's moving comes to.
    struct Price {
        double updates = 0;                                        // a frame
        double error = 0;                                          // FLIP, summed over pixels
        double nearest = std::numeric_limits<double>::infinity();  // [m] depth from which somebody moves less often
    };
    // By step of the exchange: of all who were added.
    std::span<const Price> finish(const ErrorLimit& limit);

    // After finish(): who moves how often at any rate.
    void find(double rate, Paces& paces) const;

private:
    struct Class {
        std::int64_t people = 0;
        double shown = 0;   // [px]
        double pixels = 0;  // that a metre covers, summed over those
        float nearest = 0;  // [m]
        float largest = 0;  // surface [px^2]
    };
    // The best periods of a class: each from a rate on.
    struct Option {
        double rate = 0, error = 0;
        double updates = 0;  // [work] of all its people, a frame
        int period = 1;
    };
    struct Options {
        std::uint32_t of = 0;
        std::size_t count = 0;
        std::array<Option, paced_periods.size()> list{};

        void add(int period, double error, double updates);
    };

    std::size_t index_of(std::size_t kind, std::size_t role, int place) const {
        return (kind * scene::role_count + role) * Paces::places + static_cast<std::size_t>(place);
    }
    void solve(std::uint32_t index, const ErrorLimit& limit, Options& options) const;
    void price(const Options& options);

    std::vector<Kind> kinds_;
    const figures::Way* way_ = nullptr;
    std::vector<Class> classes_;          // by kind, role and place
    std::vector<std::uint32_t> present_;  // into them: where somebody is
    std::vector<Options> options_;        // of those
    std::array<double, Exchange::steps> rates_{};
    std::array<Price, Exchange::steps> prices_;
};

}  // namespace render
