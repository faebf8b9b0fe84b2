#include "sfsm/frame_times/figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sfsm/between.h"
#include "sfsm/frame_times/percentile.h"
#include "sfsm/frame_times/stutters.h"

namespace sfsm {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double ratio(double part, double whole) {
    return whole > 0 ? part / whole : nothing;
}

double ratio(double part, std::int64_t whole) {
    return ratio(part, static_cast<double>(whole));
}

std::vector<double> slowest_first(std::span<const FrameRecord> frames) {
    std::vector<double> times;
    times.reserve(frames.size());
    for (const FrameRecord& frame : frames) {
        if (is_timed(frame)) times.push_back(frame.frame_ms);
    }
    std::sort(times.begin(), times.end(), std::greater<>());
    return times;
}

// Times that are sorted from the slowest, one or more.
class Ranking {
public:
    Ranking(std::span<const double> times, double total_ms) : times_(times), total_ms_(total_ms) {}

    double time(double one_in) const {
        const Place place = place_of(one_in, std::ssize(times_));
        return between(at(place.rank), next(place), place.beyond);
    }
    double rate(double one_in) const {
        const Place place = place_of(one_in, std::ssize(times_));
        return between(rate_of(at(place.rank)), rate_of(next(place)), place.beyond);
    }
    Low low(double one_in) const { return {rate(one_in), rate_of(mean_of_slowest(one_in)), rate_of(integral(one_in))}; }

private:
    double at(std::int64_t rank) const { return times_[static_cast<std::size_t>(rank - 1)]; }
    double next(Place place) const { return at(std::min(place.rank + 1, std::ssize(times_))); }

    double mean_of_slowest(double one_in) const {
        const double count = std::max(1.0, static_cast<double>(times_.size()) / one_in);
        const double whole = std::floor(count);
        double sum = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(whole); ++i) sum += times_[i];
        if (count > whole) sum += (count - whole) * times_[static_cast<std::size_t>(whole)];
        return sum / count;
    }

    double integral(double one_in) const {
        double taken = 0;
        for (const double time : times_) {
            taken += time;
            if (taken >= total_ms_ / one_in) return time;
        }
        return times_.back();
    }

    std::span<const double> times_;
    double total_ms_;
};

void fill_times(Figures& figures, std::span<const double> times, double total_ms) {
    const Ranking ranking(times, total_ms);
    figures.mean_ms = total_ms / static_cast<double>(times.size());
    figures.median_ms = ranking.time(2);
    figures.p99_ms = ranking.time(100);
    figures.p999_ms = ranking.time(1000);
    figures.least_ms = times.back();
    figures.most_ms = times.front();
    figures.average_fps = rate_of(figures.mean_ms);
    figures.median_fps = ranking.rate(2);
    figures.low_1 = ranking.low(100);
    figures.low_01 = ranking.low(1000);
    figures.p1_fps = figures.low_1.percentile;
    figures.p01_fps = figures.low_01.percentile;
    figures.least_fps = rate_of(figures.most_ms);
    figures.most_fps = rate_of(figures.least_ms);
}

void fill_without_times(Figures& figures) {
    for (double Figures::*figure : {&Figures::average_fps, &Figures::median_fps, &Figures::p1_fps, &Figures::p01_fps,
                                    &Figures::least_fps, &Figures::most_fps, &Figures::mean_ms, &Figures::median_ms,
                                    &Figures::p99_ms, &Figures::p999_ms, &Figures::least_ms, &Figures::most_ms})
        figures.*figure = nothing;
    figures.low_1 = figures.low_01 = {nothing, nothing, nothing};
}

void count_fates(Figures& figures, std::span<const FrameRecord> frames) {
    for (const FrameRecord& frame : frames) {
        figures.dropped += frame.fate == FrameRecord::Fate::dropped;
        figures.shown += frame.fate == FrameRecord::Fate::shown;
        figures.displayed += !std::isnan(frame.display_ms);
    }
}

void fill_stutters(Figures& figures, std::span<const FrameRecord> frames, double total_ms) {
    const std::vector<Stutter> stutters = stutters_of(frames);
    double stutter_ms = 0;
    for (const Stutter& stutter : stutters) stutter_ms += stutter.frame_ms;
    figures.stutters = std::ssize(stutters);
    figures.stutter_share = ratio(stutter_ms, total_ms);
    if (figures.timed > 0) figures.stutter_window = stutter_window(figures.mean_ms);
}

std::vector<Over> over_limits(std::span<const double> slowest_first, std::span<const double> limits_ms) {
    std::vector<Over> over;
    for (const double limit : limits_ms) {
        const auto end =
            std::partition_point(slowest_first.begin(), slowest_first.end(), [&](double time) { return time > limit; });
        const std::int64_t frames = end - slowest_first.begin();
        over.push_back({limit, frames, ratio(static_cast<double>(frames), std::ssize(slowest_first))});
    }
    return over;
}

Bottleneck bottleneck_of(std::span<const FrameRecord> frames) {
    Bottleneck result;
    double total_ms = 0;
    for (const FrameRecord& frame : frames) {
        if (!is_timed(frame) || std::isnan(frame.cpu_ms) || std::isnan(frame.gpu_ms)) continue;
        const HeldUpBy who = held_up_by(frame);
        (who == HeldUpBy::gpu ? result.gpu : who == HeldUpBy::cpu ? result.cpu : result.neither) += frame.frame_ms;
        total_ms += frame.frame_ms;
        ++result.frames;
    }
    for (double* share : {&result.gpu, &result.cpu, &result.neither}) *share = ratio(*share, total_ms);
    return result;
}

double mean_step(std::span<const FrameRecord> frames) {
    double sum = 0;
    std::int64_t steps = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (!is_timed(frames[i]) || !is_timed(frames[i - 1])) continue;
        sum += std::abs(frames[i].frame_ms - frames[i - 1].frame_ms);
        ++steps;
    }
    return ratio(sum, steps);
}

double mean_animation_error(std::span<const FrameRecord> frames) {
    double sum = 0;
    std::int64_t told = 0;
    for (const FrameRecord& frame : frames) {
        if (std::isnan(frame.animation_error_ms)) continue;
        sum += std::abs(static_cast<double>(frame.animation_error_ms));
        ++told;
    }
    return ratio(sum, told);
}

}  // namespace

HeldUpBy held_up_by(const FrameRecord& frame) {
    constexpr double busy = 0.9;
    if (!is_timed(frame)) return HeldUpBy::untold;
    const bool has_busy_cpu = frame.cpu_ms >= busy * frame.frame_ms;
    const bool has_busy_gpu = frame.gpu_ms >= busy * frame.frame_ms;
    if (has_busy_gpu && !(frame.cpu_ms > frame.gpu_ms)) return HeldUpBy::gpu;
    if (has_busy_cpu) return HeldUpBy::cpu;
    return std::isnan(frame.cpu_ms) || std::isnan(frame.gpu_ms) ? HeldUpBy::untold : HeldUpBy::neither;
}

Over over_targets(std::span<const FrameRecord> frames, const std::function<double(std::size_t frame)>& target_ms) {
    Over over{nothing, 0, nothing};
    if (!target_ms || frames.empty()) return over;
    const double first_ms = target_ms(0);
    bool is_constant = true;
    std::int64_t timed = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double limit_ms = target_ms(i);
        is_constant = is_constant && limit_ms == first_ms;
        timed += is_timed(frames[i]);
        over.frames += is_timed(frames[i]) && frames[i].frame_ms > limit_ms;
    }
    if (is_constant) over.limit_ms = first_ms;
    over.share = ratio(static_cast<double>(over.frames), timed);
    return over;
}

Figures figures_of(std::span<const FrameRecord> frames, std::int64_t generated, std::span<const double> limits_ms) {
    const std::vector<double> times = slowest_first(frames);
    double total_ms = 0;
    for (const FrameRecord& frame : frames) total_ms += is_timed(frame) ? frame.frame_ms : 0;
    Figures figures;
    figures.frames = std::ssize(frames);
    figures.timed = std::ssize(times);
    figures.generated = generated;
    figures.seconds = total_ms / 1000;
    count_fates(figures, frames);
    times.empty() ? fill_without_times(figures) : fill_times(figures, times, total_ms);
    fill_stutters(figures, frames, total_ms);
    figures.over = over_limits(times, limits_ms);
    figures.bottleneck = bottleneck_of(frames);
    figures.mean_step_ms = mean_step(frames);
    figures.mean_animation_error_ms = mean_animation_error(frames);
    return figures;
}

}  // namespace sfsm
