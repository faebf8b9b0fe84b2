// Everybody in the scene: structure of arrays, in spatial blocks of a few hundred people. Where someone is and what
// they do at a tick is arithmetic on their number: no state is carried from frame to frame.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "motion/pose.h"
#include "motion/pose_table.h"
#include "scene/palette.h"
#include "scene/path.h"

namespace scene {

enum class Role : std::uint8_t { spectator, standing, walker, runner };
inline constexpr int role_count = 4;

inline bool follows_path(Role role) {
    return role == Role::walker || role == Role::runner;
}

// Which of a character's baked clips a role plays: indices into PoseTable::clips, all of one length if there are
// several (then a person changes between them from clip to clip), the first being the calm one.
struct Acts {
    std::vector<std::uint8_t> calm;     // never empty
    std::vector<std::uint8_t> excited;  // may be empty; the first is what a Mexican wave shows: arms up
};

struct CastMember {
    std::string name;
    Acts acts[role_count];
    bool sits = false;  // the spectator clips are seated ones; else spectators stand in front of their seat
    float gait_speed[role_count] = {};  // [m/s] at person height 1.75 m, of walkers and runners
};

struct CrowdBlock {
    std::uint32_t first = 0, count = 0;
    motion::Bounds box;  // [m] of everything its people may touch in any clip at any time
    // [m] world. What floats say of its people, their path and this box is from here, so that they may be anywhere: a
    // float32 has steps of a tenth of a millimetre at a kilometre, of a metre at 10,000.
    glm::dvec3 origin{0.0};
};

struct Crowd {
    // One element a person, blocks contiguous.
    // [m] From its block's origin: where the model's origin goes, so that who stands stands on the ground and who sits
    // rests on the seat, whatever their size. For walkers and runners x = offset of their parallel of the path [m], y =
    // height, z = arc at tick 0 [m].
    std::vector<glm::vec3> position;
    std::vector<float> yaw;     // [rad]
    std::vector<float> height;  // [m] standing, 1.5-2.0
    std::vector<std::uint8_t> character;
    std::vector<Role> role;
    // How far around the place, in [0, 1): waves and moods travel by it. Of no meaning to walkers and runners.
    std::vector<float> around;
    std::vector<std::uint32_t> hash;  // the person's own random bits: phase, stagger, acts
    std::vector<Palette> palette;
    std::vector<CrowdBlock> blocks;
    std::shared_ptr<const Path> path;  // that walkers and runners follow; may be null if there are none
    std::int64_t filled_tick = 0;  // from when everybody is there; before, people come in, each at a tick of their own

    std::size_t size() const { return position.size(); }
};

// Where and how one person is at a tick.
struct Placement {
    glm::vec3 position;  // [m] of the model's origin, from their block's
    float yaw;           // [rad]
};
struct Action {
    std::uint8_t clip;       // into PoseTable::clips
    std::int64_t clip_tick;  // of the clip's own time
};

// [m/s] How fast a walker or runner goes.
double speed_of(const Crowd& crowd, std::size_t person, const CastMember& member);

Placement place(const Crowd& crowd, std::size_t person, const CastMember& member, std::int64_t tick);

// Whether `person` has come in by `tick`.
bool has_arrived(const Crowd& crowd, std::size_t person, std::int64_t tick);

// What somebody does without a change.
struct Act {
    std::int64_t from, until;  // [ticks] of the scene: at least from the one to before the other
    std::uint8_t clip;         // into PoseTable::clips; it begins at `from`
    bool holds;                // its first pose all the time

    Action at(std::int64_t tick) const { return {clip, holds ? 0 : tick - from}; }
};

// Whether who has this role goes from one of its clips to any other as it ends; between them they may hold the first
// pose of the first calm one. Who doesn't goes on with one clip for ever.
bool changes_acts(Role role, const Acts& acts, const motion::PoseTable& poses);

// What `person` does around `tick` of the scene: phase, choice between acts (cheering travels around the place as a
// wave now and then), all from hash and tick.
Act act_around(const Crowd& crowd, std::size_t person, const CastMember& member, const motion::PoseTable& poses,
               std::int64_t tick);

// The same at `tick`.
Action act(const Crowd& crowd, std::size_t person, const CastMember& member, const motion::PoseTable& poses,
           std::int64_t tick);

}  // namespace scene
