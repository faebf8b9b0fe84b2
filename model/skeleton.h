// A hierarchy of nodes and the matrices a skinned mesh takes from it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace model {

struct Transform {
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  // unit
    glm::vec3 scale{1.0f};
};

// One matrix that vertices index: world(node) * inverse_bind takes bind space to model space.
// A rigid part is a palette entry too, with the identity as its inverse bind.
struct PaletteEntry {
    std::int32_t node = 0;
    glm::mat4 inverse_bind{1.0f};
};

struct Node {
    std::string name;
    std::int32_t parent = -1;     // always smaller than the node's own index; -1 = root
    Transform rest;               // what a clip that drives only part of it leaves alone
    glm::mat4 rest_matrix{1.0f};  // equals rest, except for file matrices with shear (which clips can't drive)
};

struct Skeleton {
    std::vector<Node> nodes;
    std::vector<PaletteEntry> palette;
};

// `world`: one matrix a node, on entry relative to its parent, then to model space. `palette` gets one an entry.
void resolve_hierarchy(const Skeleton& skeleton, std::vector<glm::mat4>& world, std::vector<glm::mat4>& palette);

}  // namespace model
