// What most scenarios share, of whatever kind: a third of the frames is something else, and then it is over.
#pragma once

#include <cstdint>
#include <vector>

#include "sfsm/simulate/scenario.h"

namespace sfsm::simulate {

inline constexpr double usual_noise = 0.03;  // the toy check's

inline constexpr std::int64_t episode_frames = 1800;
inline constexpr Frames episode{600, 1200};

inline std::vector<LoadStep> there_and_back() {
    return {{episode, true}, {{episode.end, episode_frames}, false}};
}

inline std::vector<Frames> around_episode() {
    return {{200, 600}, {800, 1200}, {1400, 1800}};
}

}  // namespace sfsm::simulate
