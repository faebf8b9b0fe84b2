// What each rate of exchange would draw and lose: classes of visible people, solved by the exchange (exchange.h). A
// class is everybody of one character and about the same size on the screen of whom about the same share shows; how
// they move is of other classes (paces.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/error_bounds.h"
#include "render/error_limit.h"
#include "render/exchange.h"
#include "render/paces.h"
#include "render/size_sums.h"
#include "render/staleness.h"
#include "render/view.h"
#include "scene/crowd.h"
#include "sfsm/forecast.h"

namespace render {

class RateForecaster {
public:
    struct Kind {
        Exchange::Kind exchanged;
        std::array<Staleness, scene::role_count> staleness{};  // by role
        const ErrorBounds* bounds = nullptr;
        float reach = 0;  // of a person from their middle [model units]
    };

    RateForecaster() = default;
    // `way` must outlive it.
    RateForecaster(std::vector<Kind> kinds, const figures::Way& way);

    const Exchange& exchange() const { return exchange_; }
    const figures::Choices& choices(std::size_t kind) const { return *kinds_[kind].exchanged.choices; }
    const ErrorBounds& bounds(std::size_t kind) const { return *kinds_[kind].bounds; }
    bool has_cells() const { return way_->has_cells; }

    // Of somebody whose surface may be drawn so far off [model units]: points that they need at least, infinite if no
    // number will do; and whether they may be a splat.
    float least_samples(std::size_t kind, float allowed) const;
    bool may_be_splat(std::size_t kind, float allowed) const;

    // People who are alike.
    struct Group {
        std::size_t kind = 0;
        scene::Role role{};
        std::int64_t people = 0;
        bool is_block = false;       // who may be drawn as one
        bool is_near = false;        // who are meshes at any rate
        float depth = 0;             // [m] view depth
        float pixels_per_metre = 0;  // there
        float surface = 0;           // [px^2] of each; a quarter is their silhouette
        float share = 1;             // of a silhouette that others of the crowd leave to be seen
        float place = 0;             // Exchange::place_of(share)
        float on_screen = 1;         // share of a silhouette that is on the screen
    };

    // Forgets the last frame. `limit`: of that view.
    void begin(const View& view, const ErrorLimit& limit);
    void add(const Group& group);
    // Of all who were added; valid until the next begin(). A step each of the exchange, and one just below those at
    // which cells change.
    std::span<const sfsm::RateStep> finish();

    // [px] of the picture, or what people show together where that is more: several at the eye each fill it.
    double canvas_px() const;
    // [0, 1] of the picture that people cover.
    double covered() const;
    // After finish(): in which of Exchange::cells() points are added up at a rate.
    std::size_t cell_of(double rate) const { return cells_[static_cast<std::size_t>(Exchange::step_below(rate))]; }
    // After finish(): who moves how often at a rate.
    void find_paces(double rate, Paces& paces) const { movers_.find(rate, paces); }

private:
    static constexpr int size_bins = 136;  // quarter octaves of surface, from 2^-8 px^2 on
    using Bins = std::array<double, size_bins>;
    // Of a kind and a share, those alone and those of blocks.
    struct Row {
        std::size_t column = 0;
        int first = size_bins, last = -1;
        std::array<SizeBin, size_bins> bins{};
    };
    static_assert(Exchange::cell_sides.size() <= SizeSums::most_cells);
    // What never changes of a kind. Errors are those of people of a bin's size.
    struct Prices {
        double triangles = 0, fewest = 0, most = 0;  // of a person; points under no limit
        Bins mesh_errors{}, splat_errors{};
        bool by_ones = true;  // any number of points; else as levels_ from a place on, step by step
        std::size_t first_levels = 0;
    };
    // Of a person of a bin's size as points: at least so many, and the errors of so many, or of all, by cell.
    struct Ends {
        Bins fewest{};
        std::vector<Bins> few_errors, most_errors;
        double mesh_from = size_bins, splat_to = size_bins;  // bins, for the limit's sake
    };
    // Points that come in levels: of a person of a bin's size at a step, and their error.
    struct Levels {
        Bins counts{}, errors{};
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
    // Everybody in cells of a size.
    struct InCells {
        std::size_t cell;
        Sum sum;
    };
    // What prices a row at a step.
    struct Setting {
        std::size_t step, cell;
        double square, error;  // [px^2] that a point stands for, and what it loses
        std::size_t borders;   // in borders_, from where on by column
    };
    // Who has a share: rows that are priced by their sums, and by their bins.
    struct Share {
        std::vector<SizedRow> summed;    // any number of points, under no limit
        std::vector<const Row*> binned;  // the others
    };

    // Of each kind are those alone and those of blocks.
    static std::size_t column_of(std::size_t kind, bool is_block) { return 2 * kind + (is_block ? 1 : 0); }
    std::size_t columns() const { return 2 * kinds_.size(); }
    static void add_to(Row& row, std::size_t bin, const SizeBin& people);
    void know_kinds();
    void know_settings();
    void know_borders(const Setting& setting, std::size_t kind, const Exchange::Terms::Sizes& sizes);
    void know_levels();
    void know_weights();
    void find_ends(std::size_t kind, const ErrorLimit& limit);
    void sort_rows();
    SizedRow sum_up(const Row& row, SizeSums* below) const;
    void add_step(double rate, const Sum& sum, const PaceForecaster::Price& moves);
    InCells best_cells(std::size_t step, const InCells& now) const;
    Sum price_all(std::size_t step, std::size_t cell) const;
    void price_parts(const SizeParts& parts, const Setting& setting, Sum& sum) const;
    void price_bins(const Row& row, const Setting& setting, Sum& sum) const;
    void describe(const Sum& sum, const PaceForecaster::Price& moves, sfsm::RateStep& out) const;

    std::vector<Kind> kinds_;
    const figures::Way* way_ = nullptr;
    Exchange exchange_;
    std::vector<Prices> prices_;  // by kind
    std::vector<Ends> ends_;      // by kind
    std::vector<Levels> levels_;
    std::vector<Setting> settings_;     // by cell, step and share
    std::vector<SizeBorders> borders_;  // by setting and column
    std::vector<SizeSums> weights_;     // by kind and bin
    bool is_limited_ = false;           // the last frame was
    double pixels_ = 1;
    double shown_ = 0;             // [px]
    std::vector<Row> rows_;        // by share and column
    std::vector<SizeSums> below_;  // row after row
    std::array<Share, Exchange::shares> shares_;
    Sum near_;
    PaceForecaster movers_;
    ErrorLimit limit_;
    std::vector<sfsm::RateStep> steps_;
    std::array<std::size_t, Exchange::steps> cells_{};
};

}  // namespace render
