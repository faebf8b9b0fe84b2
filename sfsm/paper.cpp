#include "sfsm/paper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sfsm/detail.h"
#include "sfsm/same_bits.h"
#include "sfsm/usable.h"

namespace sfsm {

void PaperConstants::validate() const {
    const auto require = [](bool holds, const char* rule) {
        if (!holds) throw std::invalid_argument(std::string("paper law: expected ") + rule);
    };
    require(h >= 10 && h <= 20, "h in [10, 20] m");
    require(tau > 1 && tau < 2, "tau in (1, 2) px");
    require(first_share > points_share && first_share < 1, "first_share in (points_share, 1)");
    require(nearest_share > 0 && nearest_share < points_share, "nearest_share in (0, points_share)");
    require(return_margin >= 0 && return_margin < 1, "return_margin in [0, 1)");
    require(far_margin >= 0 && std::isfinite(far_margin), "far_margin finite and from 0");
    require(first_patience >= 1, "first_patience from 1");
    require(max_patience >= first_patience, "max_patience from first_patience");
    require(trial >= 1, "trial from 1");
}

bool is_slow(double ms, double target_ms) {
    return ms > target_ms;
}

double first_distance(int i, double range, double first_share) {
    return i == 0 ? range : first_share * range;
}

double secant_step(const Learned& newer, const Learned& older, double target_ms) {
    return (newer.distance - older.distance) * (target_ms - newer.ms) / (newer.ms - older.ms);
}

double secant_distance(const Learned& newer, const Learned& older, double target_ms) {
    return newer.distance + secant_step(newer, older, target_ms);
}

double over_learning_step(double last_step) {
    return -0.5 * last_step;
}

double over_learning_distance(double newer, double older) {
    return newer + over_learning_step(newer - older);
}

double floored_step(double step, double h) {
    return std::copysign(std::max(std::abs(step), h), step);
}

double next_splat_size(double splat_size, double ms, double target_ms, double tau) {
    if (is_slow(ms, target_ms)) return splat_size + tau;
    return ms < target_ms ? splat_size - tau : splat_size;
}

namespace {

using Memory = PaperMemory;
using Constants = PaperConstants;
constexpr State s0 = State::original, s1 = State::slowed, s2 = State::points;
constexpr double whole_range = std::numeric_limits<double>::infinity();  // D = L, wherever L moves

// Guards.

bool slow(const Memory& m, const Constants&) {
    return is_slow(m.ms, m.target_ms);
}

bool fast(const Memory& m, const Constants&) {
    return m.ms < m.target_ms;
}

bool always(const Memory&, const Constants&) {
    return true;
}

// The two remembered times, if a slow frame can follow them: they differ, and a shorter D has meant less time.
bool has_slope(const Memory& m) {
    if (m.learned < 2) return false;
    const double step = secant_step(m.newer, m.older, m.target_ms);
    return std::isfinite(step) && step < 0;
}

bool slow_without_slope(const Memory& m, const Constants& c) {
    return m.i > 0 && m.ms > (1 + c.far_margin) * m.target_ms && !has_slope(m);
}

// Eq. 2 for a slow frame: the fixed start, then the secant; with no slope to follow, down by the least step.
double shorter_distance(const Memory& m, const Constants& c) {
    if (m.i == 0) return first_distance(1, m.range, c.first_share);
    if (!has_slope(m)) return m.newer.distance - c.h;
    return m.newer.distance + floored_step(secant_step(m.newer, m.older, m.target_ms), c.h);
}

// Eq. 6 for a fast frame. Printed, it turns back down when one rise was not enough; ours keeps rising.
double longer_distance(const Memory& m, const Constants& c) {
    const double last_step = m.learned < 2 ? 0 : m.newer.distance - m.older.distance;
    return m.newer.distance + floored_step(std::abs(over_learning_step(last_step)), c.h);
}

bool slow_beyond_state_1(const Memory& m, const Constants& c) {
    return slow(m, c) && shorter_distance(m, c) < c.points_share * m.range;
}

bool is_well_below(const Memory& m, const Constants& c) {
    return m.ms < (1 - c.return_margin) * m.target_ms;
}

bool is_all_moving(const Memory& m) {
    return m.distance >= m.range;
}

bool is_smallest_splat(const Memory& m, const Constants& c) {
    return m.splat - c.tau <= 0;
}

// Nothing is left to give back in this state.
bool is_finest(const Memory& m, const Constants& c) {
    return (m.state == s1 && is_all_moving(m)) || (m.state == s2 && is_smallest_splat(m, c));
}

bool fast_at_full_distance(const Memory& m, const Constants& c) {
    return is_all_moving(m) && m.fast_times >= c.first_patience;
}

bool fast_at_smallest_splat(const Memory& m, const Constants& c) {
    return is_smallest_splat(m, c) && m.fast_times >= m.patience;
}

bool waiting_at_smallest_splat(const Memory& m, const Constants& c) {
    return fast(m, c) && is_smallest_splat(m, c);
}

// Actions.

void stay(Memory&, const Constants&) {}

void begin_episode(Memory& m, const Constants&) {
    m.i = 0;
    m.learned = 0;
    m.distance = whole_range;
}

void shorten(Memory& m, const Constants& c) {
    m.distance = shorter_distance(m, c);
    m.i = 1;
}

void lengthen(Memory& m, const Constants& c) {
    const double distance = longer_distance(m, c);
    m.distance = is_all_moving(m) || distance >= m.range ? whole_range : distance;
}

// S_0 = 0 is the triangles just drawn, so the first splat is already one step of eq. 7.
void enter_points(Memory& m, const Constants& c) {
    const bool has_failed = m.since_return < c.trial;
    m.patience = has_failed ? std::min(2 * m.patience, c.max_patience) : c.first_patience;
    m.distance = shorter_distance(m, c);
    m.splat = next_splat_size(0, m.ms, m.target_ms, c.tau);
}

void change_splat(Memory& m, const Constants& c) {
    m.splat = std::min(next_splat_size(m.splat, m.ms, m.target_ms, c.tau), max_splat_size);
}

// One least step above where edge b leaves, or the first slow frame would go straight back. The times learned before
// belong to another scene by now.
void leave_points(Memory& m, const Constants& c) {
    m.splat = 0;
    m.distance = std::min(c.points_share * m.range + c.h, m.range);
    m.i = 1;
    m.learned = 0;
    m.since_return = 0;
}

void leave_control(Memory& m, const Constants& c) {
    m.patience = c.first_patience;
}

constexpr PaperTransition transitions[] = {
    {"a", s0, s1, slow, begin_episode, "T > t", "D = L", "slow: state 1"},
    {"", s0, s0, always, stay, "else", "stay", "original: meets the target"},

    {"e", s1, s0, fast_at_full_distance, leave_control, "D = L and T < 0.95 t, 3 times running", "D means nothing",
     "fast with all moving: state 0"},
    {"c", s1, s2, slow_without_slope, enter_points, "T > 1.10 t and shortening D has not helped", "S = tau",
     "slow, motion is not the bottleneck: state 2"},
    {"b", s1, s2, slow_beyond_state_1, enter_points, "T > t and the next D < 2/3 L", "S = tau",
     "slow, D below 2/3 L: state 2"},
    {"", s1, s1, slow, shorten, "T > t", "D by eq. 2-4, at least h down", "slow: D down"},
    {"", s1, s1, fast, lengthen, "T < t", "D by eq. 5-6, at least h up, at most L", "fast: D up"},
    {"", s1, s1, always, stay, "else", "stay", "D at the target"},

    {"d", s2, s1, fast_at_smallest_splat, leave_points, "S <= tau and T < 0.95 t, 3 to 128 times running",
     "D = 2/3 L + h", "fast at the smallest S: state 1"},
    {"", s2, s2, waiting_at_smallest_splat, stay, "T < t and S <= tau", "stay", "fast at the smallest S: waiting"},
    {"", s2, s2, slow, change_splat, "T > t", "S + tau, at most 32 px", "slow: S up"},
    {"", s2, s2, fast, change_splat, "T < t", "S - tau", "fast: S down"},
    {"", s2, s2, always, stay, "else", "stay", "S at the target"},
};

// Another time at the same D replaces the old one: two equal distances have no slope.
void learn(Memory& m, const Learned& learned) {
    if (m.learned > 0 && learned.distance == m.newer.distance) {
        m.newer = learned;
        return;
    }
    m.older = m.newer;
    m.newer = learned;
    m.learned = std::min(m.learned + 1, 2);
}

// What the machine remembers of a new time, before the table is asked.
void remember(Memory& m, const Constants& c, const FrameSample& sample) {
    m.ms = sample.ms;
    if (m.state == s1) {
        learn(m, {sample.decision.motion_distance, sample.ms});
        m.since_return = std::min(m.since_return + 1, c.trial);
    }
    m.fast_times = is_finest(m, c) && is_well_below(m, c) ? m.fast_times + 1 : 0;
}

}  // namespace

std::span<const PaperTransition> paper_transitions() {
    return transitions;
}

PaperLaw::PaperLaw(const PaperConstants& constants) : constants_(constants) {
    constants_.validate();
    memory_.range = unknown_range;
    memory_.patience = constants_.first_patience;
    memory_.since_return = constants_.trial;
}

void PaperLaw::reset() {
    PaperLaw fresh(constants_);
    fresh.memory_.range = memory_.range;
    fresh.memory_.target_ms = fresh.status_.target_ms = memory_.target_ms;
    *this = fresh;
}

void PaperLaw::observe(const FrameSample& sample) {
    if (!is_usable(sample.ms)) {
        ++status_.bad_samples;
        return;
    }
    status_.last_ms = sample.ms;
    if (!drawn_.contains(sample.decision)) return;
    answer_ = sample;
    is_answered_ = is_new_ = true;
}

Decision PaperLaw::decide(const FrameRequest& request) {
    if (is_usable(request.range)) memory_.range = request.range;
    bool has_new_target = false;
    if (is_usable(request.target_ms) && request.target_ms != memory_.target_ms) {
        memory_.target_ms = status_.target_ms = request.target_ms;
        memory_.patience = constants_.first_patience;
        memory_.fast_times = 0;
        has_new_target = true;
    }
    status_.kept_for += 1;
    const bool is_ready = memory_.target_ms > 0;
    if (is_ready && (is_new_ || (is_answered_ && has_new_target))) step();
    drawn_.add(status_.decision = decision());
    return status_.decision;
}

void PaperLaw::step() {
    if (is_new_) remember(memory_, constants_, answer_);
    is_new_ = false;
    const PaperMemory before = memory_;
    const auto row =
        std::find_if(std::begin(transitions), std::end(transitions), [&](const PaperTransition& transition) {
            return transition.from == memory_.state && transition.holds(memory_, constants_);
        });  // each state's last row always holds
    row->act(memory_, constants_);
    memory_.state = row->to;
    status_.reason = row->reason;
    status_.kept_for = 0;
    if (memory_.state == before.state && memory_.distance == before.distance && memory_.splat == before.splat) return;
    memory_.fast_times = 0;
    drawn_.clear();
    is_answered_ = false;
}

Decision PaperLaw::decision() const {
    const PaperMemory& m = memory_;
    if (m.state == State::original) return {};
    // L may be so small that its share is 0.
    const double nearest = std::max(constants_.nearest_share * m.range, std::numeric_limits<double>::denorm_min());
    return {m.state, std::clamp(m.distance, nearest, m.range), m.splat};
}

}  // namespace sfsm
