#include "render/select.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

constexpr std::uint32_t max_level = 32;

std::int16_t snorm16(float value) {
    return static_cast<std::int16_t>(std::lround(value * 32767.0f));
}

}  // namespace

std::uint32_t level_points(std::uint32_t level) {
    if (level <= 1) return level;
    return level % 2 == 0 ? 1u << (level / 2) : 3u << ((level - 3) / 2);
}

std::uint32_t level_for(float points) {
    std::uint32_t level = 1;
    while (level <= max_level && static_cast<float>(level_points(level)) < points) ++level;
    return level;
}

Selector::Selector(const scene::Crowd& crowd, std::span<const Figure> figures, SelectOptions options)
    : crowd_(crowd), figures_(figures.begin(), figures.end()), options_(options), candidates_(crowd.size()) {
    std::uint32_t bucket_count = 0;
    for (const Figure& figure : figures_) {
        const auto worth = static_cast<float>(figure.triangle_count) / options_.triangles_per_point;
        const float most = std::min(worth, static_cast<float>(figure.poses->point_count));
        Buckets buckets;
        buckets.first = bucket_count;
        buckets.levels = 1;
        while (buckets.levels <= max_level && static_cast<float>(level_points(buckets.levels)) <= most)
            ++buckets.levels;
        const motion::Bounds& box = figure.poses->box;
        const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
        buckets.center = glm::vec3(0.0f, box.center().y, 0.0f);
        buckets.radius = glm::length(glm::vec3(reach.x, 0.5f * box.size().y, reach.z));
        bucket_count += buckets.levels * static_cast<std::uint32_t>(figure.poses->pose_count);
        buckets_.push_back(buckets);
    }
    bucket_begin_.resize(bucket_count + 1);
}

float Selector::visible_range(const View& view) const {
    float range = 1.0f;
    for (const scene::CrowdBlock& block : crowd_.blocks)
        if (overlap(view, block.box) != Overlap::outside) range = std::max(range, farthest_depth(view, block.box));
    return range;
}

const Selection& Selector::select(const View& view, const sfsm::Decision& decision, std::int64_t tick,
                                  std::int64_t last_tick) {
    visible_blocks_.clear();
    block_inside_.clear();
    for (std::uint32_t block = 0; block < crowd_.blocks.size(); ++block) {
        const Overlap seen = overlap(view, crowd_.blocks[block].box);
        if (seen == Overlap::outside) continue;
        visible_blocks_.push_back(block);
        block_inside_.push_back(seen == Overlap::inside);
    }
    const FrameView frame{view, decision, tick, last_tick};
    tbb::parallel_for(
        std::size_t{0}, visible_blocks_.size(),
        [&](std::size_t i) { consider_block(static_cast<std::uint32_t>(i), frame); }, tbb::static_partitioner());
    gather();
    return selection_;
}

void Selector::consider_block(std::uint32_t index, const FrameView& frame) {
    const scene::CrowdBlock& block = crowd_.blocks[visible_blocks_[index]];
    const bool cull = !block_inside_[index];
    for (std::size_t person = block.first; person < block.first + block.count; ++person)
        candidates_[person] = consider(person, cull, frame);
}

Selector::Candidate Selector::consider(std::size_t person, bool cull, const FrameView& frame) const {
    const std::size_t character = crowd_.character[person];
    const Figure& figure = figures_[character];
    const Buckets& buckets = buckets_[character];
    const float scale = crowd_.height[person] / figure.poses->rest_height;

    // Where the person is now decides whether they are seen and how often they move; both change little in a period.
    const scene::Placement now = scene::place(crowd_, person, *figure.member, frame.tick);
    const glm::vec3 center = frame.view.relative(now.position) + scale * buckets.center;
    if (cull && !sphere_visible(frame.view, center, scale * buckets.radius)) return {not_drawn, false, {}};

    const float depth = std::max(frame.view.depth(center), near_plane);
    std::int64_t due = frame.tick;
    if (frame.decision.state != sfsm::State::original) {
        const int period =
            motion::update_period(depth, static_cast<float>(frame.decision.motion_distance), options_.theta);
        due = motion::due_tick(frame.tick, period, crowd_.hash[person]);
    }
    const scene::Placement placement = due == frame.tick ? now : scene::place(crowd_, person, *figure.member, due);
    const scene::Action action = scene::act(crowd_, person, *figure.member, *figure.poses, due);
    const int pose = figure.poses->pose_at(action.clip, action.clip_tick);

    const std::uint32_t level = level_of(character, scale, depth, frame);
    Candidate candidate;
    candidate.bucket =
        buckets.first + level * static_cast<std::uint32_t>(figure.poses->pose_count) + static_cast<std::uint32_t>(pose);
    candidate.moved = due > frame.last_tick;
    candidate.instance = {frame.view.relative(placement.position), scale, snorm16(std::sin(placement.yaw)),
                          snorm16(std::cos(placement.yaw)), crowd_.palette[person]};
    return candidate;
}

std::uint32_t Selector::level_of(std::size_t character, float scale, float depth, const FrameView& frame) const {
    const sfsm::Decision& decision = frame.decision;
    if (decision.state != sfsm::State::points || decision.splat_size <= 0) return 0;
    const float pixels = scale * frame.view.pixels_per_metre(depth) / static_cast<float>(decision.splat_size);
    constexpr float fewest_points = 2;  // about one of them faces the camera
    const float points = options_.density * figures_[character].area * pixels * pixels;
    const std::uint32_t level = level_for(std::max(points, fewest_points));
    return level < buckets_[character].levels ? level : 0;
}

// Counting sort of the candidates by bucket.
void Selector::gather() {
    std::fill(bucket_begin_.begin(), bucket_begin_.end(), 0u);
    selection_.work = {};
    for (std::uint32_t block_index : visible_blocks_) {
        const scene::CrowdBlock& block = crowd_.blocks[block_index];
        for (std::size_t person = block.first; person < block.first + block.count; ++person) {
            const Candidate& candidate = candidates_[person];
            if (candidate.bucket == not_drawn) continue;
            ++bucket_begin_[candidate.bucket + 1];
            selection_.work.motion_updates += candidate.moved;
        }
    }
    for (std::size_t bucket = 1; bucket < bucket_begin_.size(); ++bucket)
        bucket_begin_[bucket] += bucket_begin_[bucket - 1];

    selection_.work.people = bucket_begin_.back();
    selection_.batches.clear();
    for (std::uint32_t character = 0; character < figures_.size(); ++character) batch(character);

    selection_.instances.resize(bucket_begin_.back());
    for (std::uint32_t block_index : visible_blocks_) {
        const scene::CrowdBlock& block = crowd_.blocks[block_index];
        for (std::size_t person = block.first; person < block.first + block.count; ++person) {
            const Candidate& candidate = candidates_[person];
            if (candidate.bucket != not_drawn)
                selection_.instances[bucket_begin_[candidate.bucket]++] = candidate.instance;
        }
    }
}

void Selector::batch(std::uint32_t character) {
    const Figure& figure = figures_[character];
    std::uint32_t bucket = buckets_[character].first;
    for (std::uint32_t level = 0; level < buckets_[character].levels; ++level) {
        const std::uint32_t points = level_points(level);
        for (std::uint32_t pose = 0; pose < static_cast<std::uint32_t>(figure.poses->pose_count); ++pose, ++bucket) {
            const std::uint32_t count = bucket_begin_[bucket + 1] - bucket_begin_[bucket];
            if (count == 0) continue;
            selection_.batches.push_back({character, pose, points, bucket_begin_[bucket], count});
            if (points == 0)
                selection_.work.triangles += std::int64_t{count} * figure.triangle_count;
            else
                selection_.work.points += std::int64_t{count} * points;
        }
    }
}

}  // namespace render
