#include "figures/splats.h"

#include <limits>

namespace figures {

namespace {

constexpr int wanted_keys = 24;

}  // namespace

SplatKeys splat_keys(const motion::PoseTable& poses) {
    const int step = (poses.pose_count + wanted_keys - 1) / wanted_keys;
    SplatKeys keys;
    std::vector<std::size_t> key_of(static_cast<std::size_t>(poses.pose_count));
    for (const motion::ClipPoses& clip : poses.clips) {
        const std::size_t first = keys.poses.size();
        const int count = (clip.pose_count + step - 1) / step;
        for (int key = 0; key < count; ++key) keys.poses.push_back(clip.first_pose + key * step);
        // Clips are loops: behind the last key comes the first.
        for (int pose = 0; pose < clip.pose_count; ++pose)
            key_of[static_cast<std::size_t>(clip.first_pose + pose)] =
                first + static_cast<std::size_t>((pose + step / 2) / step % count);
    }
    if (keys.poses.size() > std::size_t{std::numeric_limits<std::uint8_t>::max()} + 1) return {};
    keys.of_pose.assign(key_of.begin(), key_of.end());
    return keys;
}

std::vector<Level> splat_levels(const Figure& figure) {
    if (figure.poses->point_count == 0 || splat_keys(*figure.poses).poses.empty()) return {};
    Level level;
    level.reach = splat_reach;
    level.count = 1;
    return {level};
}

}  // namespace figures
