// Area-stratified candidates: surface points, one to each cell of equal area, in an order in which runs of neighbours
// are compact patches of the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pointsample/float4.h"
#include "pointsample/surface.h"

namespace pointsample {

inline constexpr std::size_t leaf_size = 16;  // candidates come in leaves, the grain of the tree built over them

// Sixteen candidates' positions (Surface::scaled), and room for the tree's squared distances: four cache lines.
struct alignas(64) Leaf {
    Row<leaf_size / 4> x, y, z, distance;
};
struct alignas(64) LeafNormals {
    Row<leaf_size / 4> x, y, z;  // of the faces
    Row<leaf_size / 4> stretch;
};

// `count` candidates; leaves are whole once pad() was called. 44 bytes each.
struct Candidates {
    std::size_t count = 0;
    std::vector<Leaf> leaves;
    std::vector<LeafNormals> normals;
    std::vector<motion::SurfacePoint> surface;

    void reserve(std::size_t candidates);
    void append(const Place& place, float stretch, const motion::SurfacePoint& point);
    void pad();  // the last leaf, with copies of the last candidate

    // Drops those from `first` on whose element of `kept` is 0.
    void keep(std::size_t first, std::span<const char> kept);

    Place place(std::size_t i) const {
        const Leaf& leaf = leaves[i / leaf_size];
        const LeafNormals& normal = normals[i / leaf_size];
        const std::size_t k = i % leaf_size;
        return {{leaf.x[k], leaf.y[k], leaf.z[k]}, {normal.x[k], normal.y[k], normal.z[k]}};
    }
    float stretch(std::size_t i) const { return normals[i / leaf_size].stretch[i % leaf_size]; }

private:
    void put(std::size_t i, const Place& place, float stretch, const motion::SurfacePoint& point);
};

// Makes candidates a batch at a time, so that hidden ones can be dropped before all of them take memory. Candidate i of
// `count` depends on the seed and i alone. Linear time in triangles and candidates.
class Stratifier {
public:
    // `line` as of order_along_line. Keeps references.
    Stratifier(const Surface& surface, std::span<const std::uint32_t> line, std::size_t count, std::uint64_t seed);

    std::size_t left() const { return count_ - next_; }

    // Appends the next `count`, or all that are left.
    void append(std::size_t count, Candidates& out);

private:
    void go_to(double at);  // the triangle there
    void enter_triangle();

    const Surface& surface_;
    std::span<const std::uint32_t> line_;
    std::size_t count_, next_ = 0;
    std::uint64_t seed_;
    double step_;  // area of a cell [units^2]

    // The triangle that the line is in.
    std::size_t slot_ = 0;
    double start_ = 0, end_ = 0;  // on the line
    glm::vec3 corners_[3];        // scaled
    glm::vec3 normal_;
    int halvings_ = 0;
};

}  // namespace pointsample
