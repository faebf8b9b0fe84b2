// Which points of a surface can be seen from outside at all, in one pose. The one place that knows Embree (3 or 4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "pointsample/posed_mesh.h"

namespace pointsample {

// Whether a triangle is in the way of a ray that comes to it, on its way out, where its second and third corner have
// the shares u and v. `seen_from_behind`: by whom the ray comes out at.
using InTheWay = std::function<bool(std::size_t triangle, float u, float v, bool seen_from_behind)>;

// A ray-tracing scene over one posed mesh. About 100 bytes a triangle.
class Visibility {
public:
    // Copies what it needs. Throws std::runtime_error when Embree has no device.
    // Without `in_the_way` all triangles are, and rays are faster.
    Visibility(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, InTheWay in_the_way = {});
    ~Visibility();
    Visibility(const Visibility&) = delete;
    Visibility& operator=(const Visibility&) = delete;

    // For each place, whether a ray from it leaves the mesh unhindered: on the side of its normal, or on either if it
    // is two-sided: all are or none, or those that `two_sided` says. There are 64 directions, at least 2 degrees above
    // the surface. Neighbours are to follow one another: each is first asked in the direction in which the one before
    // it saw out; after one that saw nothing, in eight directions only, others each time. So a hole of a twentieth of
    // the sky is found for all, a smaller one for some. In parallel; the same on any number of threads.
    std::vector<char> look(std::span<const Place> places, bool two_sided) const;
    std::vector<char> look(std::span<const Place> places, std::span<const char> two_sided) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

}  // namespace pointsample
