// Which points of a surface can be seen from outside at all. The one place that knows Embree (3 or 4).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace pointsample {

// A ray-tracing scene over one posed mesh.
class Visibility {
public:
    // Copies what it needs. Throws std::runtime_error when Embree has no device.
    Visibility(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
    ~Visibility();
    Visibility(const Visibility&) = delete;
    Visibility& operator=(const Visibility&) = delete;

    // Whether some ray from `point` over a fixed spread of directions in the hemisphere of `normal` (both hemispheres
    // if `two_sided`) leaves the mesh unhindered; stops at the first that does.
    bool sees_outside(glm::vec3 point, glm::vec3 normal, bool two_sided) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

}  // namespace pointsample
