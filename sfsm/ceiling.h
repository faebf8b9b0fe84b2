// The detail that proved too dear, so that a law doesn't try the same rise again and again. Some costs jump between two
// details (levels of detail, states, refreshes of a display). Then no decision meets the target exactly, and a law that
// believes in a smooth cost would bounce across the jump for ever.
#pragma once

namespace sfsm {

// For details in [0, 1] and predicted times.
// - A rise is on trial for 24 decisions. If it turns out slow, its detail becomes the ceiling.
// - The law then falls to the detail it now predicts to fit, at most back to where the rise began. If that is slow too,
//   it falls at least half the way back.
// - Below a ceiling a rise goes only half the way up to it. The wait before the next rise doubles with each failure.
// - The ceiling is forgotten after 1024 decisions, or when the load has fallen.
class Ceiling {
public:
    // A rise that is predicted to fit: the detail to rise to, at most `to`. `from` itself: not now.
    double rise(double from, double to, double ms_at_from);

    // Detail `at` is predicted slow, `to` is predicted to fit: the detail to fall to.
    double fall(double at, double to);

    // Once a decision. `ms_at_floor`: the time [ms] that is now predicted for floor().
    void step(double ms_at_floor);

    double floor() const { return from_; }  // where the last rise began

    void forget();

private:
    double from_ = 0, to_ = 0;  // the last rise
    double ms_ = 0;             // predicted for from_ when it began
    int age_ = 1 << 20;         // [decisions] since it began
    double ceiling_ = 2;        // a detail that failed; over 1: none has
    int patience_ = 16;         // [decisions] to wait after the next failure
    int wait_ = 0;              // [decisions] still to wait
    int lasts_ = 0;             // [decisions] until the ceiling is forgotten
    int failures_ = 0;          // of the last rise
};

}  // namespace sfsm
