// How even a sample is, by brute force over a grid in double precision; knows nothing of how samples are made.
// Unit of length: d_max = 2 sqrt(A / (2 sqrt(3) n)), the nearest-neighbour distance of the densest packing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "model/mesh.h"
#include "pointsample/point_model.h"

namespace tests {

struct Sample {
    std::vector<glm::dvec3> positions, normals;  // normals: unit, of the triangles
    std::size_t size() const { return positions.size(); }
};

// A model's points with the normals of their triangles in the mesh.
Sample sample_of(const pointsample::PointModel& model, const model::Mesh& mesh);

double densest(double area, std::size_t n);  // d_max

// What the distance of two points is whose normals oppose (cosine < -0.7).
enum class Opposed { same, doubled };

struct Spread {
    double min = 0, mean = 0;  // nearest-neighbour distance [d_max]
};
Spread spread(const Sample& sample, std::size_t prefix, double area, Opposed rule);

struct Cover {
    double max = 0, p99 = 0, rms = 0;  // distance from the surface to the nearest point [d_max]
};
Cover cover(const Sample& surface, const Sample& sample, std::size_t prefix, double area, Opposed rule);

// `count` area-uniform surface points: in each triangle its area's share within one, placed by an R2 sequence (Roberts
// 2018). Triangles without a finite area have none.
Sample dense(const model::Mesh& mesh, std::size_t count);

double area_of(const model::Mesh& mesh);  // of triangles that have a finite one

// Compact patches of nearly equal area: a dense sample halved across the longest side of its box, `levels` times, at
// the widest gap within 1/64 of the median, so that no cut lies in a flat face; each point belongs to the patch on
// whose side of every cut it lies. With `by_normal`, the two sides of a sheet are parted before.
class Patches {
public:
    Patches(const Sample& surface, int levels, bool by_normal);
    // Chi squared over degrees of freedom of the prefix's counts: 1 for random points, 0 for equal counts.
    double chi2(const Sample& sample, std::size_t prefix) const;
    std::size_t count() const { return expected_.size(); }

private:
    struct Cut {
        int axis;  // 0..2 position, 3..5 normal
        double at;
    };
    static double coordinate(const Sample& sample, std::size_t i, int axis);
    static Cut cut_of(const Sample& surface, std::span<std::uint32_t> cell, bool by_normal);
    std::size_t patch_of(const glm::dvec3& position, const glm::dvec3& normal) const;

    std::vector<Cut> cuts_;         // a heap: children of i are 2 i + 1, 2 i + 2
    std::vector<double> expected_;  // share of the dense sample in each patch
};

}  // namespace tests
