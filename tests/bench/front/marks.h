// What a law chooses by itself: a closed loop of real frames until it has settled.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "sfsm/controller.h"
#include "sfsm/decision.h"
#include "tests/bench/front/before_rates.h"
#include "tests/bench/front/measure.h"

namespace bench::front {

// [ms] In this order: a law goes from one to the next, and passes the dear frames that some laws begin with once.
inline constexpr double mark_targets[] = {100, 33, 16.6, 8, 4};
inline constexpr double path_targets[] = {33, 16.6};  // at moments of the roaming path
inline constexpr std::int64_t marked_crowds[] = {20'000, 200'000, 1'000'000};
inline bool is_marked(std::int64_t people) {
    return std::ranges::find(marked_crowds, people) != std::end(marked_crowds);
}

// When a law is taken to have settled.
struct Patience {
    int fewest_frames = 20, most_frames = 200;
    double enough_ms = 800, most_ms = 40'000;  // of wall time: enough after the fewest frames, and in any case
};

// What a law decided for a target, measured as a setting is: natively.
Measured mark(const Sight& sight, std::string_view law, double target_ms, const sfsm::Decision& decision,
              Effort effort);

// A law in charge of a view's frames, drawn natively, of a camera that is nudged from frame to frame.
class Loop {
public:
    // `sight` must outlive it. `law`: sfsm's, or law_by_knobs. Throws what sfsm::make_controller throws.
    Loop(const Sight& sight, std::string_view law);

    const std::string& law() const { return law_; }

    // The last decision, after some more frames at a target; of rates the last that was kept for a frame, not one that
    // was drawn once to learn.
    sfsm::Decision settle(double target_ms, Patience patience);

    // That decision measured as a setting is.
    Measured mark(double target_ms, Patience patience, Effort effort);

private:
    double draw(double target_ms);  // [ms] it took

    const Sight& sight_;
    std::string law_;
    std::unique_ptr<sfsm::Controller> controller_;
    std::int64_t frame_ = 0;
    sfsm::Decision decision_, kept_;
};

}  // namespace bench::front
