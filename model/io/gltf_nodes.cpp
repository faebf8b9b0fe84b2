#include <cmath>

#include "model/io/gltf_file.h"

namespace model {
namespace {

float finite(double value, std::size_t node) {
    const float narrow = static_cast<float>(value);
    if (!std::isfinite(narrow)) fail("a transform of node " + std::to_string(node) + " that is not finite", "numbers");
    return narrow;
}

glm::mat4 matrix_of(const Transform& transform) {
    glm::mat4 matrix = glm::mat4_cast(transform.rotation);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= transform.scale[axis];
    matrix[3] = glm::vec4(transform.translation, 1.0f);
    return matrix;
}

glm::quat unit_or_identity(const glm::quat& q) {
    const float length = std::sqrt(glm::dot(q, q));
    return length > 0.0f && std::isfinite(length) ? q / length : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
}

// The nearest translation, rotation and scale: shear is dropped, a mirror goes to x.
Transform decompose(const glm::mat4& matrix) {
    Transform transform;
    transform.translation = glm::vec3(matrix[3]);
    glm::mat3 axes(matrix);
    for (int axis = 0; axis < 3; ++axis) {
        transform.scale[axis] = glm::length(axes[axis]);
        if (transform.scale[axis] > 0.0f) axes[axis] /= transform.scale[axis];
    }
    if (glm::determinant(axes) < 0.0f) {
        transform.scale.x = -transform.scale.x;
        axes[0] = -axes[0];
    }
    transform.rotation = unit_or_identity(glm::quat_cast(axes));
    return transform;
}

Node make_node(const tinygltf::Node& node, std::size_t index) {
    Node out;
    out.name = node.name;
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i)
            out.rest_matrix[i / 4][i % 4] = finite(node.matrix[static_cast<std::size_t>(i)], index);
        out.rest = decompose(out.rest_matrix);
        return out;
    }
    for (int i = 0; i < 3; ++i) {
        const std::size_t at = static_cast<std::size_t>(i);
        if (node.translation.size() == 3) out.rest.translation[i] = finite(node.translation[at], index);
        if (node.scale.size() == 3) out.rest.scale[i] = finite(node.scale[at], index);
    }
    if (node.rotation.size() == 4)
        out.rest.rotation = unit_or_identity({finite(node.rotation[3], index), finite(node.rotation[0], index),
                                              finite(node.rotation[1], index), finite(node.rotation[2], index)});
    out.rest_matrix = matrix_of(out.rest);
    return out;
}

std::vector<std::int32_t> parents_of(const std::vector<tinygltf::Node>& nodes) {
    std::vector<std::int32_t> parents(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            if (child < 0 || static_cast<std::size_t>(child) >= nodes.size())
                fail("child " + std::to_string(child) + " of node " + std::to_string(i),
                     "one of " + std::to_string(nodes.size()) + " nodes");
            if (parents[static_cast<std::size_t>(child)] >= 0)
                fail("two parents of node " + std::to_string(child), "a tree of nodes");
            parents[static_cast<std::size_t>(child)] = static_cast<std::int32_t>(i);
        }
    }
    return parents;
}

// Breadth first from all roots, without recursion. What a cycle holds is never reached.
std::vector<std::int32_t> breadth_first(const std::vector<tinygltf::Node>& nodes,
                                        const std::vector<std::int32_t>& parents) {
    std::vector<std::int32_t> order;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (parents[i] < 0) order.push_back(static_cast<std::int32_t>(i));
    for (std::size_t i = 0; i < order.size(); ++i)
        for (const int child : nodes[static_cast<std::size_t>(order[i])].children) order.push_back(child);
    if (order.size() < nodes.size()) fail("a cycle of nodes", "a tree");
    return order;
}

// Without any scene, everything is shown.
std::vector<bool> scene_roots(const tinygltf::Model& model) {
    if (model.scenes.empty()) return std::vector<bool>(model.nodes.size(), true);
    const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
    if (static_cast<std::size_t>(scene) >= model.scenes.size())
        fail("scene " + std::to_string(scene), "one of " + std::to_string(model.scenes.size()));
    std::vector<bool> in_scene(model.nodes.size(), false);
    for (const int root : model.scenes[static_cast<std::size_t>(scene)].nodes) {
        if (root < 0 || static_cast<std::size_t>(root) >= model.nodes.size())
            fail("node " + std::to_string(root) + " in the scene", "one of " + std::to_string(model.nodes.size()));
        in_scene[static_cast<std::size_t>(root)] = true;
    }
    return in_scene;
}

}  // namespace

NodeOrder build_nodes(const GltfFile& file, Skeleton& skeleton) {
    const std::vector<tinygltf::Node>& nodes = file.model.nodes;
    const std::vector<std::int32_t> parents = parents_of(nodes);
    NodeOrder out{breadth_first(nodes, parents), std::vector<std::int32_t>(nodes.size()), scene_roots(file.model)};
    for (std::size_t i = 0; i < out.order.size(); ++i) {
        const std::size_t index = static_cast<std::size_t>(out.order[i]);
        out.in_skeleton[index] = static_cast<std::int32_t>(i);
        Node node = make_node(nodes[index], index);
        if (parents[index] >= 0) {
            const std::size_t parent = static_cast<std::size_t>(parents[index]);
            node.parent = out.in_skeleton[parent];
            if (out.in_scene[parent]) out.in_scene[index] = true;
        }
        skeleton.nodes.push_back(std::move(node));
    }
    return out;
}

}  // namespace model
