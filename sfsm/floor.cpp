#include "sfsm/floor.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

// Of a level.
constexpr double late = 1.1;              // [level] a longer time is not of it
constexpr std::size_t enough = 13;        // times of a window that have to be of it
constexpr double close = 0.015;           // [share] the deviation of times that lie close together
constexpr double same = 0.01;             // [share] by which a level may move and be the same
constexpr double memory = 0.99;           // [share] of what is known of it that counts a frame later
constexpr double follow_rate = 1.0 / 32;  // per time

// Times don't follow the work.
constexpr double harmful = 0.97;                // [target] a lower one keeps nobody from it, and may be a step in cost
constexpr double moved = 0.04, deviations = 4;  // [ln] the least range of work, and [deviations of the times] more
constexpr double much_hidden = 0.4;             // [ln] more than a refresh can hide
constexpr double follows = 0.4;                 // [share of a step of the work] that times would follow by at least
constexpr double sure = 1.5;                    // [standard errors]
constexpr double differences = 3;               // [variances] of the difference of times between stamps that jitter
constexpr double least_deviation = 0.001;       // [share]
constexpr double many_pairs = 60;               // neighbours of a level, older ones counting less
constexpr double paid_back = -0.35;             // correlation of neighbours; between stamps that jitter it is -0.5
constexpr double exactly = 1e-6;                // [share]
constexpr int exact_enough = 4;                 // times

// Of a floor.
constexpr double wider = 1.5;                               // [farthest time of its level] its jitter
constexpr double least_jitter = 0.002, most_jitter = 0.04;  // [share]
constexpr int below_enough = 2, long_ago = 64;              // times below it, or over it, after which it is none
constexpr int longest_wait = 2048;                          // [times] until another may be found
constexpr double most_floors = 8.5;                         // a longer time is a pause
constexpr double strange = -3;                              // [ln odds] of a time between multiples of a period
constexpr double least_score = -12, most_score = 6;         // [ln odds]
constexpr double convincing = 2, surely = 4;                // [ln odds] of a known floor; of a level that isn't one yet
constexpr double fits = 1.045;                              // [target] refreshes up to which fit it

}  // namespace

void Floor::observe(double ms, double log_step, double target_ms) {
    sort_in(ms);
    seen_[next_] = {ms, log_step};
    next_ = (next_ + 1) % history;
    count_ = std::min(count_ + 1, history);
    if (is_found()) follow(ms);
    if (is_exact(ms, target_ms) && !is_found() && wait_ == 0) {
        take({target_ms, 0});
        scores_[0] = surely;
    }
    find(target_ms);
}

bool Floor::is_exact(double ms, double target_ms) {
    const double whole = target_ms > 0 ? std::round(ms / target_ms) : 0;
    const bool is_whole = whole >= 1 && whole <= most_floors && std::abs(ms - whole * target_ms) <= exactly * ms;
    exact_ = is_whole ? std::min(exact_ + 1, exact_enough) : 0;
    return exact_ >= exact_enough;
}

void Floor::follow(double ms) {
    below_ = ms < ms_ - jitter_ms_ ? below_ + 1 : 0;
    over_ = is_at(ms) ? 0 : over_ + 1;
    if (below_ >= below_enough || (over_ > long_ago && period_ms() <= 0)) {
        forget();
    } else if (over_ > 0) {
        scores_ = scored(scores_, ms, {ms_, jitter_ms_});
    } else if (below_ == 0) {
        ms_ += follow_rate * (ms - ms_);
    }
}

// What was one by mistake may look like one again.
void Floor::forget() {
    const int wait = patience_;
    *this = Floor();
    wait_ = wait;
    patience_ = std::min(2 * wait, longest_wait);
}

// The oldest of a full window makes room.
void Floor::sort_in(double ms) {
    auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, window));
    if (end == sorted_.end()) {
        const auto oldest = std::lower_bound(sorted_.begin(), end, newest(window - 1).ms);
        end = std::move(oldest + 1, end, oldest);
    }
    const auto place = std::upper_bound(sorted_.begin(), end, ms);
    std::move_backward(place, end, end + 1);
    *place = ms;
}

// The times of the window that lie close together; none if they don't.
Floor::Level Floor::level() const {
    if (count_ < window) return {};
    Level level;
    level.longest = late * sorted_[window / 2];
    const std::span<const double> times(sorted_.begin(),
                                        std::upper_bound(sorted_.begin(), sorted_.end(), level.longest));
    const double n = static_cast<double>(times.size());
    level.ms = std::accumulate(times.begin(), times.end(), 0.0) / n;
    double squares = 0;
    for (const double ms : times) squares += (ms / level.ms - 1) * (ms / level.ms - 1);
    level.deviation = std::sqrt(squares / n);
    level.farthest = std::max(level.ms - times.front(), times.back() - level.ms);
    return times.size() < enough || level.deviation > close ? Level() : level;
}

// From one frame to the next a load hardly moves, so what moves is the work.
void Floor::extend(Level& level, std::size_t back) const {
    const Seen &now = newest(back), &before = newest(back + 1);
    if (now.ms > level.longest || before.ms > level.longest) return;
    const double step = std::log(now.ms / before.ms);
    const double off = now.ms / level.ms - 1, off_before = before.ms / level.ms - 1;
    level.pairs = memory * level.pairs + 1;
    level.squares = memory * level.squares + off * off;
    level.products = memory * level.products + off * off_before;
    level.steps = memory * level.steps + now.log_step * now.log_step;
    level.response = memory * level.response + now.log_step * step;
    level.path += now.log_step;
    level.lowest = std::min(level.path + memory * (level.lowest - level.path), level.path);
    level.highest = std::max(level.path + memory * (level.highest - level.path), level.path);
}

void Floor::find(double target_ms) {
    wait_ = std::max(wait_ - 1, 0);
    const Level now = level();
    if (now.ms <= 0 || wait_ > 0 || (is_found() && std::abs(now.ms - ms_) <= std::max(same * ms_, jitter_ms_))) return;
    if (level_.ms > 0 && std::abs(now.ms / level_.ms - 1) <= same) {
        extend(level_, 0);
        level_.ms += follow_rate * (now.ms - level_.ms);
        level_.deviation = now.deviation;
    } else {
        level_ = now;
        for (std::size_t back = window - 1; back-- > 0;) extend(level_, back);
    }
    const Place place{now.ms, wider * now.farthest};
    Scores scores{};
    for (std::size_t i = count_; i-- > 0;) scores = scored(scores, newest(i).ms, place);
    const bool is_deaf = is_waiting(level_, target_ms) && !is_undercut(place);
    if (!is_deaf && (is_found() || scores[0] < surely || !has_given_way(now))) return;
    take(place);
    is_deaf_ = is_deaf;
    scores_ = scores;
}

// The times of this level don't follow the work that is predicted for them.
bool Floor::is_waiting(const Level& level, double target_ms) const {
    const double hidden = hidden_by_refresh(level.ms);
    if (!is_found() && level.pairs >= many_pairs && level.products < paid_back * level.squares) return true;
    const double range = level.highest - level.lowest;
    if (level.ms < harmful * target_ms && level.deviation > exactly) return false;
    if (range <= moved + deviations * level.deviation + hidden) return false;
    const double error = std::sqrt(differences / level.steps) * std::max(level.deviation, least_deviation);
    return level.response / level.steps + sure * error < follows;
}

// A shorter time was seen not long ago: this is a step in cost, or a load that has risen.
bool Floor::is_undercut(const Place& place) const {
    for (std::size_t back = 0; back < count_; ++back) {
        if (newest(back).ms < place.ms - place.jitter_ms) return true;
    }
    return false;
}

// The late times have given way to it: else they may be a load that has doubled.
bool Floor::has_given_way(const Level& level) const {
    for (std::size_t back = 0; back < window / 2; ++back) {
        if (newest(back).ms > level.longest) return false;
    }
    return true;
}

// [ln] by how much work may differ between the two refreshes of a time.
double Floor::hidden_by_refresh(double ms) const {
    if (!is_found() || period_ms() <= 0) return 0;
    const double whole = std::round(ms / period_ms());
    if (whole < 2 || std::abs(ms / period_ms() - whole) > most_jitter * ms_ / period_ms()) return 0;
    return much_hidden + std::log(whole / (whole - 1));
}

void Floor::take(const Place& place) {
    ms_ = place.ms;
    jitter_ms_ = std::clamp(place.jitter_ms, least_jitter * ms_, most_jitter * ms_);
    below_ = over_ = 0;
    scores_ = {};
}

// A time near a multiple of a short period is no wonder, of a long one it is.
Floor::Scores Floor::scored(Scores scores, double ms, const Place& place) {
    const double jitter = std::clamp(place.jitter_ms / place.ms, least_jitter, most_jitter);
    if (ms < (1 + 2 * jitter) * place.ms || ms > most_floors * place.ms) return scores;
    for (std::size_t i = 0; i < most_parts; ++i) {
        const double parts = static_cast<double>(i + 1);
        const double periods = parts * ms / place.ms;
        const double off = std::abs(periods - std::round(periods));
        const double odds = off <= parts * jitter ? -std::log(2 * parts * jitter) : strange;
        scores[i] = std::clamp(scores[i] + odds, least_score, most_score);
    }
    return scores;
}

double Floor::period_ms() const {
    for (std::size_t i = 0; i < most_parts; ++i) {
        if (scores_[i] >= convincing) return ms_ / static_cast<double>(i + 1);
    }
    return 0;
}

double Floor::due_ms(double target_ms) const {
    if (!is_found()) return target_ms;
    const double period = period_ms();
    if (period <= 0) return std::max(target_ms, ms_);
    return std::max(ms_, std::floor(fits * target_ms / period) * period);
}

}  // namespace sfsm
