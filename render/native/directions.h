// Directions from which a body is seen, as a grid of nodes around it: fine enough that what changes with the direction
// can be interpolated between four of them.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>

namespace render::native {

// Rings from straight below to straight above, `ring_nodes` around each; those of the two poles coincide.
inline constexpr int rings = 9, ring_nodes = 16;
inline constexpr int direction_nodes = rings * ring_nodes;

// Angles by the diamond instead of the circle: they rise along it as angles do, and one division gives them. Of (x, z):
// in [0, 4], 0 and 4 along z and 1 along x; 0 where there is no direction.
float diamond_of(float x, float z);
// (x, z) of any length but 0.
glm::vec2 on_diamond(float angle);

// Unit, from the body towards the node.
glm::vec3 direction_of(int node);

constexpr int opposite_of(int node) {
    return (rings - 1 - node / ring_nodes) * ring_nodes + (node % ring_nodes + ring_nodes / 2) % ring_nodes;
}
// Whether several nodes coincide there.
constexpr bool is_pole(int node) {
    return node / ring_nodes % (rings - 1) == 0;
}

// What is the same for all nodes of a pole is kept once, under this number.
inline constexpr int distinct_directions = direction_nodes - 2 * (ring_nodes - 1);
constexpr int distinct_of(int node) {
    constexpr int others_of_pole = ring_nodes - 1;
    return std::clamp(node - others_of_pole, 0, distinct_directions - 1);
}

// The four nodes around a direction, and their shares, which sum to 1.
struct Between {
    std::array<int, 4> node;
    std::array<float, 4> share;
    float around, up;  // [0, 1] from the first node to the second, and to the third
};

// `direction`: from the body towards the eye, of any length but 0.
Between between_nodes(glm::vec3 direction);

}  // namespace render::native
