// The law of Lyu, Zhang and Fan 2018 ("SFSM"), section 3.3, with its errata corrected: equations 2-7 as functions, the
// state machine as one table, and the controller that runs it. It keeps what is weak in the printed law: D never
// settles closer than h and S never closer than tau, and every single time is trusted. docs/controller.md tells the
// story. Equation 1, which turns D into who moves, is motion/schedule.h.
#pragma once

#include <array>
#include <span>

#include "sfsm/controller.h"
#include "sfsm/drawn.h"

namespace sfsm {

struct PaperConstants {
    // The paper's.
    double h = 15;                  // [m] smallest step of D, [10, 20]
    double tau = 1.5;               // [px] step of S, (1, 2)
    double first_share = 5.0 / 6;   // D_1 / L
    double points_share = 2.0 / 3;  // D / L below which people become points

    // Ours, where the paper is silent: hysteresis of the way back.
    double nearest_share = 1.0 / 6;  // D / L is never less: who is that near always moves, (0, points_share)
    double return_margin = 0.05;     // [share of t] below t that times must be for the way back, [0, 1)
    double far_margin = 0.10;        // [share of t] over t from which motion is no bottleneck if D has no effect, >= 0
    int first_patience = 3;          // [times] in a row that fast before the way back is taken, >= 1
    int max_patience = 128;          // [times] the most that failed returns from state 2 raise it to, >= first_patience
    int trial = 16;                  // [times] that a return from state 2 must last, or it has failed, >= 1

    // Throws std::invalid_argument naming the first broken rule.
    void validate() const;
};

// A distance [m] and the time [ms] that frames drawn with it took.
struct Learned {
    double distance = 0;
    double ms = 0;
};

// Erratum E1: learning is for frames that miss the expected rate, which is T > t (printed: T < t).
bool is_slow(double ms, double target_ms);

// Eq. 2, i = 0 and 1: D_0 = L, D_1 = 5/6 L. Erratum E3: i counts from 0 (the text around it counts from 1).
double first_distance(int i, double range, double first_share);

// Eq. 3: dD_i = dD_{i-1} (t - T_{i-1}) / (T_{i-1} - T_{i-2}), the secant step for T(D) = t. Not finite for equal times.
double secant_step(const Learned& newer, const Learned& older, double target_ms);

// Eq. 4: D_i = D_{i-1} + dD_i. Erratum E2: eq. 2 for i > 1 is this, its printed weights sum to -1.
double secant_distance(const Learned& newer, const Learned& older, double target_ms);

// Eq. 5: dD_i = -1/2 dD_{i-1}, after a step that has made frames faster than the target.
double over_learning_step(double last_step);

// Eq. 6, the same for D: D_i = (D_{i-1} + D_{i-2}) / 2; 11/12 L for i = 2.
double over_learning_distance(double newer, double older);

// The step with its sign and at least `h` long (below eq. 6).
double floored_step(double step, double h);

// Eq. 7: S + tau when slow, S - tau when fast, S at the target. Not limited to [0, max_splat_size].
double next_splat_size(double splat_size, double ms, double target_ms, double tau);

// What the machine remembers; the guards and actions of the table are functions of it.
struct PaperMemory {
    State state = State::original;
    double target_ms = 0;  // t
    double range = 0;      // L [m]
    double ms = 0;         // T_{i-1}: the newest time that was drawn with the newest decision
    double distance = 0;   // D [m], before it is limited to [nearest_share L, L]; infinite: L
    double splat = 0;      // S [px]
    Learned newer, older;  // the last two different distances learned in this episode
    int learned = 0;       // how many of the two there are
    int i = 0;             // of eq. 2; 1 stands for all i > 0
    int fast_times = 0;    // in a row below the return margin, while this state has no finer decision
    int patience = 0;      // how many of them state 2 asks for before it returns
    int since_return = 0;  // times in state 1 since state 2 was last left; at most PaperConstants::trial
};

// The first row of the present state whose guard holds is taken, once for every time that answers the last decision.
struct PaperTransition {
    const char* edge;  // "a".."e" between states, "" within one
    State from, to;
    bool (*holds)(const PaperMemory&, const PaperConstants&);
    void (*act)(PaperMemory&, const PaperConstants&);
    const char* when;    // the guard, in words
    const char* then;    // the action, in words
    const char* reason;  // for Status
};
std::span<const PaperTransition> paper_transitions();

// Takes one step for each time that was drawn with its newest decision. A late time that answers an older decision is
// no step, so one measurement is never stepped on twice (samples up to 32 distinct decisions late). A new target is
// judged at once by the newest time. In state 0 the decision is Decision{} (D infinite), in the others D is in
// [L / 6, L]. Until a usable target has been seen it is state 0.
class PaperLaw final : public Controller {
public:
    explicit PaperLaw(const PaperConstants& constants = {});  // throws as validate() does

    void observe(const FrameSample& sample) override;
    Decision decide(const FrameRequest& request) override;
    void reset() override;
    const Status& status() const override { return status_; }
    const PaperMemory& memory() const { return memory_; }

private:
    void step();
    Decision decision() const;

    PaperConstants constants_;
    PaperMemory memory_;
    Status status_;
    DrawnDecisions drawn_;      // since the last step
    FrameSample answer_;        // the newest sample of one of them
    bool is_answered_ = false;  // there is one
    bool is_new_ = false;       // and no step has been taken on it
};

}  // namespace sfsm
