// What each rate of exchange would draw and lose: classes of visible people, solved by the exchange (exchange.h). A
// class is everybody of one character and about the same size on the screen of whom about the same share shows; for
// motion everybody of one character and role who is about as far.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/error_bounds.h"
#include "render/exchange.h"
#include "render/staleness.h"
#include "render/view.h"
#include "scene/crowd.h"
#include "sfsm/forecast.h"

namespace render {

// How often people move, class by class: update periods [ticks].
class Paces {
public:
    explicit Paces(std::size_t kinds = 0) : periods_(kinds) {}

    static constexpr int places = 32;  // half octaves of pixels that a metre covers, from 2^-4 on
    static int place_of(float pixels_per_metre);

    int& period(std::size_t kind, std::size_t role, int place) {
        return periods_[kind][role][static_cast<std::size_t>(place)];
    }
    auto& all() { return periods_; }
    int period(std::size_t kind, scene::Role role, float pixels_per_metre) const {
        return periods_[kind][static_cast<std::size_t>(role)][static_cast<std::size_t>(place_of(pixels_per_metre))];
    }

private:
    std::vector<std::array<std::array<int, places>, scene::role_count>> periods_;
};

class RateForecaster {
public:
    struct Kind {
        Exchange::Kind exchanged;
        std::array<Staleness, scene::role_count> staleness{};  // by role
        const ErrorBounds* bounds = nullptr;
    };

    RateForecaster() = default;
    // `way` must outlive it. `max_error` [px] > 0: that nobody's surface may be off by more, moved or covered too late
    // or too coarsely; infinite for no such limit.
    RateForecaster(std::vector<Kind> kinds, const figures::Way& way, double max_error);

    const Exchange& exchange() const { return exchange_; }
    const figures::Choices& choices(std::size_t kind) const { return *kinds_[kind].exchanged.choices; }
    bool has_cells() const { return way_->has_cells; }
    // What max_error asks of somebody whose surface [px^2] is that large.
    float least_samples(std::size_t kind, float surface) const;
    bool may_be_splat(std::size_t kind, float surface) const;

    // People who are alike.
    struct Group {
        std::size_t kind = 0;
        scene::Role role{};
        std::int64_t people = 0;
        bool is_block = false;       // who may be drawn as one
        float depth = 0;             // [m] view depth
        float pixels_per_metre = 0;  // there
        float surface = 0;           // [px^2] of each; a quarter is their silhouette
        float share = 1;             // of a silhouette that others of the crowd leave to be seen
        float place = 0;             // Exchange::place_of(share)
        float on_screen = 1;         // share of a silhouette that is on the screen
    };

    // Forgets the last frame.
    void begin(const View& view);
    void add(const Group& group);
    // Of all who were added; valid until the next begin().
    std::span<const sfsm::RateStep> finish();

    // [0, 1] of the picture that people cover.
    double covered() const;
    // After finish(): in which of Exchange::cells() points are added up at a rate.
    std::size_t cell_of(double rate) const { return cells_[static_cast<std::size_t>(Exchange::step_below(rate))]; }
    // After finish(): who moves how often at a rate.
    void find_paces(double rate, Paces& paces) const;

private:
    static constexpr int size_bins = 136;  // quarter octaves of surface, from 2^-8 px^2 on
    struct Bin {
        std::int64_t people = 0;
        double surface = 0, shown = 0;  // [px^2] together; silhouettes' pixels that show
    };
    // Of a kind and a share, those alone and those of blocks.
    struct Row {
        int first = size_bins, last = -1;
        std::array<Bin, size_bins> bins{};
    };
    struct Motion {
        std::int64_t people = 0;
        double shown = 0;  // [px]
        float nearest = 0, pixels_per_metre = 0;
        float largest_pixels = 0;  // that a model unit of somebody covers
    };
    struct Sum {
        double triangles = 0, points = 0, singles = 0, splats = 0, error = 0;
        double sampled = 0;  // [px^2] surfaces of those who are drawn as points or splats
        bool simplified = false;

        double pieces(const figures::Effort& effort) const {
            return effort.triangle * triangles + effort.point * points + effort.single * singles +
                   effort.splat * splats;
        }
    };

    static std::size_t index_of(std::size_t kind, int place, bool is_block) {
        return (kind * Exchange::shares + static_cast<std::size_t>(place)) * 2 + (is_block ? 1 : 0);
    }
    Sum price_shapes(int step, std::size_t& cell) const;
    Sum price_all(const Exchange::Terms& terms) const;
    void price_row(const Row& row, std::size_t kind, int place, bool is_block, const Exchange::Terms& terms,
                   Sum& sum) const;
    void price_motion(int step, sfsm::RateStep& out, double& error);
    bool may_wait(const Kind& kind, std::size_t role, const Motion& motion, int period) const;
    int best_period(const Kind& kind, std::size_t role, const Motion& motion, double rate, int from) const;

    std::vector<Kind> kinds_;
    const figures::Way* way_ = nullptr;
    Exchange exchange_;
    std::vector<std::array<double, size_bins>> mesh_errors_, splat_errors_;  // by kind
    double max_error_ = 0, allowed_ = 0;  // [px] of a person's surface in the middle of the picture
    double pixels_ = 1;
    double shown_ = 0;  // [px]
    std::vector<Row> rows_;
    std::vector<std::array<std::array<Motion, Paces::places>, scene::role_count>> motion_;  // by kind
    Paces paces_;
    std::array<sfsm::RateStep, Exchange::steps> steps_;
    std::array<std::size_t, Exchange::steps> cells_{};
};

}  // namespace render
