#include "sfsm/safeguarded.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sfsm/between.h"
#include "sfsm/detail.h"
#include "sfsm/same_bits.h"
#include "sfsm/usable.h"

namespace sfsm {
namespace {

using Memory = SafeguardedMemory;
using Constants = SafeguardedConstants;
constexpr State s0 = State::original, s1 = State::slowed, s2 = State::points;

constexpr double longest_frame = 1e6;  // [ms]; a longer time is a pause of the program, as bad as none
constexpr double first_noise = 0.03;   // before any has been seen
constexpr double least_noise = 0.002, most_noise = 0.3;       // of log T
constexpr double deviation_of_changes = 1.048;                // of a normal: sigma / median |x_i - x_{i-1}|
constexpr double largest_miss = 6.9;                          // of log T: a factor of 1000
constexpr double gentlest_slope = 0.25, steepest_slope = 12;  // of T per detail
constexpr double rising_slope = 6;       // while none is learned: T in proportion to 1 / S, so rises are careful
constexpr double most_slope_change = 3;  // factor, by one step
constexpr double bracket_margin = 0.1;   // of the bracket's width that a step keeps from its ends
constexpr double whole = 0.995;          // detail from which all of it is shown
constexpr double least_step = 0.001;     // of detail

double error_of(const Memory& m) {
    return m.noise / std::sqrt(static_cast<double>(std::max(m.dwell.times, 1)));
}

double miss_of(const Memory& m) {
    return std::clamp(m.dwell.level - m.aim, -largest_miss, largest_miss);
}

// The slope at a detail: that learned, carried along a straight line; else T in proportion to detail on the way down.
double slope_at(const Memory& m, double detail, bool is_rising) {
    if (m.slope == 0) return is_rising ? rising_slope : std::min(1 / std::max(detail, 1e-3), steepest_slope);
    const double moved = 1 + m.slope * (detail - m.slope_detail);
    return std::clamp(moved > 0 ? m.slope / moved : steepest_slope, gentlest_slope, steepest_slope);
}

// Eq. 3 in these terms: where the straight line through the present point meets the target.
double secant_detail(const Memory& m) {
    const double miss = miss_of(m);
    return m.detail + (std::exp(-miss) - 1) / slope_at(m, m.detail, miss < 0);
}

bool is_bracketed(const Memory& m) {
    return m.fast_end.is_known && m.slow_end.is_known;
}

// The secant inside the bracket; half of the bracket when the last step has not halved it.
double bracketed_detail(const Memory& m) {
    const double low = m.fast_end.detail, width = m.slow_end.detail - low;
    if (width > 0.5 * m.width) return low + 0.5 * width;
    const double margin = bracket_margin * width;
    return std::clamp(secant_detail(m), low + margin, low + width - margin);
}

void forget_bracket(Memory& m) {
    m.fast_end = m.slow_end = {};
    m.width = 1;
}

Cost present_cost(const Memory& m) {
    return {true, m.detail, m.dwell.level, error_of(m)};
}

// Learns the slope from `before` to here. A difference in time that may be noise teaches only where a clear one should
// have been seen. Otherwise `before` stays, and the next steps add to the way from there.
void learn_slope(Memory& m, const Constants& c) {
    const Cost before = m.before;
    const double moved = m.detail - before.detail;
    m.before = {};
    if (!before.is_known || std::abs(moved) < least_step) return;
    const double doubt = c.trust * std::hypot(error_of(m), before.error) + c.dead_band;
    const double change = std::clamp(m.dwell.level - before.level, -largest_miss, largest_miss);
    const double old_slope = slope_at(m, m.detail, moved > 0);
    const bool is_clear = std::abs(change) > doubt;
    if (!is_clear && old_slope * std::abs(moved) <= 2 * doubt) {
        m.before = before;
        return;
    }
    m.is_blind = !is_clear && m.state == s1 && moved <= -c.blind_step;
    if (is_clear && (change > 0) != (moved > 0)) return forget_bracket(m);  // another scene
    double slope = is_clear ? (1 - std::exp(-change)) / moved : 0;
    if (m.slope != 0) {
        slope = std::clamp(slope, old_slope / most_slope_change, old_slope * most_slope_change);
        if (is_clear) slope = between(old_slope, slope, 1 - doubt / std::abs(change));
    }
    m.slope = std::clamp(slope, gentlest_slope, steepest_slope);
    m.slope_detail = m.detail;
}

// Whether the scene must have changed since that end of the bracket was measured.
bool contradicts_fast_end(const Memory& m, double doubt) {
    if (!m.fast_end.is_known) return false;
    const bool is_at = m.detail == m.fast_end.detail && m.verdict == Verdict::slow;
    return is_at || m.detail < m.fast_end.detail || m.dwell.level < m.fast_end.level - doubt;
}

bool contradicts_slow_end(const Memory& m, double doubt) {
    if (!m.slow_end.is_known) return false;
    const bool is_at = m.detail == m.slow_end.detail && m.verdict == Verdict::fast;
    return is_at || m.detail > m.slow_end.detail || m.dwell.level > m.slow_end.level + doubt;
}

// The present point becomes an end of the bracket.
void narrow_bracket(Memory& m, const Constants& c) {
    const double doubt = c.trust * error_of(m) + c.dead_band;
    if (m.quiet >= c.settled || contradicts_fast_end(m, doubt) || contradicts_slow_end(m, doubt)) forget_bracket(m);
    if (is_bracketed(m)) m.width = m.slow_end.detail - m.fast_end.detail;
    (m.verdict == Verdict::slow ? m.slow_end : m.fast_end) = present_cost(m);
}

// Where the search for a faster detail began.
void remember_top(Memory& m, const Constants& c) {
    if (m.quiet >= c.settled || m.verdict == Verdict::fast) m.top = {};
    if (m.verdict == Verdict::slow && (!m.top.is_known || m.detail >= m.top.detail)) m.top = present_cost(m);
}

// The detail to try next, within what the state machine allows.
double next_detail(const Memory& m, const Constants& c) {
    double next = secant_detail(m);
    if (is_bracketed(m)) {
        const bool has_jump = m.slow_end.detail - m.fast_end.detail < c.least_width;
        next = has_jump ? m.fast_end.detail : bracketed_detail(m);
    }
    if (m.verdict == Verdict::slow && m.is_blind && !m.fast_end.is_known) {
        next = std::min(next, detail_of_points * std::exp(-miss_of(m)));
    }
    if (next > whole) next = 1;
    const bool is_return = m.state == s2 && next >= detail_of_points;
    const bool is_allowed = next >= detail_of_points + c.return_margin && m.since_points >= m.wait;
    if (is_return && !is_allowed) next = std::nextafter(detail_of_points, 0.0);
    return std::clamp(next, 0.0, 1.0);
}

bool differs(const Memory& m, const Constants& c, double level, double share) {
    return m.dwell.times >= 2 && std::abs(m.dwell.level - level) > share + c.trust * error_of(m);
}

void end_hold(Memory& m, int next_hold) {
    m.is_held = false;
    m.hold = next_hold;
    m.quiet = 0;
}

// A hold ends when times have moved, or for a trial when it has lasted long enough.
void watch_hold(Memory& m, const Constants& c) {
    if (!m.is_held) return;
    if (differs(m, c, m.held_level, c.same_level)) {
        forget_bracket(m);
        end_hold(m, c.hold);
    } else if (m.held_times >= m.hold) {
        end_hold(m, std::min(2 * m.hold, c.longest_wait));
        m.is_trial = true;
    }
}

// The verdict on the present times, and where it leads; before the table is asked.
void weigh(Memory& m, const Constants& c) {
    m.verdict = Verdict::fine;
    m.next = m.detail;
    m.aim = m.target - c.headroom * m.noise;
    watch_hold(m, c);
    if (!m.is_held && differs(m, c, m.aim, c.dead_band)) {
        m.verdict = m.dwell.level > m.aim ? Verdict::slow : Verdict::fast;
    }
    if (m.quiet >= c.settled) m.before = {};  // of another scene by now
    if (m.verdict != Verdict::fine || m.dwell.times == c.settled) learn_slope(m, c);
    if (m.verdict == Verdict::fine) {
        m.quiet = std::min(m.quiet + 1, c.settled);
        if (m.quiet >= c.settled) m.is_doubted = false;
        return;
    }
    narrow_bracket(m, c);
    remember_top(m, c);
    const bool is_retry = m.is_trial && m.verdict == Verdict::fast && m.slow_end.is_known;
    m.next = is_retry ? m.slow_end.detail : next_detail(m, c);
    m.is_trial = false;
    m.quiet = 0;
}

// Guards.

bool always(const Memory&, const Constants&) {
    return true;
}

bool is_slow_towards(const Memory& m, double from, double to) {
    return m.verdict == Verdict::slow && m.next >= from && m.next < to && m.next < m.detail;
}

bool slow_towards_distance(const Memory& m, const Constants&) {
    return is_slow_towards(m, detail_of_points, 1);
}

bool slow_towards_points(const Memory& m, const Constants&) {
    return is_slow_towards(m, 0, detail_of_points);
}

bool is_fast_towards(const Memory& m, double from, double to) {
    return m.verdict == Verdict::fast && m.next >= from && m.next < to && m.next > m.detail;
}

bool fast_towards_original(const Memory& m, const Constants&) {
    return m.verdict == Verdict::fast && m.next == 1;
}

bool fast_towards_distance(const Memory& m, const Constants&) {
    return is_fast_towards(m, detail_of_points, 1);
}

bool fast_towards_points(const Memory& m, const Constants&) {
    return is_fast_towards(m, 0, detail_of_points);
}

bool held(const Memory& m, const Constants&) {
    return m.is_held;
}

// Nothing finer meets the target, although this leaves time.
bool fast_below_a_jump(const Memory& m, const Constants&) {
    return m.verdict == Verdict::fast && is_bracketed(m) && m.since_points >= m.wait;
}

// A jump so high may be a load that came and went meanwhile.
bool fast_below_a_doubtful_jump(const Memory& m, const Constants& c) {
    const bool is_known = m.is_doubted || m.hold > c.hold;
    return fast_below_a_jump(m, c) && !is_known && m.slow_end.level - m.fast_end.level > c.doubted_jump;
}

// Even the coarsest has not helped.
bool slow_without_gain(const Memory& m, const Constants& c) {
    return m.verdict == Verdict::slow && m.detail == 0 && m.top.is_known && m.dwell.times >= c.settled &&
           m.dwell.level > m.top.level - c.no_gain * m.top.detail;
}

bool no_gain_from_original(const Memory& m, const Constants& c) {
    return slow_without_gain(m, c) && m.top.detail == 1;
}

bool no_gain_from_distance(const Memory& m, const Constants& c) {
    return slow_without_gain(m, c) && m.top.detail >= detail_of_points;
}

// Actions.

void stay(Memory&, const Constants&) {}

void move(Memory& m, const Constants&) {
    if (!m.before.is_known) m.before = present_cost(m);
    m.detail = m.next;
    m.dwell = {};
    m.quiet = 0;
    m.is_blind = false;
}

// A return to triangles that lasted too short makes the next wait longer.
void enter_points(Memory& m, const Constants& c) {
    const bool has_failed = m.since_return < c.trial;
    m.wait = has_failed ? std::clamp(2 * m.wait, c.first_patience, c.longest_wait) : 0;
    m.since_points = 0;
    move(m, c);
}

void leave_points(Memory& m, const Constants& c) {
    m.since_return = 0;
    move(m, c);
}

void hold_level(Memory& m, double level) {
    m.is_held = true;
    m.held_level = level;
    m.held_times = 0;
}

void hold_here(Memory& m, const Constants&) {
    hold_level(m, m.dwell.level);
}

void measure_again(Memory& m, const Constants&) {
    forget_bracket(m);
    m.is_doubted = true;
}

void give_back(Memory& m, const Constants& c) {
    hold_level(m, m.top.level);
    m.next = m.top.detail;
    leave_points(m, c);
    m.before = {};
    forget_bracket(m);
    m.top = {};
}

constexpr SafeguardedTransition transitions[] = {
    {"a", s0, s1, slow_towards_distance, move, "slow, next detail from 2/3", "D by the secant", "slow: state 1"},
    {"c", s0, s2, slow_towards_points, enter_points, "slow, next detail below 2/3", "S by the secant", "slow: state 2"},
    {"", s0, s0, held, stay, "held", "stay", "less detail does not help: waiting in state 0"},
    {"", s0, s0, always, stay, "else", "stay", "original: no miss beyond the noise"},

    {"e", s1, s0, fast_towards_original, move, "fast, next detail 1", "D means nothing", "fast: state 0"},
    {"b", s1, s2, slow_towards_points, enter_points, "slow, next detail below 2/3 or shortening D has not helped",
     "S by the secant", "slow beyond state 1: state 2"},
    {"", s1, s1, slow_towards_distance, move, "slow", "D by the secant, inside the bracket", "slow: D down"},
    {"", s1, s1, fast_towards_distance, move, "fast", "D by the secant, inside the bracket", "fast: D up"},
    {"", s1, s1, held, stay, "held", "stay", "held: waiting in state 1"},
    {"", s1, s1, fast_below_a_doubtful_jump, measure_again,
     "fast, and all finer detail was slow by more than a factor of 2", "forget the bracket, once",
     "fast, anything finer was very slow: once more"},
    {"", s1, s1, fast_below_a_jump, hold_here, "fast, and all finer detail is slow", "hold",
     "fast, anything finer is slow: hold D"},
    {"", s1, s1, always, stay, "else", "stay", "D: no miss beyond the noise"},

    {"f", s2, s0, fast_towards_original, leave_points, "fast, next detail 1", "D means nothing",
     "fast beyond state 1: state 0"},
    {"d", s2, s1, fast_towards_distance, leave_points, "fast, next detail from 2/3 + margin, and the wait is over",
     "D by the secant", "fast: state 1"},
    {"g", s2, s0, no_gain_from_original, give_back, "slow at the largest S, in vain since detail 1",
     "back to where the search began, hold", "less detail does not help: back to state 0"},
    {"h", s2, s1, no_gain_from_distance, give_back, "the same since a detail from 2/3",
     "back to where the search began, hold", "less detail does not help: back to state 1"},
    {"", s2, s2, slow_without_gain, give_back, "the same since a detail below 2/3",
     "back to where the search began, hold", "less detail does not help: back to the finer S"},
    {"", s2, s2, slow_towards_points, move, "slow", "S by the secant, inside the bracket", "slow: S up"},
    {"", s2, s2, fast_towards_points, move, "fast", "S by the secant, inside the bracket", "fast: S down"},
    {"", s2, s2, held, stay, "held", "stay", "held: waiting in state 2"},
    {"", s2, s2, fast_below_a_doubtful_jump, measure_again,
     "fast, and all finer detail was slow by more than a factor of 2", "forget the bracket, once",
     "fast, anything finer was very slow: once more"},
    {"", s2, s2, fast_below_a_jump, hold_here, "fast, and all finer detail is slow", "hold",
     "fast, anything finer is slow: hold S"},
    {"", s2, s2, always, stay, "else", "stay", "S: no miss beyond the noise"},
};

// A hitch is one time that is far off, followed by one that is not. Two in a row that are off to the same side are
// another level: that of the nearer one.
void remember(Memory& m, const Constants& c, double level) {
    Dwell& dwell = m.dwell;
    const double away = level - dwell.level;
    if (dwell.times > 0 && std::abs(away) > c.outlier * m.noise) {
        const double before = dwell.hitch - dwell.level;
        const bool is_confirmed = dwell.has_hitch && (before > 0) == (away > 0);
        dwell.has_hitch = !is_confirmed;
        dwell.hitch = level;
        if (!is_confirmed) return;
        dwell.level += std::abs(before) < std::abs(away) ? before : away;
        dwell.times = 2;
        if (m.quiet >= c.settled) m.wait = 0;  // another scene
        return;
    }
    dwell.has_hitch = false;
    dwell.times = std::min(dwell.times + 1, c.horizon);
    dwell.level += away / dwell.times;
}

void count_time(Memory& m, const Constants& c) {
    m.since_return = std::min(m.since_return + 1, c.trial);
    m.since_points = std::min(m.since_points + 1, c.longest_wait);
    m.held_times = std::min(m.held_times + 1, c.longest_wait);
}

}  // namespace

void SafeguardedConstants::validate() const {
    const auto require = [](bool holds, const char* rule) {
        if (!holds) throw std::invalid_argument(std::string("safeguarded law: expected ") + rule);
    };
    require(dead_band >= 0 && dead_band <= 0.2, "dead_band in [0, 0.2]");
    require(headroom >= 0 && headroom <= 3, "headroom in [0, 3]");
    require(trust >= 1 && trust <= 6, "trust in [1, 6]");
    require(outlier >= trust && outlier <= 20, "outlier in [trust, 20]");
    require(horizon >= 8 && horizon <= 4096, "horizon in [8, 4096]");
    require(settled >= 2 && settled <= horizon, "settled in [2, horizon]");
    require(blind_step > 0 && blind_step < 1.0 / 3, "blind_step in (0, 1/3)");
    require(no_gain > 0 && no_gain < 1, "no_gain in (0, 1)");
    require(same_level > 0 && same_level < 1, "same_level in (0, 1)");
    require(doubted_jump > 0, "doubted_jump over 0");
    require(least_width > 0 && least_width < 0.1, "least_width in (0, 0.1)");
    require(return_margin >= 0 && return_margin < 1.0 / 3, "return_margin in [0, 1/3)");
    require(first_patience >= 1, "first_patience from 1");
    require(trial >= 1, "trial from 1");
    require(hold >= 1, "hold from 1");
    require(longest_wait >= first_patience && longest_wait >= hold && longest_wait <= 1 << 29,
            "longest_wait from first_patience and hold to 2^29");
}

std::span<const SafeguardedTransition> safeguarded_transitions() {
    return transitions;
}

SafeguardedLaw::SafeguardedLaw(const SafeguardedConstants& constants) : constants_(constants) {
    constants_.validate();
    memory_.noise = first_noise;
    memory_.hold = constants_.hold;
    memory_.since_return = constants_.trial;
    changes_.fill(first_noise / deviation_of_changes);
}

void SafeguardedLaw::observe(const FrameSample& sample) {
    if (!is_usable(sample.ms) || sample.ms > longest_frame) {
        ++status_.bad_samples;
        return;
    }
    status_.last_ms = sample.ms;
    if (!drawn_.contains(sample.decision)) return;
    const double level = std::log(sample.ms);
    if (has_last_) {
        std::rotate(changes_.begin(), changes_.end() - 1, changes_.end());
        changes_.front() = std::abs(level - last_level_);
        change_count_ = std::min(change_count_ + 1, changes_.size());
        memory_.noise = robust_noise();
    }
    last_level_ = level;
    has_last_ = true;
    count_time(memory_, constants_);
    remember(memory_, constants_, level);
    is_new_ = true;
}

double SafeguardedLaw::robust_noise() const {
    auto sorted = changes_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(change_count_);
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(change_count_ / 2);
    std::nth_element(sorted.begin(), middle, end);
    return std::clamp(deviation_of_changes * *middle, least_noise, most_noise);
}

Decision SafeguardedLaw::decide(const FrameRequest& request) {
    if (is_usable(request.range)) range_ = request.range;
    if (is_usable(request.target_ms) && request.target_ms != status_.target_ms) retarget(request.target_ms);
    status_.kept_for += 1;
    if (is_new_ && status_.target_ms > 0) step();
    is_new_ = false;
    drawn_.add(status_.decision = decision_at(memory_.detail, range_));
    return status_.decision;
}

void SafeguardedLaw::reset() {
    SafeguardedLaw fresh(constants_);
    fresh.range_ = range_;
    if (status_.target_ms > 0) fresh.retarget(status_.target_ms);
    *this = fresh;
}

// The slope that was learned stays. The bracket, waits and holds belong to the old target and are forgotten.
void SafeguardedLaw::retarget(double target_ms) {
    status_.target_ms = target_ms;
    memory_.target = std::log(target_ms);
    memory_.wait = 0;
    memory_.top = {};
    memory_.is_doubted = memory_.is_trial = false;
    forget_bracket(memory_);
    end_hold(memory_, constants_.hold);
    is_new_ = true;
}

void SafeguardedLaw::step() {
    weigh(memory_, constants_);
    const auto row = std::find_if(std::begin(transitions), std::end(transitions), [&](const auto& transition) {
        return transition.from == memory_.state && transition.holds(memory_, constants_);
    });  // each state's last row always holds
    const double detail = memory_.detail;
    row->act(memory_, constants_);
    memory_.state = row->to;
    status_.reason = row->reason;
    status_.kept_for = 0;
    if (memory_.detail == detail) return;
    drawn_.clear();
    has_last_ = false;
}

}  // namespace sfsm
