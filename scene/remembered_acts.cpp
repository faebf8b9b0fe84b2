#include "scene/remembered_acts.h"

#include <limits>

namespace scene {

RememberedActs::RememberedActs(const Crowd& crowd) : crowd_(crowd), memories_(crowd.size()) {}

// What is too late or too long to be written down is asked anew each time: runs of a year, clips of a quarter of an
// hour.
Action RememberedActs::ask(std::size_t person, const CastMember& member, const motion::PoseTable& poses,
                           std::int64_t tick) {
    const Act act = act_around(crowd_, person, member, poses, tick);
    const std::int64_t ticks = act.until - act.from;
    using Limits = std::numeric_limits<std::int32_t>;
    if (act.from >= Limits::min() && act.from <= Limits::max() && ticks <= std::numeric_limits<std::uint16_t>::max())
        memories_[person] = {static_cast<std::int32_t>(act.from), static_cast<std::uint16_t>(ticks), act.clip,
                             act.holds};
    return act.at(tick);
}

}  // namespace scene
