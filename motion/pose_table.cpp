#include "motion/pose_table.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <string>

#include "model/cutout.h"
#include "model/unorm.h"
#include "motion/octahedral.h"
#include "motion/schedule.h"

namespace motion {
namespace {

constexpr auto position_steps = static_cast<float>(model::unorm_steps);

// 200 days: more is a damaged file, and is cut. Half of what an int holds, so that rounding a period up fits too.
constexpr std::int64_t longest_clip_ticks = std::int64_t{1} << 30;

std::int64_t clip_ticks(const model::Clip& clip) {
    const double ticks = std::round(clip.duration * ticks_per_second);
    if (!(ticks >= 1)) return 1;
    return ticks < static_cast<double>(longest_clip_ticks) ? static_cast<std::int64_t>(ticks) : longest_clip_ticks;
}

// Rounded to the nearest count of whole poses.
std::int64_t poses_in(std::int64_t ticks, std::int64_t ticks_per_pose) {
    return std::max<std::int64_t>(1, (ticks + ticks_per_pose / 2) / ticks_per_pose);
}

std::int64_t total_poses(const std::vector<std::int64_t>& lengths, std::int64_t ticks_per_pose) {
    std::int64_t total = 0;
    for (const std::int64_t ticks : lengths) total += poses_in(ticks, ticks_per_pose);
    return total;
}

// The smallest spacing of poses that keeps all of them within `most`; by bisection, as the total only falls with it.
std::int64_t choose_ticks_per_pose(const std::vector<std::int64_t>& lengths, std::int64_t most) {
    std::int64_t too_dense = 0, enough = *std::max_element(lengths.begin(), lengths.end());
    while (enough - too_dense > 1) {
        const std::int64_t middle = too_dense + (enough - too_dense) / 2;
        (total_poses(lengths, middle) <= most ? enough : too_dense) = middle;
    }
    return enough;
}

std::vector<ClipPoses> lay_out(const model::Character& character, std::span<const int> clips,
                               std::size_t bytes_per_pose, std::size_t byte_budget) {
    std::vector<std::int64_t> lengths;
    for (const int clip : clips) lengths.push_back(clip_ticks(character.clips.at(static_cast<std::size_t>(clip))));
    if (lengths.empty()) lengths.push_back(1);
    // Pose indices are ints; nothing near that many would be drawn.
    constexpr std::size_t most_poses = std::size_t{1} << 30;
    const std::size_t most = std::min(byte_budget / bytes_per_pose, most_poses);
    if (lengths.size() > most) {
        throw std::runtime_error(character.name + ": one pose of each of " + std::to_string(lengths.size()) +
                                 " clips takes " + std::to_string(lengths.size() * bytes_per_pose) +
                                 " bytes; expected at most " + std::to_string(byte_budget));
    }
    const std::int64_t ticks_per_pose = choose_ticks_per_pose(lengths, static_cast<std::int64_t>(most));
    std::vector<ClipPoses> out;
    int first = 0;
    for (const std::int64_t ticks : lengths) {
        const int count = static_cast<int>(poses_in(ticks, ticks_per_pose));
        // A clip of one pose has no period to keep; the spacing must only fit an int.
        const int spacing =
            count == 1 ? static_cast<int>(std::min(ticks_per_pose, ticks)) : static_cast<int>(ticks_per_pose);
        out.push_back({first, count, spacing});
        first += count;
    }
    return out;
}

// What one thread needs to strike poses, reused from pose to pose.
struct PosedMesh {
    Pose pose;
    std::vector<glm::vec3> positions, normals;
};

// Pose number `index` of the table.
void strike(const model::Character& character, std::span<const int> clips, const std::vector<ClipPoses>& layout,
            int index, PosedMesh& out) {
    if (clips.empty()) {
        evaluate_rest(character, out.pose);
    } else {
        const auto after = std::upper_bound(layout.begin(), layout.end(), index,
                                            [](int pose, const ClipPoses& clip) { return pose < clip.first_pose; });
        const std::size_t slot = static_cast<std::size_t>(after - layout.begin()) - 1;
        const std::int64_t tick =
            static_cast<std::int64_t>(index - layout[slot].first_pose) * layout[slot].ticks_per_pose;
        const model::Clip& clip = character.clips[static_cast<std::size_t>(clips[slot])];
        evaluate(character, clip, static_cast<double>(tick) / ticks_per_second, out.pose);
    }
    skin(character.mesh, out.pose, out.positions, out.normals);
}

// Of each triangle, how much of it there is; none if there is all of all.
std::vector<double> surface_shares(const model::Mesh& mesh) {
    std::vector<double> shares;
    if (!model::has_cutouts(mesh)) return shares;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) shares.push_back(model::surface_share(mesh, t, 256));
    return shares;
}

double area_of(const model::Mesh& mesh, const std::vector<glm::vec3>& positions, const std::vector<double>& shares) {
    double twice = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 a = positions[mesh.indices[i]];
        const double area =
            glm::length(glm::dvec3(glm::cross(positions[mesh.indices[i + 1]] - a, positions[mesh.indices[i + 2]] - a)));
        if (std::isfinite(area)) twice += shares.empty() ? area : area * shares[i / 3];
    }
    return 0.5 * twice;
}

// Calls `work(index, scratch)` for every pose, on all threads, and tells `progress` from `from` to `to` as it goes.
template <typename Work>
void for_each_pose(int pose_count, const std::function<void(double)>& progress, double from, double to, Work work) {
    std::mutex mutex;
    int done = 0;
    tbb::parallel_for(tbb::blocked_range<int>(0, pose_count), [&](const tbb::blocked_range<int>& range) {
        PosedMesh scratch;
        for (int index = range.begin(); index < range.end(); ++index) {
            work(index, scratch);
            if (!progress) continue;
            const std::scoped_lock lock(mutex);
            progress(from + (to - from) * ++done / pose_count);
        }
    });
}

Bounds merged(const Bounds& a, const Bounds& b) {
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

// First pass: the boxes, the height and the area, which the packing needs beforehand.
void measure(const model::Character& character, std::span<const int> clips, const std::function<void(double)>& progress,
             PoseTable& table) {
    std::vector<Bounds> boxes(static_cast<std::size_t>(table.pose_count));
    std::vector<double> areas(boxes.size());
    const std::vector<double> shares = surface_shares(character.mesh);
    for_each_pose(table.pose_count, progress, 0.0, 0.5, [&](int index, PosedMesh& posed) {
        strike(character, clips, table.clips, index, posed);
        boxes[static_cast<std::size_t>(index)] = bounds_of(posed.positions);
        areas[static_cast<std::size_t>(index)] = area_of(character.mesh, posed.positions, shares);
    });
    for (const ClipPoses& clip : table.clips) {
        Bounds box = boxes[static_cast<std::size_t>(clip.first_pose)];
        for (int i = 1; i < clip.pose_count; ++i)
            box = merged(box, boxes[static_cast<std::size_t>(clip.first_pose + i)]);
        table.clip_boxes.push_back(box);
    }
    table.box = table.clip_boxes.front();
    for (const Bounds& box : table.clip_boxes) table.box = merged(table.box, box);
    table.area = static_cast<float>(*std::max_element(areas.begin(), areas.end()));
    table.rest_height = boxes.front().size().y;
    table.floor = boxes.front().min.y;
    if (table.rest_height > 0.0f) return;
    const glm::vec3 size = table.box.size();  // lies flat on the ground: its longest side stands in
    table.rest_height = std::max({size.x, size.y, size.z});
}

std::uint16_t pack_between(float value, float min, float size) {
    return size > 0.0f ? model::pack_unorm((value - min) / size) : std::uint16_t{0};
}

PosedVertex pack(const glm::vec3& position, const glm::vec3& normal, const Bounds& box) {
    const glm::vec3 size = box.size();
    const OctahedralNormal packed = pack_normal(normal);
    return {pack_between(position.x, box.min.x, size.x), pack_between(position.y, box.min.y, size.y),
            pack_between(position.z, box.min.z, size.z), packed.u, packed.v};
}

PosedVertex pack_point(const model::Mesh& mesh, const PosedMesh& posed, const SurfacePoint& point, const Bounds& box) {
    const std::uint32_t* corner = &mesh.indices[std::size_t{3} * point.triangle];
    const float w = 1.0f - point.u - point.v;
    const auto blend = [&](const std::vector<glm::vec3>& of) {
        return of[corner[0]] * w + of[corner[1]] * point.u + of[corner[2]] * point.v;
    };
    return pack(blend(posed.positions), blend(posed.normals), box);
}

// Second pass: every pose again, now into its place.
void pack_poses(const model::Character& character, std::span<const int> clips, std::span<const SurfacePoint> points,
                const std::function<void(double)>& progress, PoseTable& table) {
    const std::size_t vertex_count = character.mesh.vertex_count();
    table.vertices.resize(static_cast<std::size_t>(table.pose_count) * vertex_count);
    table.points.resize(static_cast<std::size_t>(table.pose_count) * points.size());
    for_each_pose(table.pose_count, progress, 0.5, 1.0, [&](int index, PosedMesh& posed) {
        strike(character, clips, table.clips, index, posed);
        PosedVertex* vertex = table.vertices.data() + static_cast<std::size_t>(index) * vertex_count;
        for (std::size_t i = 0; i < vertex_count; ++i)
            vertex[i] = pack(posed.positions[i], posed.normals[i], table.box);
        PosedVertex* point = table.points.data() + static_cast<std::size_t>(index) * points.size();
        for (std::size_t i = 0; i < points.size(); ++i)
            point[i] = pack_point(character.mesh, posed, points[i], table.box);
    });
}

}  // namespace

int ClipPoses::pose_at(std::int64_t tick) const {
    const std::int64_t period = ticks();
    const std::int64_t in_period = (tick % period + period) % period;
    return first_pose + static_cast<int>(in_period / ticks_per_pose);
}

PoseTable bake_poses(const model::Character& character, std::span<const int> clips,
                     std::span<const SurfacePoint> points, std::size_t byte_budget,
                     const std::function<void(double)>& progress) {
    const model::Mesh& mesh = character.mesh;
    if (mesh.triangle_count() == 0 || mesh.vertex_count() == 0)
        throw std::runtime_error(character.name + ": found no triangle; expected a mesh to bake");
    PoseTable table;
    table.clips = lay_out(character, clips, (mesh.vertex_count() + points.size()) * sizeof(PosedVertex), byte_budget);
    table.pose_count = table.clips.back().first_pose + table.clips.back().pose_count;
    table.vertex_count = static_cast<int>(mesh.vertex_count());
    table.point_count = static_cast<int>(points.size());
    measure(character, clips, progress, table);
    if (!(table.area > 0.0f))
        throw std::runtime_error(character.name + ": found no area in any pose; expected a surface to bake");
    pack_poses(character, clips, points, progress, table);
    return table;
}

glm::vec3 unpack_position(const PosedVertex& vertex, const Bounds& box) {
    return box.min + glm::vec3(vertex.x, vertex.y, vertex.z) / position_steps * box.size();
}

glm::vec3 unpack_normal(const PosedVertex& vertex) {
    return unpack_normal(OctahedralNormal{vertex.normal_u, vertex.normal_v});
}

}  // namespace motion
