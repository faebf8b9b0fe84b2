#include "sfsm/frame_times/differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "sfsm/between.h"
#include "sfsm/frame_times/figures.h"
#include "sfsm/frame_times/percentile.h"
#include "sfsm/frame_times/stutters.h"
#include "sfsm/random.h"

namespace sfsm {
namespace {

enum Figure { average, median, p1, p01, low_1_integral, stutter_share, figure_count };
using Values = std::array<double, figure_count>;

Values values_of(const Figures& figures) {
    return {figures.average_fps, figures.median_fps,     figures.p1_fps,
            figures.p01_fps,     figures.low_1.integral, figures.stutter_share};
}

using Weights = std::vector<double>;  // how often each block was drawn

double weighed(const Weights& weights, const std::vector<double>& of_blocks) {
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * of_blocks[i];
    return sum;
}

struct TimedFrame {
    double ms = 0;
    std::uint32_t block = 0;
};

// A block begins with the first frame that begins in its part of the time; parts in which none begins have no block.
std::vector<TimedFrame> cut_into_blocks(std::span<const FrameRecord> frames, const Figures& figures) {
    constexpr double usual_seconds = 5, fewest = 20, most = 1000, frames_in_each = 30;
    const double parts = std::floor(std::min(std::clamp(figures.seconds / usual_seconds, fewest, most),
                                             static_cast<double>(figures.timed) / frames_in_each));
    std::vector<TimedFrame> timed;
    timed.reserve(static_cast<std::size_t>(figures.timed));
    const double total_ms = 1000 * figures.seconds;
    double begins_ms = 0, part = 0;
    std::uint32_t block = 0;
    for (const FrameRecord& frame : frames) {
        if (!is_timed(frame)) continue;
        const double now = std::floor(parts * begins_ms / total_ms);
        if (now > part) ++block;
        part = now;
        timed.push_back({frame.frame_ms, block});
        begins_ms += frame.frame_ms;
    }
    return timed;
}

// Where the run as it was has a figure, and how much of what is slower each block has. A draw finds the figure from
// there in a few steps.
struct Mark {
    std::size_t rank = 0;
    std::vector<double> slower;  // a block's frames before `rank`: how many, or their time [ms]
};

// A run from which others are drawn.
class Blocks {
public:
    Blocks(std::span<const FrameRecord> frames, const Figures& figures);

    std::size_t count() const { return frames_.size(); }
    Values drawn(const Weights& weights) const;

private:
    static double one(const TimedFrame&) { return 1; }
    static double time(const TimedFrame& frame) { return frame.ms; }

    void sum_up(std::span<const FrameRecord> frames);
    template <class Amount>
    Mark mark(double share, Amount amount) const;
    template <class Amount>
    double reached(double target, const Mark& mark, const Weights& weights, Amount amount) const;
    double percentile(double one_in, double count, const Mark& mark, const Weights& weights) const;

    std::vector<TimedFrame> sorted_;                // slowest first
    std::vector<double> frames_, ms_, stutter_ms_;  // of each block
    Mark median_, p1_, p01_, integral_;
};

Blocks::Blocks(std::span<const FrameRecord> frames, const Figures& figures)
    : sorted_(cut_into_blocks(frames, figures)) {
    sum_up(frames);
    // Of frames alike the order is told too, so that sums have the same bits everywhere.
    std::sort(sorted_.begin(), sorted_.end(), [](const TimedFrame& a, const TimedFrame& b) {
        return std::tie(b.ms, a.block) < std::tie(a.ms, b.block);
    });
    median_ = mark(0.5, one);
    p1_ = mark(0.01, one);
    p01_ = mark(0.001, one);
    integral_ = mark(0.01, time);
}

// While the frames are still in their order.
void Blocks::sum_up(std::span<const FrameRecord> frames) {
    const std::size_t blocks = sorted_.empty() ? 0 : sorted_.back().block + 1;
    for (std::vector<double>* sums : {&frames_, &ms_, &stutter_ms_}) sums->assign(blocks, 0);
    const std::vector<Stutter> stutters = stutters_of(frames);
    auto stutter = stutters.begin();
    std::size_t timed = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (!is_timed(frames[i])) continue;
        const TimedFrame& frame = sorted_[timed++];
        frames_[frame.block] += 1;
        ms_[frame.block] += frame.ms;
        if (stutter == stutters.end() || stutter->frame != static_cast<std::int64_t>(i)) continue;
        stutter_ms_[frame.block] += frame.ms;
        ++stutter;
    }
}

template <class Amount>
Mark Blocks::mark(double share, Amount amount) const {
    double whole = 0, taken = 0;
    for (const TimedFrame& frame : sorted_) whole += amount(frame);
    Mark mark{0, std::vector<double>(count())};
    for (; mark.rank < sorted_.size() && taken < share * whole; ++mark.rank) {
        const TimedFrame& frame = sorted_[mark.rank];
        mark.slower[frame.block] += amount(frame);
        taken += amount(frame);
    }
    return mark;
}

// The time of the frame at which the slowest drawn, longest first, come to `target`.
template <class Amount>
double Blocks::reached(double target, const Mark& mark, const Weights& weights, Amount amount) const {
    double taken = weighed(weights, mark.slower);
    std::size_t rank = mark.rank;
    const auto drawn = [&] { return weights[sorted_[rank].block] * amount(sorted_[rank]); };
    while (rank > 0 && taken >= target) {
        --rank;
        taken -= drawn();
    }
    while (rank + 1 < sorted_.size() && taken + drawn() < target) {
        taken += drawn();
        ++rank;
    }
    return sorted_[rank].ms;
}

double Blocks::percentile(double one_in, double count, const Mark& mark, const Weights& weights) const {
    const Place place = place_of(one_in, static_cast<std::int64_t>(count));
    const double rank = static_cast<double>(place.rank);
    const double rate = rate_of(reached(rank, mark, weights, one));
    if (place.beyond == 0) return rate;
    return between(rate, rate_of(reached(rank + 1, mark, weights, one)), place.beyond);
}

Values Blocks::drawn(const Weights& weights) const {
    const double frames = weighed(weights, frames_), ms = weighed(weights, ms_);
    Values values;
    values[average] = rate_of(ms / frames);
    values[median] = percentile(2, frames, median_, weights);
    values[p1] = percentile(100, frames, p1_, weights);
    values[p01] = percentile(1000, frames, p01_, weights);
    values[low_1_integral] = rate_of(reached(ms / 100, integral_, weights, time));
    values[stutter_share] = weighed(weights, stutter_ms_) / ms;
    return values;
}

// One block fewer than there are, each as likely as the others: as many as there are would vary too little by their
// spread about their own mean in place of the true one.
void draw(Weights& weights, std::uint64_t seed, int number) {
    const std::uint32_t blocks = static_cast<std::uint32_t>(weights.size());
    std::fill(weights.begin(), weights.end(), 0);
    for (std::uint64_t i = 0; i + 1 < blocks; ++i)
        weights[below(stream(seed, static_cast<std::uint64_t>(number) * blocks + i), blocks)] += 1;
}

std::vector<Values> draws_of(const Blocks& blocks, std::uint64_t seed) {
    std::vector<Values> draws;
    Weights weights(blocks.count());
    for (int i = 0; i < difference_draws; ++i) {
        draw(weights, seed, i);
        draws.push_back(blocks.drawn(weights));
    }
    return draws;
}

double change(double first, double second, bool is_share) {
    return is_share ? second - first : second / first - 1;
}

void fill_interval(Difference& difference, int figure, const std::vector<Values>& first,
                   const std::vector<Values>& second) {
    std::vector<double> changes;
    for (std::size_t i = 0; i < first.size(); ++i)
        changes.push_back(change(first[i][figure], second[i][figure], difference.is_share));
    std::sort(changes.begin(), changes.end());
    const std::size_t outside = changes.size() / 40;  // 2.5 % at either end
    difference.low = changes[outside - 1];
    difference.high = changes[changes.size() - outside];
}

std::vector<Difference> without_intervals(const Values& first, const Values& second) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    const std::array<const char*, figure_count> names = {"average", "median",           "P1",
                                                         "P0.1",    "1 % low integral", "time in stutter"};
    std::vector<Difference> differences;
    for (int i = 0; i < figure_count; ++i) {
        const bool is_share = i == stutter_share;
        differences.push_back({names[i], is_share ? "%" : "fps", first[i], second[i],
                               change(first[i], second[i], is_share), nothing, nothing, is_share});
    }
    return differences;
}

}  // namespace

std::vector<Difference> differences_of(std::span<const FrameRecord> first, std::span<const FrameRecord> second,
                                       std::uint64_t seed) {
    const Figures first_figures = figures_of(first, 0, {}), second_figures = figures_of(second, 0, {});
    std::vector<Difference> differences = without_intervals(values_of(first_figures), values_of(second_figures));
    const Blocks first_blocks(first, first_figures), second_blocks(second, second_figures);
    if (std::min(first_blocks.count(), second_blocks.count()) < fewest_blocks) return differences;
    const std::vector<Values> first_draws = draws_of(first_blocks, hash(seed, 1));
    const std::vector<Values> second_draws = draws_of(second_blocks, hash(seed, 2));
    for (int i = 0; i < figure_count; ++i) fill_interval(differences[i], i, first_draws, second_draws);
    return differences;
}

}  // namespace sfsm
