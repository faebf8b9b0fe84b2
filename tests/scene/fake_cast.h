// Characters without a mesh: all that a crowd asks of one.
#pragma once

#include <vector>

#include "motion/pose_table.h"
#include "scene/places/stadium.h"

namespace tests {

enum FakeClip : std::uint8_t { clip_sit, clip_cheer, clip_clap, clip_walk, clip_run };
inline constexpr int seated_ticks = 240;

struct FakeCast {
    std::vector<scene::CastMember> members;
    std::vector<motion::PoseTable> poses;
};

inline motion::PoseTable fake_poses(std::vector<int> clip_ticks) {
    motion::PoseTable table;
    for (const int ticks : clip_ticks) {
        table.clips.push_back({table.pose_count, ticks, 1});
        table.pose_count += ticks;
    }
    // Lopsided, so that a box turned the wrong way is found out.
    table.box = {{-0.6f, -0.05f, -0.3f}, {0.5f, 2.3f, 0.9f}};
    table.clip_boxes.assign(table.clips.size(), table.box);
    table.rest_height = 1.75f;
    table.area = 1.8f;
    return table;
}

// Sits, and changes between acts of one length.
inline void add_sitter(FakeCast& cast) {
    scene::CastMember member;
    member.name = "sitter";
    member.sits = true;
    for (scene::Acts& acts : member.acts) acts.calm = {clip_sit};
    member.acts[static_cast<int>(scene::Role::spectator)].excited = {clip_cheer, clip_clap};
    member.acts[static_cast<int>(scene::Role::walker)].calm = {clip_walk};
    member.acts[static_cast<int>(scene::Role::runner)].calm = {clip_run};
    member.gait_speed[static_cast<int>(scene::Role::walker)] = 1.4f;
    member.gait_speed[static_cast<int>(scene::Role::runner)] = 4.5f;
    cast.members.push_back(member);
    cast.poses.push_back(fake_poses({seated_ticks, seated_ticks, seated_ticks, 62, 44}));
}

// Stands, and has acts of different lengths.
inline void add_stander(FakeCast& cast) {
    scene::CastMember member;
    member.name = "stander";
    for (scene::Acts& acts : member.acts) acts.calm = {0};
    member.acts[static_cast<int>(scene::Role::spectator)].excited = {1};
    member.gait_speed[static_cast<int>(scene::Role::walker)] = 1.1f;
    member.gait_speed[static_cast<int>(scene::Role::runner)] = 3.9f;
    cast.members.push_back(member);
    cast.poses.push_back(fake_poses({100, 37}));
}

inline FakeCast sitters() {
    FakeCast cast;
    add_sitter(cast);
    return cast;
}

inline FakeCast sitters_and_standers() {
    FakeCast cast = sitters();
    add_stander(cast);
    return cast;
}

inline scene::Crowd populate(const FakeCast& cast, std::int64_t people, std::uint64_t seed = 1) {
    return scene::populate(scene::plan_stadium(people), {people, cast.members, cast.poses, seed});
}

}  // namespace tests
