// How much longer than predicted the slowest few frames take: a percentile of ln(time / prediction), learned from one
// frame after the other. Noise tells how far apart most frames are; real frame times have a heavier tail than a normal
// distribution of that noise. No clock, no allocation.
#pragma once

namespace sfsm {

// Stochastic approximation of a percentile (Robbins and Monro 1951): a frame above the estimate moves it up by
// `percentile` of a step, a frame below moves it down by the rest of the step. So it rests where that share is below.
// - A step is never longer because a frame was: one frame moves it little, whatever it took.
// - Steps shrink at first, and never below a lasting one: so it also follows a machine that changes.
// - It begins at 0, since up is the fast way. It is never below 0.
class Tail {
public:
    static constexpr double percentile = 0.97;
    static constexpr double normal = 1.881;  // [sigmas] that percentile of a normal distribution

    // A frame took exp(residual) times what was predicted. `noise`: 1 sigma of most frames, relative, > 0.
    void add(double residual, double noise);

    // The percentile of ln(time / prediction), >= 0. It stays until the estimate has moved by part of a sigma, so that
    // what is decided by it doesn't move with every frame.
    double excess() const { return excess_; }

private:
    double estimate_ = 0;
    double excess_ = 0;
    int heard_ = 0;  // frames, counted to a few hundred
};

}  // namespace sfsm
