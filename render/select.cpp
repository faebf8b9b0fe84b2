#include "render/select.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

constexpr std::uint32_t max_level = 32;
constexpr float fewest_points = 2;  // about one of them faces the camera

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
    : crowd_(crowd),
      figures_(figures.begin(), figures.end()),
      options_(options),
      depth_(crowd.size()),
      candidates_(crowd.size()) {
    std::uint32_t bucket_count = 0;
    for (const Figure& figure : figures_) {
        const auto worth = static_cast<float>(figure.triangle_count) / options_.triangles_per_point;
        const float most = std::min(worth, static_cast<float>(figure.poses->point_count));
        Kind kind;
        kind.first_bucket = bucket_count;
        kind.levels = 1;
        while (kind.levels <= max_level && static_cast<float>(level_points(kind.levels)) <= most) ++kind.levels;
        const motion::Bounds& box = figure.poses->box;
        const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
        kind.center = glm::vec3(0.0f, box.center().y, 0.0f);
        kind.radius = glm::length(glm::vec3(reach.x, 0.5f * box.size().y, reach.z));
        bucket_count += kind.levels * static_cast<std::uint32_t>(figure.poses->pose_count);
        kinds_.push_back(kind);
    }
    bucket_begin_.resize(bucket_count + 1);
    const auto staleness = measure_staleness(crowd_, figures_);
    std::vector<Forecaster::Kind> priced;
    for (std::size_t i = 0; i < kinds_.size(); ++i)
        priced.push_back({figures_[i].triangle_count, options_.density,
                          [this, i](float points) { return level_points(level_of(i, points)); }, staleness[i]});
    forecaster_ = Forecaster(std::move(priced));
}

template <typename Visit>
void Selector::for_each_visible(Visit visit) const {
    for (const std::uint32_t block_index : visible_blocks_) {
        const scene::CrowdBlock& block = crowd_.blocks[block_index];
        for (std::size_t person = block.first; person < block.first + block.count; ++person)
            if (depth_[person] != unseen) visit(person);
    }
}

const Survey& Selector::survey(const View& view, std::int64_t tick) {
    view_ = view;
    tick_ = tick;
    visible_blocks_.clear();
    block_inside_.clear();
    for (std::uint32_t block = 0; block < crowd_.blocks.size(); ++block) {
        const Overlap seen = overlap(view, crowd_.blocks[block].box);
        if (seen == Overlap::outside) continue;
        visible_blocks_.push_back(block);
        block_inside_.push_back(seen == Overlap::inside);
    }
    tbb::parallel_for(
        std::size_t{0}, visible_blocks_.size(), [&](std::size_t i) { find_visible(i); }, tbb::static_partitioner());
    forecast();
    return survey_;
}

void Selector::find_visible(std::size_t block_index) {
    const scene::CrowdBlock& block = crowd_.blocks[visible_blocks_[block_index]];
    const bool cull = !block_inside_[block_index];
    for (std::size_t person = block.first; person < block.first + block.count; ++person) {
        const std::size_t character = crowd_.character[person];
        const Figure& figure = figures_[character];
        const Kind& kind = kinds_[character];
        const float scale = scale_of(person);
        const scene::Placement now = scene::place(crowd_, person, *figure.member, tick_);
        const glm::vec3 center = view_.relative(now.position) + scale * kind.center;
        const bool hidden =
            (cull && !sphere_visible(view_, center, scale * kind.radius)) || !scene::has_arrived(crowd_, person, tick_);
        depth_[person] = hidden ? unseen : std::max(view_.depth(center), near_plane);
    }
}

void Selector::forecast() {
    survey_.range = 1.0f;
    for_each_visible([&](std::size_t person) { survey_.range = std::max(survey_.range, depth_[person]); });
    forecaster_.begin(survey_.range);
    for_each_visible([&](std::size_t person) {
        const std::size_t character = crowd_.character[person];
        forecaster_.add(character, crowd_.role[person], depth_[person], points_at_unit_splat(person),
                        view_.pixels_per_metre(depth_[person]));
    });
    survey_.forecast = forecaster_.finish(options_.theta);
}

const Selection& Selector::select(const sfsm::Decision& decision, std::int64_t last_tick) {
    const auto consider_block = [&](std::size_t i) {
        const scene::CrowdBlock& block = crowd_.blocks[visible_blocks_[i]];
        for (std::size_t person = block.first; person < block.first + block.count; ++person)
            if (depth_[person] != unseen) candidates_[person] = consider(person, decision, last_tick);
    };
    tbb::parallel_for(std::size_t{0}, visible_blocks_.size(), consider_block, tbb::static_partitioner());
    gather();
    return selection_;
}

float Selector::scale_of(std::size_t person) const {
    return crowd_.height[person] / figures_[crowd_.character[person]].poses->rest_height;
}

float Selector::points_at_unit_splat(std::size_t person) const {
    const float pixels = scale_of(person) * view_.pixels_per_metre(depth_[person]);
    return options_.density * figures_[crowd_.character[person]].area * pixels * pixels;
}

std::uint32_t Selector::level_of(std::size_t character, float points) const {
    const std::uint32_t level = level_for(std::max(points, fewest_points));
    return level < kinds_[character].levels ? level : 0;
}

// Where the person is now decides whether they are seen and how often they move; both change little in a period.
Selector::Candidate Selector::consider(std::size_t person, const sfsm::Decision& decision,
                                       std::int64_t last_tick) const {
    const std::size_t character = crowd_.character[person];
    const Figure& figure = figures_[character];
    std::int64_t due = tick_;
    if (decision.state != sfsm::State::original) {
        const int period =
            motion::update_period(depth_[person], static_cast<float>(decision.motion_distance), options_.theta);
        due = motion::due_tick(tick_, period, crowd_.hash[person]);
    }
    std::uint32_t level = 0;
    if (decision.state == sfsm::State::points && decision.splat_size > 0) {
        const auto splat_area = static_cast<float>(decision.splat_size * decision.splat_size);
        level = level_of(character, points_at_unit_splat(person) / splat_area);
    }
    const scene::Action action = scene::act(crowd_, person, *figure.member, *figure.poses, due);
    const auto pose = static_cast<std::uint32_t>(figure.poses->pose_at(action.clip, action.clip_tick));
    const scene::Placement placement = scene::place(crowd_, person, *figure.member, due);
    Candidate candidate;
    candidate.bucket =
        kinds_[character].first_bucket + level * static_cast<std::uint32_t>(figure.poses->pose_count) + pose;
    candidate.moved = due > last_tick;
    candidate.instance = {view_.relative(placement.position), scale_of(person), snorm16(std::sin(placement.yaw)),
                          snorm16(std::cos(placement.yaw)), crowd_.palette[person]};
    return candidate;
}

// Counting sort of the candidates by bucket.
void Selector::gather() {
    std::fill(bucket_begin_.begin(), bucket_begin_.end(), 0u);
    selection_.work = {};
    for_each_visible([&](std::size_t person) {
        ++bucket_begin_[candidates_[person].bucket + 1];
        selection_.work[sfsm::WorkKind::motion_update] += candidates_[person].moved;
    });
    for (std::size_t bucket = 1; bucket < bucket_begin_.size(); ++bucket)
        bucket_begin_[bucket] += bucket_begin_[bucket - 1];

    selection_.work[sfsm::WorkKind::person] = bucket_begin_.back();
    selection_.batches.clear();
    for (std::uint32_t character = 0; character < figures_.size(); ++character) batch(character);

    selection_.instances.resize(bucket_begin_.back());
    for_each_visible([&](std::size_t person) {
        const Candidate& candidate = candidates_[person];
        selection_.instances[bucket_begin_[candidate.bucket]++] = candidate.instance;
    });
}

void Selector::batch(std::uint32_t character) {
    const Figure& figure = figures_[character];
    std::uint32_t bucket = kinds_[character].first_bucket;
    for (std::uint32_t level = 0; level < kinds_[character].levels; ++level) {
        const std::uint32_t points = level_points(level);
        for (std::uint32_t pose = 0; pose < static_cast<std::uint32_t>(figure.poses->pose_count); ++pose, ++bucket) {
            const std::uint32_t count = bucket_begin_[bucket + 1] - bucket_begin_[bucket];
            if (count == 0) continue;
            selection_.batches.push_back({character, pose, points, bucket_begin_[bucket], count});
            if (points == 0)
                selection_.work[sfsm::WorkKind::triangle] += std::int64_t{count} * figure.triangle_count;
            else
                selection_.work[sfsm::WorkKind::point] += std::int64_t{count} * points;
        }
    }
}

}  // namespace render
