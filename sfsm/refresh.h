// What can be learned from times of frames that waited. Such a time says only that the work took no longer, or, by a
// display, between which two refreshes it was done.
#pragma once

#include "sfsm/cost_model.h"
#include "sfsm/floor.h"

namespace sfsm {

// Stands between times and a model.
// - While no floor is known (floor.h), times are heard as they are. When one is found, the model forgets its prices.
// - By a display the model is told its own prediction as long as that lies between the same two refreshes. Its gain is
//   lowered while frames are in time, and raised by each late one, so that 1.6 % are late. After 80 frames in time it
//   is lowered faster and faster, up to 1 % a frame. Three late frames in a row are a load that has risen.
// - At a floor without a display, a time well above it is heard as it is. Near it the gain is moved so that 10 % of the
//   frames take longer than the floor.
class Refresh {
public:
    struct Haste;
    enum class Evidence { any, but_work };

    // `but_work`: that times don't follow the work shows no floor. Where work is counted by kinds, the model itself
    // learns that some of them cost nothing.
    explicit Refresh(Evidence evidence = Evidence::any) : evidence_(evidence) {}

    struct Time {
        double ms;        // of the frame
        double known_ms;  // as it would be under the load that the model knows; the same where loads aren't told apart
    };

    void observe(CostModel& model, const Amounts& amounts, const Time& time, double target_ms);

    // What can be had for a target [ms]: itself, if frames don't wait.
    double due_ms(double target_ms) const { return floor_.due_ms(target_ms); }

    // Frames are known to wait.
    bool is_waiting() const { return floor_.is_found(); }

    // What they wait for. It means little before is_waiting().
    const Floor& floor() const { return floor_; }

    // They do, and for no display.
    bool is_capped() const { return is_waiting() && floor_.period_ms() <= 0; }

private:
    void hear_rounded(CostModel& model, const Amounts& amounts, double ms);
    void seek(CostModel& model, double predicted_ms, bool is_late);
    void hear_capped(CostModel& model, const Amounts& amounts, double ms);
    double drift(const Haste& haste) const;

    Evidence evidence_;
    Floor floor_;
    Amounts last_;            // of the time before; no terms: there was none
    double due_ms_ = 0;       // at the last time that waited
    int late_ = 0;            // late frames in a row
    int in_time_ = 0;         // frames in time since the last late one
    int in_flight_ = 0;       // frames still to come that were drawn before the load was known to have risen
    double since_climb_ = 0;  // frames since the first late one after many in time
};

}  // namespace sfsm
