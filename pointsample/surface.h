// What is sampled: the first pose's triangles, each with the area that counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pointsample/posed_mesh.h"

namespace pointsample {

// A surface that moves must have enough points where it is stretched most: a triangle's area is counted as the largest
// that it has in any pose.
class Surface {
public:
    // Keeps references. At least one pose; they differ in positions alone. Throws std::runtime_error if no triangle has
    // a finite area in the first, or all together have one that no float holds.
    Surface(std::span<const std::uint32_t> indices, std::span<const PosedMesh> poses);

    std::size_t triangle_count() const { return indices_.size() / 3; }
    std::span<const std::uint32_t> indices() const { return indices_; }
    std::span<const PosedMesh> poses() const { return poses_; }

    // How many times its first area a triangle counts for: in [1, 1024].
    float stretch(std::size_t triangle) const { return stretch_.empty() ? 1.0f : stretch_[triangle]; }
    double first_area(std::size_t triangle) const;  // [units^2]; 0 if it is not finite
    double area(std::size_t triangle) const { return first_area(triangle) * static_cast<double>(stretch(triangle)); }

    double total_first_area() const { return total_first_area_; }
    double total_area() const { return total_area_; }

    // Candidates are computed in coordinates of size 1 around the surface's centroid, since squared distances of tiny
    // and huge ones leave float's range, and differences of distant ones its precision.
    glm::vec3 scaled(const glm::vec3& position) const { return glm::vec3((glm::dvec3(position) - center_) / unit_); }
    double unit() const { return unit_; }  // [units] the longest side of the surface's box

private:
    void find_frame();
    void find_stretch();

    std::span<const std::uint32_t> indices_;
    std::span<const PosedMesh> poses_;
    std::vector<float> stretch_;  // empty: all 1
    double total_first_area_ = 0, total_area_ = 0;
    glm::dvec3 center_{0.0};
    double unit_ = 1;
};

}  // namespace pointsample
