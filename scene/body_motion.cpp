#include "scene/body_motion.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "motion/schedule.h"

namespace scene {

namespace {

constexpr double moments_a_second = 15;
constexpr double instant = 1.0 / motion::ticks_per_second;  // [s] over which speeds are measured
constexpr float contact_share = 0.03f;                      // of the height: what is as low touches the ground

template <typename Number>
Number median(std::vector<Number> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// What one thread needs to strike poses.
struct Body {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;

    void strike(const model::Character& character, const model::Clip* clip, double time) {
        if (clip)
            motion::evaluate(character, *clip, time, pose);
        else
            motion::evaluate_rest(character, pose);
        motion::skin(character.mesh, pose, positions, normals);
    }
};

// Of one moment.
struct Moment {
    motion::Bounds box;
    glm::vec2 middle{0.0f};
    glm::vec2 tread{0.0f};  // [units/s] median velocity of what is lowest
    double treading = 0;    // how many vertices that is
    double speed = 0;       // [units/s] mean over the vertices, beside the drift
};

// Between two instants. Treads are of vertices that are low in both, speeds beside the drift [units/s].
void measure_speeds(const std::vector<glm::vec3>& now, const std::vector<glm::vec3>& then, glm::dvec2 drift,
                    Moment& moment) {
    const float low = moment.box.min.y + contact_share * moment.box.size().y;
    std::vector<float> across, along;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const glm::dvec3 velocity = glm::dvec3(then[i] - now[i]) / instant;
        moment.speed += glm::length(velocity - glm::dvec3(drift.x, 0, drift.y));
        if (now[i].y > low || then[i].y > low) continue;
        across.push_back(static_cast<float>(velocity.x));
        along.push_back(static_cast<float>(velocity.z));
    }
    moment.speed /= static_cast<double>(now.size());
    // Not the mean: a foot that swings past the other is low too, and a cape hangs.
    moment.treading = static_cast<double>(along.size());
    if (!along.empty()) moment.tread = {median(std::move(across)), median(std::move(along))};
}

Moment measure_moment(const model::Character& character, const model::Clip* clip, double time, double end,
                      glm::dvec2 drift, Body& body, Body& later) {
    Moment moment;
    body.strike(character, clip, time);
    moment.box = motion::bounds_of(body.positions);
    moment.middle = middle_of(character.mesh, body.positions);
    if (end < instant) return moment;
    const bool is_last = time + instant > end;
    later.strike(character, clip, is_last ? time - instant : time + instant);
    if (is_last)
        measure_speeds(later.positions, body.positions, drift, moment);
    else
        measure_speeds(body.positions, later.positions, drift, moment);
    return moment;
}

// The middle one, each counted as often as its weight says.
float weighted_median(std::vector<std::pair<float, double>> values) {
    std::ranges::sort(values);
    double total = 0, before = 0;
    for (const auto& [value, weight] : values) total += weight;
    for (const auto& [value, weight] : values)
        if ((before += weight) >= 0.5 * total) return value;
    return 0;
}

// What feet do that carry somebody: most of the time they go one way. Moments in the air don't count, and a flat foot
// counts for more than a toe.
glm::vec2 steady_tread(const std::vector<Moment>& moments, const BodyMotion& motion) {
    constexpr double steadiness = 0.6;  // of the weight; else a foot that swings forward is low too
    const float grounded = motion.floor() + contact_share * motion.height();
    std::vector<std::pair<float, double>> across, along;
    for (const Moment& moment : std::span(moments).first(moments.size() - 1)) {  // the last is the first again
        if (moment.box.min.y > grounded) continue;
        across.emplace_back(moment.tread.x, moment.treading);
        along.emplace_back(moment.tread.y, moment.treading);
    }
    const glm::vec2 tread(weighted_median(across), weighted_median(along));
    double all = 0, with_it = 0;
    for (std::size_t i = 0; i < along.size(); ++i) {
        all += along[i].second;
        if (glm::dot(tread, {across[i].first, along[i].first}) > 0) with_it += along[i].second;
    }
    return with_it > steadiness * all ? tread : glm::vec2(0.0f);
}

double liveliness_of(const std::vector<Moment>& moments, float height) {
    if (!(height > 0)) return 0;
    double sum = 0;
    for (const Moment& moment : moments) sum += moment.speed;
    return sum / static_cast<double>(moments.size()) / static_cast<double>(height);
}

// How a clip's last pose is away from its first.
struct Ends {
    glm::vec2 drift{0.0f};  // x, z of the middle
    double distance = 0;    // [units] mean over the vertices, drift apart
};

Ends compare_ends(const model::Character& character, const model::Clip* clip, double end) {
    Ends ends;
    if (!(end > 0) || character.mesh.vertex_count() == 0) return ends;
    Body first, last;
    first.strike(character, clip, 0);
    last.strike(character, clip, end);
    ends.drift = middle_of(character.mesh, last.positions) - middle_of(character.mesh, first.positions);
    const glm::vec3 drift(ends.drift.x, 0, ends.drift.y);
    for (std::size_t i = 0; i < first.positions.size(); ++i)
        ends.distance += static_cast<double>(glm::length(last.positions[i] - first.positions[i] - drift));
    ends.distance /= static_cast<double>(first.positions.size());
    return ends;
}

std::vector<double> moments_of(double duration, std::size_t most) {
    if (!(duration > instant)) return {0.0};
    const auto wanted = static_cast<std::size_t>(std::clamp(duration * moments_a_second, 7.0, 1e6));
    const std::size_t steps = std::min(most, wanted + 1) - 1;
    std::vector<double> times;
    for (std::size_t i = 0; i <= steps; ++i)
        times.push_back(duration * static_cast<double>(i) / static_cast<double>(steps));
    return times;
}

// Areas along an axis, in cells between two ends.
class Spread {
public:
    Spread(float from, float to) : from_(from), cell_((to - from) / static_cast<float>(cells)) {}

    void add(float low, float high, double area) {
        const std::size_t first = cell_of(low), last = cell_of(high);
        const double share = area / static_cast<double>(last - first + 1);
        for (std::size_t i = first; i <= last; ++i) area_[i] += share;
        total_ += area;
    }

    // Halfway between where `share` of the area lies before and where as much lies behind.
    float middle(double share) const { return 0.5f * (edge(share * total_) + edge((1 - share) * total_)); }

private:
    static constexpr std::size_t cells = 256;

    std::size_t cell_of(float at) const {
        const float cell = cell_ > 0 ? (at - from_) / cell_ : 0.0f;
        return static_cast<std::size_t>(std::clamp(cell, 0.0f, static_cast<float>(cells - 1)));
    }

    float edge(double area) const {
        double before = 0;
        std::size_t cell = 0;
        while (cell + 1 < cells && before + area_[cell] < area) before += area_[cell++];
        const double part = area_[cell] > 0 ? (area - before) / area_[cell] : 0.5;
        return from_ + cell_ * (static_cast<float>(cell) + static_cast<float>(part));
    }

    float from_, cell_;
    std::array<double, cells> area_{};
    double total_ = 0;
};

// Palette entries that vertices hang on.
std::vector<bool> used_entries(const model::Character& character) {
    std::vector<bool> used(character.skeleton.palette.size(), false);
    for (std::size_t i = 0; i < character.mesh.joints.size(); ++i)
        character.mesh.visit_influences(i, [&](std::uint16_t joint, float weight) {
            if (weight > 0) used[joint] = true;
        });
    return used;
}

// Rigid parts are bound where they rest; skinned ones where their vertices are.
class BindPose {
public:
    explicit BindPose(const model::Character& character) : character_(character), used_(used_entries(character)) {
        motion::Pose rest;
        motion::evaluate_rest(character, rest);
        rest_ = rest.palette;
        box_ = motion::bounds_of(character.mesh.positions);
    }

    bool is_struck(const motion::Pose& pose) const { return moves_as_one(pose, true) && moves_as_one(pose, false); }

    std::size_t bones() const { return static_cast<std::size_t>(std::ranges::count(used_, true)); }

private:
    bool is_rigid(std::size_t entry) const {
        return character_.skeleton.palette[entry].inverse_bind == glm::mat4(1.0f);
    }

    bool moves_as_one(const motion::Pose& pose, bool rigid) const {
        std::optional<glm::mat4> all;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            if (!used_[i] || is_rigid(i) != rigid) continue;
            const glm::mat4 moved = rigid ? pose.palette[i] * glm::inverse(rest_[i]) : pose.palette[i];
            if (!all) all = moved;
            if (!is_same(moved, *all, rigid ? rest_[i] : glm::mat4(1.0f))) return false;
        }
        return true;
    }

    // Of what is within the mesh's box.
    bool is_same(const glm::mat4& a, const glm::mat4& b, const glm::mat4& from) const {
        constexpr float tolerance = 0.003f;  // of the largest extent
        float farthest = 0, largest = 0;
        const glm::vec3 origin = glm::vec3(a * from * glm::vec4(box_.min, 1.0f));
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec4 at(corner & 1 ? box_.max.x : box_.min.x, corner & 2 ? box_.max.y : box_.min.y,
                               corner & 4 ? box_.max.z : box_.min.z, 1.0f);
            const glm::vec3 in_a(a * from * at), in_b(b * from * at);
            farthest = std::max(farthest, glm::length(in_a - in_b));
            largest = std::max(largest, glm::length(in_a - origin));
        }
        return farthest <= tolerance * largest;
    }

    const model::Character& character_;
    std::vector<bool> used_;
    std::vector<glm::mat4> rest_;
    motion::Bounds box_;
};

}  // namespace

float BodyMotion::height() const {
    std::vector<float> heights;
    for (const motion::Bounds& box : boxes) heights.push_back(box.size().y);
    return median(std::move(heights));
}

float BodyMotion::floor() const {
    constexpr double below = 0.3;  // of the moments
    std::vector<float> lowest;
    for (const motion::Bounds& box : boxes) lowest.push_back(box.min.y);
    const auto found = lowest.begin() + static_cast<std::ptrdiff_t>(below * static_cast<double>(lowest.size()));
    std::ranges::nth_element(lowest, found);
    return *found;
}

bool BodyMotion::is_loop() const {
    constexpr double much = 0.07;
    return !(gap > much);
}

glm::vec2 BodyMotion::gait() const {
    constexpr float slowest = 0.1f;  // heights a second; slower is swaying
    const double duration = times.back();
    if (!(duration > 0)) return glm::vec2(0.0f);
    const glm::vec2 carried = drift / static_cast<float>(duration);
    if (glm::length(carried) > slowest * height()) return carried;
    return glm::length(tread) > slowest * height() ? -tread : glm::vec2(0.0f);
}

BodyMotion measure_motion(const model::Character& character, const model::Clip* clip, std::size_t most_moments) {
    BodyMotion motion;
    const double duration = clip && std::isfinite(clip->duration) ? clip->duration : 0;
    motion.times = moments_of(duration, most_moments);
    const Ends ends = compare_ends(character, clip, motion.times.back());
    motion.drift = ends.drift;
    const glm::dvec2 drift = duration > 0 ? glm::dvec2(ends.drift) / duration : glm::dvec2(0.0);
    std::vector<Moment> moments(motion.times.size());
    if (character.mesh.vertex_count() > 0) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, moments.size()), [&](const auto& range) {
            Body body, later;
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                moments[i] = measure_moment(character, clip, motion.times[i], duration, drift, body, later);
        });
    }
    for (const Moment& moment : moments) {
        motion.boxes.push_back(moment.box);
        motion.middles.push_back(moment.middle);
    }
    motion.tread = steady_tread(moments, motion);
    motion.liveliness = liveliness_of(moments, motion.height());
    if (motion.height() > 0) motion.gap = ends.distance / static_cast<double>(motion.height());
    return motion;
}

glm::vec2 middle_of(const model::Mesh& mesh, const std::vector<glm::vec3>& positions) {
    constexpr double thin = 0.1;  // of the area: a sword, a tail
    const motion::Bounds box = motion::bounds_of(positions);
    Spread across(box.min.x, box.max.x), along(box.min.z, box.max.z);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 a = positions[mesh.indices[i]], b = positions[mesh.indices[i + 1]],
                        c = positions[mesh.indices[i + 2]];
        const double area = glm::length(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a)));
        if (!(area > 0) || !std::isfinite(area)) continue;
        across.add(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), area);
        along.add(std::min({a.z, b.z, c.z}), std::max({a.z, b.z, c.z}), area);
    }
    return {across.middle(thin), along.middle(thin)};
}

bool strikes_bind_pose(const model::Character& character, const model::Clip& clip) {
    const BindPose bind(character);
    if (bind.bones() < 2) return false;
    motion::Pose pose;
    for (const double share : {0.0, 0.25, 0.5, 0.8, 1.0}) {
        motion::evaluate(character, clip, share * clip.duration, pose);
        if (!bind.is_struck(pose)) return false;
    }
    return true;
}

}  // namespace scene
