#include "tests/reference/surface.h"

#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace reference {

namespace {

using Numbers = std::vector<double>;

// One key of a channel: `which` is 0 for the value of a plain key; 0, 1, 2 for a spline's in-tangent, value,
// out-tangent.
Numbers key_part(const motion::Channel& channel, std::size_t key, std::size_t which, std::size_t width) {
    const std::size_t parts = channel.interpolation == motion::Interpolation::cubic_spline ? 3 : 1;
    Numbers part(width);
    for (std::size_t i = 0; i < width; ++i) part[i] = channel.values[(key * parts + which) * width + i];
    return part;
}

// Along the great arc from `a` to the nearer of `b` and -b, which are one rotation.
Numbers slerp(Numbers a, Numbers b, double s) {
    const auto dot = [](const Numbers& p, const Numbers& q) {
        return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    };
    const double length_a = std::sqrt(dot(a, a)), length_b = std::sqrt(dot(b, b));
    const double sign = dot(a, b) < 0 ? -1 : 1;
    for (int i = 0; i < 4; ++i) {
        a[i] /= length_a;
        b[i] *= sign / length_b;
    }
    // The arc's angle by atan2, which is exact for small ones too.
    Numbers apart(4), sum(4), result(4);
    for (int i = 0; i < 4; ++i) {
        apart[i] = b[i] - a[i];
        sum[i] = b[i] + a[i];
    }
    const double angle = 2 * std::atan2(std::sqrt(dot(apart, apart)), std::sqrt(dot(sum, sum)));
    const double share_a = angle > 0 ? std::sin((1 - s) * angle) / std::sin(angle) : 1 - s;
    const double share_b = angle > 0 ? std::sin(s * angle) / std::sin(angle) : s;
    for (int i = 0; i < 4; ++i) result[i] = share_a * a[i] + share_b * b[i];
    return result;
}

Numbers value_at(const motion::Channel& channel, std::size_t width, double seconds) {
    const bool spline = channel.interpolation == motion::Interpolation::cubic_spline;
    const std::size_t last = channel.times.size() - 1, value = spline ? 1 : 0;
    if (seconds <= channel.times.front()) return key_part(channel, 0, value, width);
    if (seconds >= channel.times[last]) return key_part(channel, last, value, width);
    std::size_t left = 0;
    while (channel.times[left + 1] <= seconds) ++left;
    const Numbers a = key_part(channel, left, value, width), b = key_part(channel, left + 1, value, width);
    if (channel.interpolation == motion::Interpolation::step) return a;
    const double from = channel.times[left], step = channel.times[left + 1] - from, s = (seconds - from) / step;
    if (!spline && channel.path == motion::Path::rotation) return slerp(a, b, s);
    Numbers result(width);
    for (std::size_t i = 0; i < width; ++i) result[i] = (1 - s) * a[i] + s * b[i];
    if (!spline) return result;
    const Numbers leaving = key_part(channel, left, 2, width), arriving = key_part(channel, left + 1, 0, width);
    for (std::size_t i = 0; i < width; ++i) {
        const double out = step * leaving[i], in = step * arriving[i], rise = b[i] - a[i];
        // The cubic with these two ends and these two slopes, in powers of s.
        result[i] = a[i] + s * (out + s * (3 * rise - 2 * out - in + s * (out + in - 2 * rise)));
    }
    return result;
}

struct Local {
    Numbers translation, rotation, scale;
};

glm::dmat4 matrix_of(const Local& local) {
    const glm::dquat turn(local.rotation[3], local.rotation[0], local.rotation[1], local.rotation[2]);
    const glm::dmat4 moved =
        glm::translate(glm::dmat4(1), glm::dvec3(local.translation[0], local.translation[1], local.translation[2]));
    return glm::scale(moved * glm::mat4_cast(glm::normalize(turn)),
                      glm::dvec3(local.scale[0], local.scale[1], local.scale[2]));
}

std::vector<glm::dmat4> world_matrices(const motion::Character& character, int clip, double seconds) {
    std::vector<glm::dmat4> world;
    for (std::size_t node = 0; node < character.skeleton.nodes.size(); ++node) {
        const motion::Node& at = character.skeleton.nodes[node];
        const auto& [t, r, s] = at.rest;
        Local local{{t.x, t.y, t.z}, {r.x, r.y, r.z, r.w}, {s.x, s.y, s.z}};
        bool driven = false;
        if (clip >= 0) {
            for (const motion::Channel& channel : character.clips[static_cast<std::size_t>(clip)].channels) {
                if (channel.node != static_cast<int>(node) || channel.path == motion::Path::morph_weights) continue;
                driven = true;
                if (channel.path == motion::Path::translation) local.translation = value_at(channel, 3, seconds);
                if (channel.path == motion::Path::rotation) local.rotation = value_at(channel, 4, seconds);
                if (channel.path == motion::Path::scale) local.scale = value_at(channel, 3, seconds);
            }
        }
        const glm::dmat4 own = driven ? matrix_of(local) : glm::dmat4(at.rest_matrix);
        world.push_back(at.parent < 0 ? own : world[static_cast<std::size_t>(at.parent)] * own);
    }
    return world;
}

double morph_weight(const motion::Character& character, const motion::MorphTarget& morph, int clip, double seconds) {
    double weight = morph.rest_weight;
    if (clip < 0) return weight;
    for (const motion::Channel& channel : character.clips[static_cast<std::size_t>(clip)].channels) {
        if (channel.path != motion::Path::morph_weights || channel.node != morph.node) continue;
        const std::size_t parts = channel.interpolation == motion::Interpolation::cubic_spline ? 3 : 1;
        const std::size_t slots = channel.values.size() / channel.times.size() / parts;
        if (static_cast<std::size_t>(morph.slot) < slots)
            weight = value_at(channel, slots, seconds)[static_cast<std::size_t>(morph.slot)];
    }
    return weight;
}

}  // namespace

Surface surface_at(const motion::Character& character, int clip, double seconds) {
    const motion::Mesh& mesh = character.mesh;
    Surface surface;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        surface.positions.emplace_back(mesh.positions[v]);
        surface.normals.emplace_back(mesh.normals[v]);
    }
    for (const motion::MorphTarget& morph : mesh.morphs) {
        const double weight = morph_weight(character, morph, clip, seconds);
        for (std::size_t i = 0; i < morph.position_offsets.size(); ++i)
            surface.positions[morph.first_vertex + i] += weight * glm::dvec3(morph.position_offsets[i]);
        for (std::size_t i = 0; i < morph.normal_offsets.size(); ++i)
            surface.normals[morph.first_vertex + i] += weight * glm::dvec3(morph.normal_offsets[i]);
    }
    const std::vector<glm::dmat4> world = world_matrices(character, clip, seconds);
    std::vector<glm::dmat4> bones;
    for (const motion::PaletteEntry& entry : character.skeleton.palette)
        bones.push_back(world[static_cast<std::size_t>(entry.node)] * glm::dmat4(entry.inverse_bind));
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        glm::dmat4 blend(0);
        for (int i = 0; i < 4; ++i)
            if (mesh.weights[v][i] > 0) blend += static_cast<double>(mesh.weights[v][i]) * bones[mesh.joints[v][i]];
        surface.positions[v] = glm::dvec3(blend * glm::dvec4(surface.positions[v], 1));
        surface.normals[v] = glm::normalize(glm::inverseTranspose(glm::dmat3(blend)) * surface.normals[v]);
    }
    return surface;
}

double area_of(const motion::Mesh& mesh, const Surface& surface) {
    double area = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = surface.positions[mesh.indices[i]], b = surface.positions[mesh.indices[i + 1]],
                         c = surface.positions[mesh.indices[i + 2]];
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

}  // namespace reference
