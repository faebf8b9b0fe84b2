#include <cmath>
#include <vector>

#include "model/io/gltf_file.h"
#include "model/io/origin.h"

namespace model {
namespace {

// Of a node to its parent, as the file has it: floats can't tell centimetres apart at five million metres.
glm::dmat4 exact_matrix(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    if (node.rotation.size() == 4) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (glm::length(q) > 0) matrix = glm::mat4_cast(glm::normalize(q));
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (node.scale.size() == 3) matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
        if (node.translation.size() == 3) matrix[3][axis] = node.translation[static_cast<std::size_t>(axis)];
    }
    return matrix;
}

// The rest pose in double precision, by the skeleton's nodes.
struct ExactPose {
    std::vector<glm::dmat4> local, world;

    ExactPose(const GltfFile& file, const NodeOrder& nodes, const Skeleton& skeleton) {
        for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
            local.push_back(exact_matrix(file.model.nodes[static_cast<std::size_t>(nodes.order[i])]));
            const std::int32_t parent = skeleton.nodes[i].parent;
            world.push_back(parent < 0 ? local[i] : world[static_cast<std::size_t>(parent)] * local[i]);
        }
    }
};

constexpr double largest = 1e30;  // far below what a float holds

struct Box {
    glm::dvec3 least{INFINITY}, most{-INFINITY};
};

// Of the rest pose, each vertex at its heaviest joint.
Box box_of(const Character& character, const ExactPose& pose) {
    std::vector<glm::dmat4> palette;
    for (const PaletteEntry& entry : character.skeleton.palette)
        palette.push_back(pose.world[static_cast<std::size_t>(entry.node)] * glm::dmat4(entry.inverse_bind));
    Box box;
    const Mesh& mesh = character.mesh;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const glm::dvec3 place(palette[mesh.joints[v].x] * glm::dvec4(mesh.positions[v], 1.0));
        box.least = glm::min(box.least, place);
        box.most = glm::max(box.most, place);
    }
    return box;
}

// Moves all of a character by -origin, with no large numbers left on the way: each node's own zero goes to `zero`, in
// its old coordinates, which is near the shape.
class Mover {
public:
    Mover(const ExactPose& pose, const glm::dvec3& origin, double size, Character& character)
        : pose_(pose), origin_(origin), size_(size), character_(character) {
        choose_zeros();
    }

    void move() {
        for (std::size_t i = 0; i < zeros_.size(); ++i) {
            Node& node = character_.skeleton.nodes[i];
            node.rest.translation = glm::vec3(glm::dvec3(pose_.local[i][3]) + way_of(i));
            node.rest_matrix[3] = glm::vec4(node.rest.translation, node.rest_matrix[3].w);
        }
        for (Clip& clip : character_.clips)
            for (Channel& channel : clip.channels)
                if (channel.path == Path::translation) move_keys(channel);
        move_bind_space();
        character_.mesh.origin = origin_;
    }

private:
    // A node that clips turn or scale keeps its zero: what it turns about.
    void choose_zeros() {
        zeros_.resize(pose_.world.size(), glm::dvec3(0.0));
        std::vector<bool> turns(zeros_.size(), false);
        for (const Clip& clip : character_.clips)
            for (const Channel& channel : clip.channels)
                if (channel.path == Path::rotation || channel.path == Path::scale)
                    turns[static_cast<std::size_t>(channel.node)] = true;
        for (std::size_t i = 0; i < zeros_.size(); ++i) {
            if (turns[i] || glm::distance(glm::dvec3(pose_.world[i][3]), origin_) <= 2 * size_) continue;
            const glm::dvec3 zero(glm::inverse(pose_.world[i]) * glm::dvec4(origin_, 1.0));
            if (glm::length(zero) < largest) zeros_[i] = zero;
        }
    }

    // What a node's translation changes by.
    glm::dvec3 way_of(std::size_t node) const {
        const std::int32_t parent = character_.skeleton.nodes[node].parent;
        const glm::dvec3 of_parent = parent < 0 ? origin_ : zeros_[static_cast<std::size_t>(parent)];
        return glm::dmat3(pose_.local[node]) * zeros_[node] - of_parent;
    }

    void move_keys(Channel& channel) const {
        const glm::dvec3 way = way_of(static_cast<std::size_t>(channel.node));
        const bool cubic = channel.interpolation == Interpolation::cubic_spline;  // tangents stay
        const std::size_t stride = cubic ? 9 : 3;
        for (std::size_t key = cubic ? 3 : 0; key + 3 <= channel.values.size(); key += stride)
            for (int axis = 0; axis < 3; ++axis) {
                float& value = channel.values[key + static_cast<std::size_t>(axis)];
                value = static_cast<float>(static_cast<double>(value) + way[axis]);
            }
    }

    // Rigid parts move by their vertices, which may be far in their node; skins by their inverse binds.
    void move_bind_space() {
        const std::vector<bool> rigid = rigid_entries();
        std::vector<PaletteEntry>& palette = character_.skeleton.palette;
        Mesh& mesh = character_.mesh;
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            const std::size_t entry = mesh.joints[v].x;
            if (!rigid[entry]) continue;
            const glm::dvec3 zero = zeros_[static_cast<std::size_t>(palette[entry].node)];
            mesh.positions[v] = glm::vec3(glm::dvec3(mesh.positions[v]) - zero);
        }
        for (std::size_t i = 0; i < palette.size(); ++i) {
            if (rigid[i]) continue;
            const glm::dvec3 zero = zeros_[static_cast<std::size_t>(palette[i].node)];
            glm::vec4& column = palette[i].inverse_bind[3];
            column = glm::vec4(glm::dvec3(column) - zero, column.w);
        }
    }

    // Entries in their node's own space whose vertices hang on nothing else.
    std::vector<bool> rigid_entries() const {
        std::vector<bool> rigid;
        for (const PaletteEntry& entry : character_.skeleton.palette)
            rigid.push_back(entry.inverse_bind == glm::mat4(1.0f));
        const Mesh& mesh = character_.mesh;
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            if (mesh.weights[v].y == 0.0f) continue;
            mesh.visit_influences(v, [&](std::uint16_t joint, float weight) {
                if (weight > 0.0f) rigid[joint] = false;
            });
        }
        return rigid;
    }

    const ExactPose& pose_;
    glm::dvec3 origin_;
    double size_;  // of the shape
    Character& character_;
    std::vector<glm::dvec3> zeros_;
};

}  // namespace

void move_near(const GltfFile& file, const NodeOrder& nodes, Character& character) {
    const ExactPose pose(file, nodes, character.skeleton);
    const Box box = box_of(character, pose);
    const glm::dvec3 origin = origin_for(box.least, box.most);
    if (origin == glm::dvec3(0.0) || !(glm::length(origin) < largest)) return;
    Mover(pose, origin, glm::distance(box.least, box.most), character).move();
}

}  // namespace model
