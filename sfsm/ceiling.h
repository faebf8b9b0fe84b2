// The detail that proved too dear, so that a law doesn't try the same rise again and again. Some costs jump between two
// details (levels of detail, states, refreshes of a display). Then no decision meets the target exactly, and a law that
// believes in a smooth cost would bounce across the jump for ever.
#pragma once

namespace sfsm {

// For details in [0, 1] and predicted times.
// - A rise is on trial for 24 decisions. If it turns out slow, its detail becomes the ceiling.
// - The law then falls to the detail it now predicts to fit, at most back to where the rise began, and for six
//   decisions no lower: until a few times are heard from there, what the failure taught is believed of all details. If
//   that is slow too, it falls at least half the way back.
// - Below a ceiling a rise goes only half the way up to it. The wait before the next rise doubles with each failure; it
//   passes eight times as fast while a tenth of the time is to spare, until a few rises in a row have failed.
// - A ceiling lasts 64 decisions, as a few slow frames may have made it by chance. One that the next rise
//   confirms, from below it, lasts 1024.
// - It is forgotten when the load has fallen: when the floor, where the rise began that made it, takes 15 % less than
//   then. What it took is the most that is predicted for it before the rise and from ten to 24 decisions after the
//   failure; sooner, predictions are of no use.
class Ceiling {
public:
    // A rise that is predicted to fit: the detail to rise to, at most `to`. `from` itself: not now.
    double rise(double from, double to, double ms_at_from);

    // Detail `at` is predicted slow, `to` to fit: the detail to fall to.
    double fall(double at, double to);

    // Once a decision, with the time [ms] that is now predicted for floor(). `to_spare`: ln(aim / the time predicted
    // for what is drawn).
    void step(double ms_at_floor, double to_spare);

    double floor() const { return floor_; }

    bool is_set() const { return ceiling_ <= 1; }
    double detail() const { return ceiling_; }  // means nothing before is_set()

    // Another target, or a load that is followed: no rise so far has failed by that.
    void forget();

private:
    void drop();
    void lift();

    double from_ = 0, to_ = 0;  // the last rise
    double ms_ = 0;             // predicted for from_ when it began
    int age_ = 1 << 20;         // [decisions] since it began
    int failures_ = 0;          // of it

    double ceiling_ = 2;               // a detail that failed; over 1: none has
    double floor_ = 0, floor_ms_ = 0;  // where the rise to it began, and what that took then
    double suspect_ = 0;               // the newest ceiling, even if it lasts no more; 0: none
    int lasts_ = 0;                    // [decisions] until the ceiling is lifted
    int since_failure_ = 0;            // [decisions]
    int patience_ = 16;                // [decisions] to wait after the next failure
    int wait_ = 0;                     // [decisions] still to wait
};

}  // namespace sfsm
