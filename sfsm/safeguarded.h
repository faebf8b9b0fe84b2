// The paper's law made safe. It measures the same (frame times), has the same knobs (D, S) and the same three states,
// and no forecast; what breaks the printed law is cured. It takes a step when the times of the present decision differ
// from the target by more than their noise. The step is a secant step, kept between a detail known to be too slow and
// one known to be fast enough (the bracket). docs/controller.md tells the story and shows the table.
#pragma once

#include <array>
#include <span>

#include "sfsm/controller.h"
#include "sfsm/detail.h"
#include "sfsm/drawn.h"

namespace sfsm {

struct SafeguardedConstants {
    double dead_band = 0.005;     // [share of t] a miss up to this is none, [0, 0.2]
    double headroom = 0.3;        // [sigmas of one time] that frames are aimed below t, [0, 3]
    double trust = 3;             // [standard errors] a smaller difference may be noise, [1, 6]
    double outlier = 5;           // [sigmas of one time] one time alone beyond this is a hitch, [trust, 20]
    int horizon = 64;             // [times] of an unchanged decision that are averaged, [8, 4096]
    int settled = 16;             // [times] without a miss; the next miss then means another scene, [2, horizon]
    double blind_step = 0.05;     // [detail] a step of D this long without effect: D has no power, (0, 1/3)
    double no_gain = 0.05;        // [share of time] detail that gains less than this is given back, (0, 1)
    double same_level = 0.05;     // [share of time] a hold ends when times have moved by more, (0, 1)
    double least_width = 0.002;   // [detail] a bracket this narrow has a jump in it, (0, 0.1)
    double doubted_jump = 0.75;   // [log T] a higher one is measured twice: its slow end may be of another load, > 0
    double return_margin = 0.01;  // [detail] over 2/3 that a return from state 2 needs, [0, 1/3)
    int first_patience = 16;      // [times] to wait after a failed return from state 2, doubled by each, >= 1
    int trial = 64;               // [times] that a return from state 2 must last, or it has failed, >= 1
    int hold = 2048;              // [times] that a hold lasts, doubled by each in a row, >= 1
    int longest_wait = 32768;     // [times] the most that doubling comes to, >= first_patience and hold

    // Throws std::invalid_argument naming the first broken rule.
    void validate() const;
};

// The times drawn with one detail, as logarithms of ms. A hitch is kept apart until the next time confirms it.
struct Dwell {
    int times = 0;     // that count; at most the horizon
    double level = 0;  // their mean
    double hitch = 0;  // waits to be confirmed
    bool has_hitch = false;
};

// What one detail has cost: a level [log ms], and one standard error of it.
struct Cost {
    bool is_known = false;
    double detail = 0;
    double level = 0;
    double error = 0;
};

// On the times of the present detail.
enum class Verdict { fine, slow, fast };

// What the machine remembers; the guards and actions of the table are functions of it.
struct SafeguardedMemory {
    State state = State::original;
    double detail = 1;  // [0, 1], sfsm/detail.h
    double target = 0;  // log t
    double aim = 0;     // that less the headroom
    double noise = 0;   // standard deviation of log T, robust
    Dwell dwell;
    int quiet = 0;  // [times] since the last step or miss; at most `settled`
    Verdict verdict = Verdict::fine;
    double next = 1;   // detail that the verdict asks for
    double slope = 0;  // (dT / d detail) / T at slope_detail; 0: none learned
    double slope_detail = 1;
    Cost fast_end, slow_end;  // the bracket
    double width = 1;         // of the bracket, one step ago
    Cost before;              // the point that the next slope is measured from
    Cost top;                 // the point that the search for less detail began at
    bool is_blind = false;    // the last step in state 1 had no effect
    bool is_doubted = false;  // the jump that was found last is being measured again
    bool is_held = false;     // nothing better is near: wait
    bool is_trial = false;    // the hold has lasted long enough: try the slow end again
    double held_level = 0;    // [log ms] of the times when the hold began
    int held_times = 0;       // [times] since then
    int hold = 0;             // [times] that the hold lasts
    int since_return = 0;     // [times] since state 2 was last left
    int wait = 0;             // [times] that the next return must wait
    int since_points = 0;     // [times] since state 2 was last entered
};

// The first row of the present state whose guard holds is taken, once for every time that answers the last decision and
// for every change of target.
struct SafeguardedTransition {
    const char* edge;  // "a".."h" between states, "" within one
    State from, to;
    bool (*holds)(const SafeguardedMemory&, const SafeguardedConstants&);
    void (*act)(SafeguardedMemory&, const SafeguardedConstants&);
    const char* when;    // the guard, in words
    const char* then;    // the action, in words
    const char* reason;  // for Status
};
std::span<const SafeguardedTransition> safeguarded_transitions();

// Decisions lie on the axis of sfsm/detail.h: D is a share of L wherever L moves, and S is in [0.5, 32] px. A time
// counts for the decision it was drawn with, up to 32 distinct decisions late; times of earlier answers are ignored.
// Cost: under 1 us a frame.
class SafeguardedLaw final : public Controller {
public:
    explicit SafeguardedLaw(const SafeguardedConstants& constants = {});  // throws as validate() does

    void observe(const FrameSample& sample) override;
    Decision decide(const FrameRequest& request) override;
    void reset() override;
    const Status& status() const override { return status_; }
    const SafeguardedMemory& memory() const { return memory_; }

private:
    void retarget(double target_ms);
    void step();
    double robust_noise() const;

    SafeguardedConstants constants_;
    SafeguardedMemory memory_;
    Status status_;
    double range_ = unknown_range;      // L [m]
    std::array<double, 32> changes_{};  // |log T_i - log T_{i-1}| of equal decisions, newest first
    std::size_t change_count_ = 8;      // the first ones are assumed
    double last_level_ = 0;             // log of the newest time of the present detail
    bool has_last_ = false;             // there is one
    DrawnDecisions drawn_;              // since the last step
    bool is_new_ = false;               // a time or a target to judge
};

}  // namespace sfsm
