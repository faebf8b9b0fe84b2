// Where detail proved too dear: what keeps a law from trying the same rise again and again. Costs that jump between
// two details (levels of detail, states, refreshes of a display) have no decision that meets the target exactly, and
// whoever believes in a smooth cost bounces across the jump for ever.
#pragma once

namespace sfsm {

// Of one axis of detail in [0, 1] and predicted times. A rise that turns out slow within its trial leaves a ceiling,
// and falls to what is now believed in, the second time at least half way back. Below a ceiling, rises go half way up
// to it, with longer and longer waits. It is forgotten after 1024 decisions, or when the load has fallen.
class Ceiling {
public:
    // What a rise from one detail to another that seems to have the time becomes. Equal to `from`: not now.
    double rise(double from, double to, double ms_at_from);

    // Detail `at` would be slow: what a fall to `to` becomes.
    double fall(double at, double to);

    // Once a decision. `ms_at_floor`: the time now predicted where the last rise began.
    void step(double ms_at_floor);

    double floor() const { return from_; }  // where the last rise began

    void forget();

private:
    double from_ = 0, to_ = 0;  // the last rise
    double ms_ = 0;             // predicted at from_ as it began
    int age_ = 1 << 20;         // decisions since
    double ceiling_ = 2;        // a detail that failed; over 1: none has
    int patience_ = 16;         // decisions to wait after the next failure
    int wait_ = 0;              // and still to wait
    int lasts_ = 0;             // decisions until the ceiling is tried again
    int failures_ = 0;          // of the last rise
};

}  // namespace sfsm
