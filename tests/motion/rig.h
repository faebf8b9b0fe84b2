// Characters that use all that a file may say: any tree of nodes, mirrored, sheared and uneven, any palette, morphs of
// several nodes, and clips of every interpolation on every path. Seeded.
#pragma once

#include <algorithm>
#include <utility>

#include "tests/motion/tentacle.h"

namespace tests {

class RigMaker {
public:
    explicit RigMaker(std::uint64_t seed) : random_(seed) {}

    model::Character make(int clips = 1) {
        model::Character character;
        character.name = "rig";
        for (int i = 0; i < nodes; ++i) character.skeleton.nodes.push_back(node(i));
        // Several of one node, none of others, in no order.
        for (int i = 0; i < entries; ++i) {
            glm::mat4 bind = matrix_of(transform());
            bind[2].x += random_(-0.3f, 0.3f);
            character.skeleton.palette.push_back({index(nodes), bind});
        }
        add_mesh(character.mesh);
        add_morphs(character.mesh);
        for (int i = 0; i < clips; ++i) character.clips.push_back(clip(character));
        return character;
    }

private:
    static constexpr int nodes = 9, entries = 7, vertices = 60;
    static constexpr int morphed_nodes[] = {2, 5};

    std::int32_t index(int count) { return static_cast<std::int32_t>(random_(0.0f, static_cast<float>(count))); }
    bool chance(float share) { return random_(0.0f, 1.0f) < share; }

    // Up to twice as long and half as short; one axis in six is mirrored.
    glm::vec3 scale() {
        glm::vec3 scale = random_.vector(0.6f, 1.5f);
        for (int axis = 0; axis < 3; ++axis)
            if (chance(1.0f / 6)) scale[axis] = -scale[axis];
        return scale;
    }
    model::Transform transform() { return {random_.vector(-0.5f, 0.5f), random_.rotation(), scale()}; }

    model::Node node(int i) {
        model::Node node;
        node.parent = index(i + 1) - 1;
        node.rest = transform();
        node.rest_matrix = matrix_of(node.rest);
        if (chance(0.3f)) node.rest_matrix[1].x += 0.4f;
        return node;
    }

    void add_mesh(model::Mesh& mesh) {
        for (int i = 0; i < vertices; ++i) {
            mesh.positions.push_back(random_.vector(-1, 1));
            mesh.normals.push_back(random_.rotation() * glm::vec3(0, 0, 1));
            glm::u16vec4 joints;
            glm::vec4 weights;
            for (int k = 0; k < 4; ++k) {
                joints[k] = static_cast<std::uint16_t>(index(entries));
                weights[k] = k > 0 && chance(0.4f) ? 0.0f : random_(0.1f, 1.0f);
            }
            mesh.joints.push_back(joints);
            mesh.weights.push_back(weights / (weights.x + weights.y + weights.z + weights.w));
        }
        for (std::uint32_t i = 0; i + 2 < vertices; ++i) mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + 2});
        mesh.uvs.resize(vertices);
        mesh.colors.resize(vertices, glm::u8vec4(255));
        mesh.slots.resize(vertices);
        mesh.materials.resize(1);
        mesh.material_ids.resize(vertices);
    }

    // Of two nodes with the same slots, over runs that overlap; half of them with normals.
    void add_morphs(model::Mesh& mesh) {
        for (const std::int32_t node : morphed_nodes) {
            for (std::int32_t slot = 0; slot < 3; ++slot) {
                model::MorphTarget morph{node, slot, random_(-0.5f, 1.0f), static_cast<std::uint32_t>(index(30)),
                                         {},   {}};
                for (int i = 0; i < 25; ++i) morph.position_offsets.push_back(random_.vector(-0.4f, 0.4f));
                for (int i = 0; i < 25 && slot != 1; ++i) morph.normal_offsets.push_back(random_.vector(-0.4f, 0.4f));
                mesh.morphs.push_back(morph);
            }
        }
        std::swap(mesh.morphs[1], mesh.morphs[4]);
    }

    // From a time after 0 on, some of them together.
    std::vector<float> times() {
        std::vector<float> times{random_(0.0f, 0.4f)};
        for (int i = index(5); i > 0; --i) times.push_back(times.back() + (chance(0.2f) ? 0.0f : random_(0.05f, 0.6f)));
        return times;
    }

    // One value and, of a spline, its two tangents, which differ.
    void add_key(model::Channel& channel, const glm::quat& middle, std::size_t slots) {
        const auto some = [&](float from, float to) {
            for (std::size_t i = 0; i < slots; ++i) channel.values.push_back(random_(from, to));
        };
        const bool cubic = channel.interpolation == model::Interpolation::cubic_spline;
        if (cubic) some(-1, 1);
        if (channel.path == model::Path::rotation) {
            // A spline runs through the quaternions' own space: its keys are near to each other, away from zero.
            glm::quat q = cubic ? middle : random_.rotation();
            if (cubic) q = q + 0.3f * random_.rotation();
            q = q * random_(0.7f, 1.5f);
            channel.values.insert(channel.values.end(), {q.x, q.y, q.z, q.w});
        } else if (channel.path == model::Path::scale) {
            const glm::vec3 s = scale();
            channel.values.insert(channel.values.end(), {s.x, s.y, s.z});
        } else {
            some(-0.5f, 0.5f);
        }
        if (cubic) some(-1, 1);
    }

    model::Channel channel(std::int32_t node, model::Path path, std::size_t slots) {
        model::Channel channel{node, path, static_cast<model::Interpolation>(index(3)), times(), {}};
        const glm::quat middle = random_.rotation();
        for (std::size_t i = 0; i < channel.times.size(); ++i) add_key(channel, middle, slots);
        return channel;
    }

    // Some paths of most nodes; the morphs' weights, of one node too few for its slots.
    model::Clip clip(const model::Character& character) {
        model::Clip clip{"clip", 0, {}};
        for (std::int32_t node = 0; node < nodes; ++node)
            for (const model::Path path : {model::Path::translation, model::Path::rotation, model::Path::scale})
                if (chance(0.5f)) clip.channels.push_back(channel(node, path, path == model::Path::rotation ? 4 : 3));
        for (std::size_t i = 0; i < std::size(morphed_nodes); ++i)
            clip.channels.push_back(channel(morphed_nodes[i], model::Path::morph_weights, 3 - i));
        for (std::size_t i = character.skeleton.nodes.size(); i > 0; --i)  // in no order
            std::swap(clip.channels[static_cast<std::size_t>(index(static_cast<int>(clip.channels.size())))],
                      clip.channels.front());
        for (const model::Channel& channel : clip.channels)
            clip.duration = std::max(clip.duration, static_cast<double>(channel.times.back()));
        return clip;
    }

    Random random_;
};

inline model::Character make_rig(std::uint64_t seed, int clips = 1) {
    return RigMaker(seed).make(clips);
}

}  // namespace tests
