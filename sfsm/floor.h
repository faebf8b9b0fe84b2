// The time that frames don't fall below whatever they draw: they wait for a display's refresh, for another program's
// cap on the frame rate or for the processor. Waiting is no load. No clock, no allocation.
#pragma once

#include <array>
#include <cstddef>

namespace sfsm {

// A level is 16 times that lie close together (a deviation of at most 1.5 %), late ones left out. It is a floor when
// - its times don't follow the work that is predicted for them, which differs by more than they do; unless it is below
//   the target and they are not exactly equal: it does no harm there, and may be a step in cost. Or
// - neighbouring times make up for each other, as times between stamps that jitter do. Or
// - late times among the last 32 are whole multiples of it. Or
// - four times in a row are whole multiples of the target, to six digits.
// By the first two signs it is none while one of the last 32 times was below it.
// It is none any more after two times below it. If times over it are multiples of a period, which is the floor or a
// half, third or quarter of it, they are a display's; else they are what the work took, and after 64 of them in a row
// the floor is forgotten. The wait before the next one is found doubles, from 32 times to 2,048.
class Floor {
public:
    // A frame took `ms` (finite, > 0). `log_step`: ln of what it was predicted to take over what the one before was.
    void observe(double ms, double log_step, double target_ms);

    bool is_found() const { return ms_ > 0; }

    // These mean nothing before is_found().
    double ms() const { return ms_; }                               // [ms]
    bool is_at(double ms) const { return ms <= ms_ + jitter_ms_; }  // its frame may have waited
    bool is_deaf() const { return is_deaf_; }                       // it was found by times that didn't follow the work
    double period_ms() const;                                       // [ms] of a display; 0: none

    // The time [ms] that can be had nearest below the target, which a display's may exceed by 4.5 %; or the floor.
    double due_ms(double target_ms) const;

private:
    static constexpr std::size_t history = 32, window = 16;
    static constexpr std::size_t most_parts = 4;  // of the floor that a period may be
    using Scores = std::array<double, most_parts>;
    struct Seen {
        double ms = 0, log_step = 0;
    };
    struct Level {
        double ms = 0, longest = 0, farthest = 0;     // mean time; a longer one is late; from the mean [ms]. 0: none
        double deviation = 0;                         // [share]
        double path = 0, lowest = 0, highest = 0;     // ln of the predicted work, its range fading
        double pairs = 0, squares = 0, products = 0;  // of neighbours' deviations
        double steps = 0, response = 0;               // sums of its steps squared, and of them times those of the time
    };

    struct Place {
        double ms = 0, jitter_ms = 0;
    };

    const Seen& newest(std::size_t back) const { return seen_[(next_ + history - 1 - back) % history]; }
    void follow(double ms);
    void forget();
    void sort_in(double ms);
    bool has_given_way(const Level& level) const;
    bool is_exact(double ms, double target_ms);
    void find(double target_ms);
    Level level() const;
    void extend(Level& level, std::size_t back) const;
    bool is_waiting(const Level& level, double target_ms) const;
    bool is_undercut(const Place& place) const;
    double hidden_by_refresh(double ms) const;
    void take(const Place& place);
    static Scores scored(Scores scores, double ms, const Place& place);

    std::array<Seen, history> seen_{};  // a ring
    std::size_t next_ = 0, count_ = 0;
    std::array<double, window> sorted_{};  // times of the window
    Level level_;                          // the newest; it may have ended
    double ms_ = 0, jitter_ms_ = 0;        // 0: none is known
    Scores scores_{};                      // ln of the odds that times over it are multiples of it, of its half, ...
    bool is_deaf_ = false;
    int below_ = 0, over_ = 0;      // times in a row below and over it
    int wait_ = 0, patience_ = 32;  // [times] until another may be found, and the next such wait
    int exact_ = 0;                 // times in a row that are whole targets, counted to a few
};

}  // namespace sfsm
