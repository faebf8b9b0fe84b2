// What a character does at a time, in double and by other means than motion/pose.cpp: no matrices but the file's own,
// rotations by the sandwich product, arcs by axis and angle, splines by de Casteljau, normals by their tangents.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "model/character.h"

namespace tests::reference {

using model::Channel;
using model::Interpolation;
using model::Path;

struct Turn {
    double x = 0, y = 0, z = 0, w = 1;
};

inline Turn times(const Turn& a, const Turn& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

inline Turn inverse(const Turn& q) {
    return {-q.x, -q.y, -q.z, q.w};
}

inline Turn unit(const std::vector<double>& v) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
    return {v[0] / length, v[1] / length, v[2] / length, v[3] / length};
}

inline glm::dvec3 turned(const Turn& q, const glm::dvec3& v) {
    const Turn r = times(times(q, {v.x, v.y, v.z, 0}), inverse(q));
    return {r.x, r.y, r.z};
}

// a * (a^-1 b)^s, over the shorter way.
inline Turn between(const Turn& a, const Turn& b, double s) {
    Turn step = times(inverse(a), b);
    if (step.w < 0) step = {-step.x, -step.y, -step.z, -step.w};
    const double sine = std::sqrt(step.x * step.x + step.y * step.y + step.z * step.z);
    if (sine < 1e-12) return a;
    const double angle = std::atan2(sine, step.w) * s;
    const double scale = std::sin(angle) / sine;
    return times(a, {step.x * scale, step.y * scale, step.z * scale, std::cos(angle)});
}

// The two keys around a time and how far between them it lies; outside of all keys, twice the nearest.
struct Keys {
    std::size_t left = 0, right = 0;
    double s = 0, length = 0;
};

inline Keys keys_at(const Channel& channel, double time) {
    Keys keys;
    while (keys.right < channel.times.size() && static_cast<double>(channel.times[keys.right]) <= time) ++keys.right;
    if (keys.right == 0) return {};
    keys.left = keys.right - 1;
    if (keys.right == channel.times.size()) return {keys.left, keys.left, 0, 0};
    keys.length = static_cast<double>(channel.times[keys.right]) - static_cast<double>(channel.times[keys.left]);
    keys.s = (time - static_cast<double>(channel.times[keys.left])) / keys.length;
    return keys;
}

enum class Part { arriving, value, leaving };

// One part of a key; only cubic splines have tangents.
inline std::vector<double> part_of(const Channel& channel, std::size_t key, Part part, std::size_t width) {
    const bool cubic = channel.interpolation == Interpolation::cubic_spline;
    const float* at = &channel.values[(cubic ? 3 * key + static_cast<std::size_t>(part) : key) * width];
    return {at, at + width};
}

inline std::vector<double> mixed(const std::vector<double>& a, const std::vector<double>& b, double s) {
    std::vector<double> out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] * (1 - s) + b[i] * s;
    return out;
}

// A cubic in Bezier's form: the tangents, over a third of the way, are the inner corners.
inline std::vector<double> spline(const Channel& channel, const Keys& keys, std::size_t width) {
    const std::vector<double> a = part_of(channel, keys.left, Part::value, width),
                              b = part_of(channel, keys.right, Part::value, width),
                              leaving = part_of(channel, keys.left, Part::leaving, width),
                              arriving = part_of(channel, keys.right, Part::arriving, width);
    std::vector<double> after = a, before = b;
    for (std::size_t i = 0; i < width; ++i) {
        after[i] += leaving[i] * keys.length / 3;
        before[i] -= arriving[i] * keys.length / 3;
    }
    const std::vector<double> middle = mixed(after, before, keys.s);
    return mixed(mixed(mixed(a, after, keys.s), middle, keys.s), mixed(middle, mixed(before, b, keys.s), keys.s),
                 keys.s);
}

inline std::vector<double> vector_at(const Channel& channel, double time, std::size_t width) {
    const Keys keys = keys_at(channel, time);
    const std::vector<double> left = part_of(channel, keys.left, Part::value, width);
    if (keys.left == keys.right || channel.interpolation == Interpolation::step) return left;
    if (channel.interpolation == Interpolation::cubic_spline) return spline(channel, keys, width);
    return mixed(left, part_of(channel, keys.right, Part::value, width), keys.s);
}

inline Turn turn_at(const Channel& channel, double time) {
    const Keys keys = keys_at(channel, time);
    if (channel.interpolation != Interpolation::linear || keys.left == keys.right)
        return unit(vector_at(channel, time, 4));
    return between(unit(part_of(channel, keys.left, Part::value, 4)),
                   unit(part_of(channel, keys.right, Part::value, 4)), keys.s);
}

inline glm::dvec3 vec3_of(const std::vector<double>& v) {
    return {v[0], v[1], v[2]};
}

// A character at one time of a clip, or at rest without one.
class Figure {
public:
    explicit Figure(const model::Character& character) : character_(character) {
        for (const model::Node& node : character.skeleton.nodes) {
            const glm::quat& q = node.rest.rotation;
            nodes_.push_back({false, node.rest.translation, {q.x, q.y, q.z, q.w}, node.rest.scale});
        }
        for (const model::MorphTarget& morph : character.mesh.morphs)
            morph_weights.push_back(static_cast<double>(morph.rest_weight));
    }

    Figure(const model::Character& character, const model::Clip& clip, double time) : Figure(character) {
        for (const Channel& channel : clip.channels) drive(channel, time);
    }

    // Of a place in a node's own space, in model space.
    glm::dvec3 place(std::int32_t node, glm::dvec3 p) const {
        for (; node >= 0; node = character_.skeleton.nodes[static_cast<std::size_t>(node)].parent) {
            const Local& local = nodes_[static_cast<std::size_t>(node)];
            if (local.driven)
                p = turned(local.rotation, p * local.scale) + local.translation;
            else
                p = applied(character_.skeleton.nodes[static_cast<std::size_t>(node)].rest_matrix, p);
        }
        return p;
    }

    glm::dvec3 position(std::size_t vertex) const { return skinned(vertex, morphed(vertex)); }

    // A normal stays across the tangents of its surface, and on the side that was outside.
    glm::dvec3 normal(std::size_t vertex) const {
        const glm::dvec3 at = morphed(vertex), before = morphed_normal(vertex);
        const glm::dvec3 aside = std::abs(before.x) < std::abs(before.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 first = glm::normalize(glm::cross(before, aside)), second = glm::cross(before, first);
        const auto moved = [&](const glm::dvec3& by) { return skinned(vertex, at + by) - skinned(vertex, at); };
        const glm::dvec3 across = glm::normalize(glm::cross(moved(first), moved(second)));
        return glm::dot(across, moved(before)) < 0 ? -across : across;
    }

    // How far from flat the map around a vertex is, (0, 1]: the volume of a cube over that of its longest edge's.
    double roundness(std::size_t vertex) const {
        const glm::dvec3 at = morphed(vertex);
        glm::dmat3 edges;
        double longest = 0;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 by(0);
            by[axis] = 1;
            edges[axis] = skinned(vertex, at + by) - skinned(vertex, at);
            longest = std::max(longest, glm::length(edges[axis]));
        }
        return std::abs(glm::determinant(edges)) / (longest * longest * longest);
    }

    std::vector<double> morph_weights;

private:
    struct Local {
        bool driven = false;
        glm::dvec3 translation;
        Turn rotation;
        glm::dvec3 scale;
    };

    void drive(const Channel& channel, double time) {
        if (channel.path == Path::morph_weights) {
            const std::size_t parts = channel.interpolation == Interpolation::cubic_spline ? 3 : 1,
                              slots = channel.values.size() / channel.times.size() / parts;
            const std::vector<double> values = vector_at(channel, time, slots);
            for (std::size_t i = 0; i < morph_weights.size(); ++i) {
                const model::MorphTarget& morph = character_.mesh.morphs[i];
                if (morph.node == channel.node && static_cast<std::size_t>(morph.weight) < slots)
                    morph_weights[i] = values[static_cast<std::size_t>(morph.weight)];
            }
            return;
        }
        Local& local = nodes_[static_cast<std::size_t>(channel.node)];
        local.driven = true;
        if (channel.path == Path::translation) local.translation = vec3_of(vector_at(channel, time, 3));
        if (channel.path == Path::scale) local.scale = vec3_of(vector_at(channel, time, 3));
        if (channel.path == Path::rotation) local.rotation = turn_at(channel, time);
    }

    static glm::dvec3 applied(const glm::mat4& matrix, const glm::dvec3& p) {
        return glm::dvec3(glm::dmat4(matrix) * glm::dvec4(p, 1));
    }

    glm::dvec3 with_offsets(glm::dvec3 v, std::size_t vertex,
                            std::vector<glm::vec3> model::MorphTarget::*offsets) const {
        for (std::size_t i = 0; i < morph_weights.size(); ++i) {
            const model::MorphTarget& morph = character_.mesh.morphs[i];
            if (vertex < morph.first_vertex || vertex - morph.first_vertex >= (morph.*offsets).size()) continue;
            v += morph_weights[i] * glm::dvec3((morph.*offsets)[vertex - morph.first_vertex]);
        }
        return v;
    }
    glm::dvec3 morphed(std::size_t vertex) const {
        return with_offsets(character_.mesh.positions[vertex], vertex, &model::MorphTarget::position_offsets);
    }
    glm::dvec3 morphed_normal(std::size_t vertex) const {
        return glm::normalize(
            with_offsets(character_.mesh.normals[vertex], vertex, &model::MorphTarget::normal_offsets));
    }

    // Where its joints take a place beside the vertex.
    glm::dvec3 skinned(std::size_t vertex, const glm::dvec3& p) const {
        glm::dvec3 sum(0);
        character_.mesh.visit_influences(vertex, [&](std::uint16_t joint, float weight) {
            const model::PaletteEntry& entry = character_.skeleton.palette[joint];
            sum += place(entry.node, applied(entry.inverse_bind, p)) * static_cast<double>(weight);
        });
        return sum;
    }

    const model::Character& character_;
    std::vector<Local> nodes_;
};

}  // namespace tests::reference
