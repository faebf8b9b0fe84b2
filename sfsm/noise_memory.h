// Does the noise of frame times remember: is a slow frame likely to be followed by another? Then many frames say little
// more of the level than one does. No clock, no allocation.
#pragma once

namespace sfsm {

// The correlation of AR(1) noise, from its differences. Neighbouring differences of noise without memory are correlated
// by -1/2, of AR(1) noise by (correlation - 1) / 2. Loads that drift or jump, and prices that are wrong, hardly change
// that.
class NoiseMemory {
public:
    // By how much a frame's ln(time / prediction) differs from that of the frame before. `noise`: 1 sigma of most
    // frames, > 0.
    void add(double difference, double noise);

    // In [0, 0.92]; 0 while it isn't sure that there is any, and where times are exact to 0.3 %.
    double correlation() const { return correlation_; }

    // [sigmas of the differences / sqrt(2)] one frame's noise.
    double of_a_frame() const { return of_a_frame_; }

    // The same of noise without memory of which a mean of many frames is as uncertain.
    double of_a_mean() const { return of_a_mean_; }

private:
    double last_ = 0;
    double squares_ = 0, products_ = 0;  // slow means, of differences and of neighbours
    double correlation_ = 0;
    double of_a_frame_ = 1, of_a_mean_ = 1;
    int heard_ = 0;
};

}  // namespace sfsm
