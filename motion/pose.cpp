#include "motion/pose.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace motion {
namespace {

// Two keys and how far between them a time lies.
struct Segment {
    std::size_t left = 0, right = 0;
    float fraction = 0;  // [0, 1]
    float length = 0;    // [s]
};

// `count` keys of `times` are to be read, ascending. Equal times give the later key.
Segment find_segment(const std::vector<float>& times, std::size_t count, double time) {
    const auto end = times.begin() + static_cast<std::ptrdiff_t>(count);
    const auto after = std::upper_bound(times.begin(), end, time,
                                        [](double value, float key) { return value < static_cast<double>(key); });
    if (after == times.begin()) return {};
    const std::size_t left = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == end) return {left, left, 0.0f, 0.0f};
    const double length = static_cast<double>(times[left + 1]) - static_cast<double>(times[left]);
    const double fraction = length > 0 ? (time - static_cast<double>(times[left])) / length : 1.0;
    return {left, left + 1, static_cast<float>(fraction), static_cast<float>(length)};
}

// Zero and non-finite quaternions turn nothing.
glm::quat normalized_or_identity(const glm::quat& q) {
    const float length = std::sqrt(glm::dot(q, q));
    if (!(length > 0.0f) || !std::isfinite(length)) return {1.0f, 0.0f, 0.0f, 0.0f};
    return q / length;
}

glm::quat slerp_shortest(const glm::quat& from, glm::quat to, float fraction) {
    float cosine = glm::dot(from, to);
    if (cosine < 0.0f) {  // q and -q are one rotation: take the sign that is nearer
        to = -to;
        cosine = -cosine;
    }
    constexpr float nearly_parallel = 0.9995f;  // below this angle the chord is as good as the arc, and sin is safe
    if (cosine > nearly_parallel) return normalized_or_identity(from * (1.0f - fraction) + to * fraction);
    const float angle = std::acos(cosine);
    const float scale = 1.0f / std::sin(angle);
    return normalized_or_identity(from * (std::sin((1.0f - fraction) * angle) * scale) +
                                  to * (std::sin(fraction * angle) * scale));
}

// Reads one channel whose keys have `width` floats each.
class ChannelReader {
public:
    ChannelReader(const model::Channel& channel, std::size_t width) : channel_(channel), width_(width) {
        const std::size_t stride = width * parts();
        key_count_ = stride == 0 ? 0 : std::min(channel.times.size(), channel.values.size() / stride);
    }

    bool empty() const { return key_count_ == 0; }
    std::size_t width() const { return width_; }

    Segment segment(double time) const { return find_segment(channel_.times, key_count_, time); }

    // The value of key `key`, component `at`.
    float value(std::size_t key, std::size_t at) const { return part(key, parts() == 3 ? 1 : 0, at); }

    // Component `at` on `segment`, by the channel's interpolation, component by component.
    float interpolate(const Segment& segment, std::size_t at) const {
        const float a = value(segment.left, at);
        if (segment.left == segment.right || channel_.interpolation == model::Interpolation::step) return a;
        const float b = value(segment.right, at);
        const float s = segment.fraction;
        if (channel_.interpolation == model::Interpolation::linear) return a + (b - a) * s;
        const float leaving = part(segment.left, 2, at) * segment.length;
        const float arriving = part(segment.right, 0, at) * segment.length;
        const float s2 = s * s, s3 = s2 * s;  // the Hermite basis, glTF 2.0 appendix C
        return (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * leaving + (3 * s2 - 2 * s3) * b + (s3 - s2) * arriving;
    }

private:
    std::size_t parts() const { return channel_.interpolation == model::Interpolation::cubic_spline ? 3 : 1; }

    // A cubic spline's key holds in-tangent, value and out-tangent as parts 0, 1, 2.
    float part(std::size_t key, std::size_t which, std::size_t at) const {
        return channel_.values[(key * parts() + which) * width_ + at];
    }

    const model::Channel& channel_;
    std::size_t width_;
    std::size_t key_count_ = 0;
};

glm::vec3 vector_at(const model::Channel& channel, double time, const glm::vec3& without_keys) {
    const ChannelReader reader(channel, 3);
    if (reader.empty()) return without_keys;
    const Segment segment = reader.segment(time);
    return {reader.interpolate(segment, 0), reader.interpolate(segment, 1), reader.interpolate(segment, 2)};
}

glm::quat rotation_at(const model::Channel& channel, double time, const glm::quat& without_keys) {
    const ChannelReader reader(channel, 4);
    if (reader.empty()) return without_keys;
    const Segment segment = reader.segment(time);
    if (channel.interpolation == model::Interpolation::linear && segment.left != segment.right) {
        const auto key = [&](std::size_t i) {
            return normalized_or_identity(
                {reader.value(i, 3), reader.value(i, 0), reader.value(i, 1), reader.value(i, 2)});
        };
        return slerp_shortest(key(segment.left), key(segment.right), segment.fraction);
    }
    return normalized_or_identity({reader.interpolate(segment, 3), reader.interpolate(segment, 0),
                                   reader.interpolate(segment, 1), reader.interpolate(segment, 2)});
}

void apply_morph_weights(const model::Channel& channel, double time, const std::vector<model::MorphTarget>& morphs,
                         std::vector<float>& weights) {
    if (channel.times.empty()) return;
    const std::size_t parts = channel.interpolation == model::Interpolation::cubic_spline ? 3 : 1;
    const std::size_t slots = channel.values.size() / (channel.times.size() * parts);
    const ChannelReader reader(channel, slots);
    if (reader.empty()) return;
    const Segment segment = reader.segment(time);
    for (std::size_t i = 0; i < morphs.size(); ++i) {
        const std::size_t slot = static_cast<std::size_t>(morphs[i].weight);
        if (morphs[i].node == channel.node && slot < slots) weights[i] = reader.interpolate(segment, slot);
    }
}

std::vector<float> values_at(const model::Channel& channel, double time) {
    if (channel.path == model::Path::rotation) {
        const glm::quat rotation = rotation_at(channel, time, glm::quat(1, 0, 0, 0));
        return {rotation.x, rotation.y, rotation.z, rotation.w};
    }
    const std::size_t parts = channel.interpolation == model::Interpolation::cubic_spline ? 3 : 1;
    const ChannelReader reader(channel, channel.values.size() / (channel.times.size() * parts));
    std::vector<float> values;
    if (reader.empty()) return values;
    const Segment segment = reader.segment(time);
    for (std::size_t i = 0; i < reader.width(); ++i) values.push_back(reader.interpolate(segment, i));
    return values;
}

// Rotations are added on the side of the first: a quaternion and its opposite are the same.
model::Channel mean_of(const model::Channel& channel, double duration) {
    constexpr int moments = 48;
    model::Channel mean{channel.node, channel.path, model::Interpolation::step, {0.0f}, {}};
    std::vector<float> first;
    for (int i = 0; i < moments; ++i) {
        const std::vector<float> values = values_at(channel, duration * i / moments);
        if (i == 0) first = values;
        const float along = std::inner_product(values.begin(), values.end(), first.begin(), 0.0f);
        const float sign = channel.path == model::Path::rotation && along < 0 ? -1.0f : 1.0f;
        mean.values.resize(values.size());
        for (std::size_t j = 0; j < values.size(); ++j) mean.values[j] += sign * values[j] / moments;
    }
    return mean;
}

glm::mat4 matrix_of(const model::Transform& transform) {
    glm::mat4 matrix = glm::mat4_cast(transform.rotation);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= transform.scale[axis];
    matrix[3] = glm::vec4(transform.translation, 1.0f);
    return matrix;
}

void start_from_rest(const model::Character& character, Pose& out) {
    out.world.clear();
    for (const model::Node& node : character.skeleton.nodes) out.world.push_back(node.rest_matrix);
    out.morph_weights.clear();
    for (const model::MorphTarget& morph : character.mesh.morphs) out.morph_weights.push_back(morph.rest_weight);
}

void add_offsets(const std::vector<glm::vec3>& offsets, float weight, std::size_t first, std::vector<glm::vec3>& to) {
    assert(first + offsets.size() <= to.size());
    for (std::size_t i = 0; i < offsets.size(); ++i) to[first + i] += weight * offsets[i];
}

// The matrix that takes normals to normals, up to length: the cofactors (which exist even where the inverse does
// not), with the determinant's sign taken out again, so that a mirror doesn't turn the surface inside out.
glm::mat3 normal_matrix(const glm::mat3& m) {
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0.0f ? -cofactors : cofactors;
}

glm::mat4 blended_matrix(const model::Mesh& mesh, const Pose& pose, std::size_t vertex) {
    glm::mat4 blend(0.0f);
    mesh.visit_influences(vertex, [&](std::uint16_t joint, float weight) {
        if (weight != 0.0f) blend += pose.palette[joint] * weight;
    });
    return blend;
}

}  // namespace

void evaluate_rest(const model::Character& character, Pose& out) {
    start_from_rest(character, out);
    model::resolve_hierarchy(character.skeleton, out.world, out.palette);
}

void evaluate(const model::Character& character, const model::Clip& clip, double time, Pose& out) {
    start_from_rest(character, out);
    const std::vector<model::Node>& nodes = character.skeleton.nodes;
    std::vector<model::Transform> locals(nodes.size());
    std::vector<bool> driven(nodes.size(), false);
    for (const model::Channel& channel : clip.channels) {
        if (channel.path == model::Path::morph_weights) {
            apply_morph_weights(channel, time, character.mesh.morphs, out.morph_weights);
            continue;
        }
        const std::size_t node = static_cast<std::size_t>(channel.node);
        model::Transform& local = locals[node];
        if (!driven[node]) local = nodes[node].rest;
        driven[node] = true;
        if (channel.path == model::Path::translation) local.translation = vector_at(channel, time, local.translation);
        if (channel.path == model::Path::rotation) local.rotation = rotation_at(channel, time, local.rotation);
        if (channel.path == model::Path::scale) local.scale = vector_at(channel, time, local.scale);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (driven[i]) out.world[i] = matrix_of(locals[i]);
    }
    model::resolve_hierarchy(character.skeleton, out.world, out.palette);
}

model::Clip mean_of(const model::Clip& clip) {
    model::Clip mean{clip.name, 0, {}};
    for (const model::Channel& channel : clip.channels)
        if (!channel.times.empty()) mean.channels.push_back(mean_of(channel, clip.duration));
    return mean;
}

void skin(const model::Mesh& mesh, const Pose& pose, std::vector<glm::vec3>& positions,
          std::vector<glm::vec3>& normals) {
    positions = mesh.positions;
    normals = mesh.normals;
    for (std::size_t i = 0; i < mesh.morphs.size(); ++i) {
        const model::MorphTarget& morph = mesh.morphs[i];
        if (pose.morph_weights[i] == 0.0f) continue;
        add_offsets(morph.position_offsets, pose.morph_weights[i], morph.first_vertex, positions);
        add_offsets(morph.normal_offsets, pose.morph_weights[i], morph.first_vertex, normals);
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::mat4 blend = blended_matrix(mesh, pose, i);
        positions[i] = glm::vec3(blend * glm::vec4(positions[i], 1.0f));
        const glm::vec3 normal = normal_matrix(glm::mat3(blend)) * normals[i];
        const float length = glm::length(normal);
        // A joint scaled to nothing leaves no direction: keep the unposed one.
        normals[i] = length > 0.0f && std::isfinite(length) ? normal / length : mesh.normals[i];
    }
}

Bounds bounds_of(std::span<const glm::vec3> positions) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Bounds bounds{glm::vec3(infinity), glm::vec3(-infinity)};
    for (const glm::vec3& position : positions) {
        if (!std::isfinite(position.x + position.y + position.z)) continue;
        bounds.min = glm::min(bounds.min, position);
        bounds.max = glm::max(bounds.max, position);
    }
    return bounds.min.x <= bounds.max.x ? bounds : Bounds{};
}

}  // namespace motion
