// Does the load drift: does it grow and fall all the time, by more than noise does? Then the newest level of it, and
// how fast it moves, say more of the next frame than a mean of many frames. No clock, no allocation.
#pragma once

namespace sfsm {

// An alpha-beta filter (Benedict and Bordner 1962) tracks the logarithm of the load: its level and its slope. It
// forgets as fast as the swings it has seen ask for, and faster while times are off to one side.
// - The load drifts when the level has swung from one side of its slow mean to the other and back, wanders by 6 %
//   about it, and detail goes down as it grows; no more when it wanders by less than half of that. So noise that
//   remembers is no drift, nor is a ramp; and times that grow with detail tell of its price.
// - Jumps are no drift: where two times in a row are off alike, and by much, it begins anew.
// - A single time that is off by much is an outlier, and is left out.
class Drift {
public:
    // ln of a frame's time over what its work would take at a load of 1, and its detail. `noise`: 1 sigma of that, > 0.
    void observe(double log_load, double detail, double noise);

    bool is_on() const { return is_on_; }

    double slope() const { return slope_; }  // [ln load per frame]

    // ln load so many frames after the newest that was observed.
    double ahead(double frames) const;

private:
    struct Weights {
        double level, slope;  // of an error
    };

    Weights weights_for(double noise) const;
    void jump(double log_load);
    void judge(double log_load, double detail);
    void count_swings();

    double level_ = 0, slope_ = 0;  // [ln], [ln per frame]
    double lag_ = 0;                // [ln] by which times are off, a mean of a few
    double off_ = 0;                // [ln] by which the newest time was off, if by much; else 0

    double mean_ = 0, detail_ = 0;               // slow means of level and detail
    double wander_ = 0;                          // mean square of the level about its mean
    double loads_ = 0, details_ = 0, both_ = 0;  // mean squares about the means, and mean product
    double half_period_ = 1;                     // [frames], of the newest swing
    int swings_ = 0, since_swing_ = 0;           // changes of side, and frames since
    bool is_above_ = false;
    bool is_on_ = false;
    bool has_begun_ = false;
};

}  // namespace sfsm
