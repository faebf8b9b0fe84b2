// A character for tests: a tube on a chain of joints with arbitrary rest poses, weights and keys, all seeded.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "model/character.h"

namespace tests {

// Uniform on [from, to), the same on every platform (std::uniform_real_distribution is not).
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    float operator()(float from, float to) {
        const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
        return static_cast<float>(from + (to - from) * unit);
    }
    glm::quat rotation() {
        glm::quat q(0.0f, 0.0f, 0.0f, 0.0f);
        while (glm::dot(q, q) < 0.01f) q = glm::quat((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
        return glm::normalize(q);
    }
    glm::vec3 vector(float from, float to) { return {(*this)(from, to), (*this)(from, to), (*this)(from, to)}; }

private:
    std::mt19937_64 engine_;
};

inline glm::mat4 matrix_of(const model::Transform& t) {
    glm::mat4 m = glm::mat4_cast(t.rotation);
    for (int axis = 0; axis < 3; ++axis) m[axis] *= t.scale[axis];
    m[3] = glm::vec4(t.translation, 1.0f);
    return m;
}

inline void add_tube(model::Mesh& mesh, int rings, int sides, int joints, Random& random) {
    for (int ring = 0; ring < rings; ++ring) {
        for (int side = 0; side < sides; ++side) {
            const float angle = 6.2831853f * static_cast<float>(side) / static_cast<float>(sides);
            const glm::vec3 outward(std::cos(angle), 0.0f, std::sin(angle));
            mesh.positions.push_back(0.3f * outward + glm::vec3(0.0f, 0.4f * static_cast<float>(ring), 0.0f));
            mesh.normals.push_back(outward);
            glm::u16vec4 joint;
            glm::vec4 weight;
            for (int i = 0; i < 4; ++i) {
                joint[i] = static_cast<std::uint16_t>(random(0.0f, static_cast<float>(joints)));
                weight[i] = random(0.0f, 1.0f);
            }
            mesh.joints.push_back(joint);
            mesh.weights.push_back(weight / (weight.x + weight.y + weight.z + weight.w));
        }
    }
    for (int ring = 0; ring + 1 < rings; ++ring) {
        for (int side = 0; side < sides; ++side) {
            const auto at = [&](int r, int s) { return static_cast<std::uint32_t>(r * sides + s % sides); };
            const std::uint32_t a = at(ring, side), b = at(ring, side + 1), c = at(ring + 1, side),
                                d = at(ring + 1, side + 1);
            mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
        }
    }
    const std::size_t count = mesh.positions.size();
    mesh.uvs.resize(count);
    mesh.colors.resize(count, glm::u8vec4(255));
    mesh.slots.resize(count);
    mesh.materials.resize(1);
    mesh.material_ids.resize(count);
}

// `joints` in a chain, a clip "writhe" of `duration` [s] with linear keys on every path of every joint.
inline model::Character make_tentacle(std::uint64_t seed, int joints = 5, float duration = 1.5f) {
    Random random(seed);
    model::Character character;
    character.name = "tentacle";
    for (int i = 0; i < joints; ++i) {
        model::Node node;
        node.parent = i - 1;
        node.rest = {random.vector(-0.5f, 0.5f), random.rotation(), random.vector(0.7f, 1.4f)};
        node.rest_matrix = matrix_of(node.rest);
        character.skeleton.nodes.push_back(node);
        glm::mat4 bind = matrix_of({random.vector(-0.5f, 0.5f), random.rotation(), random.vector(0.7f, 1.4f)});
        character.skeleton.palette.push_back({i, bind});
    }
    model::Clip clip{"writhe", static_cast<double>(duration), {}};
    const int keys = 6;
    for (int i = 0; i < joints; ++i) {
        for (const model::Path path : {model::Path::translation, model::Path::rotation, model::Path::scale}) {
            model::Channel channel{i, path, model::Interpolation::linear, {}, {}};
            for (int key = 0; key < keys; ++key) {
                channel.times.push_back(duration * static_cast<float>(key) / static_cast<float>(keys - 1));
                const glm::vec3 v = path == model::Path::scale ? random.vector(0.7f, 1.4f) : random.vector(-0.5f, 0.5f);
                const glm::quat q = random.rotation();
                if (path == model::Path::rotation)
                    channel.values.insert(channel.values.end(), {q.x, q.y, q.z, q.w});
                else
                    channel.values.insert(channel.values.end(), {v.x, v.y, v.z});
            }
            clip.channels.push_back(channel);
        }
    }
    character.clips.push_back(clip);
    add_tube(character.mesh, 12, 10, joints, random);
    return character;
}

}  // namespace tests
