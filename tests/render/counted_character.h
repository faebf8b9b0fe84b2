// A character of so many triangles and points; nobody looks at where they are.
#pragma once

#include <cstddef>
#include <utility>

#include "figures/choices.h"

namespace tests {

struct CountedCharacter {
    model::Mesh mesh;
    motion::PoseTable poses;
    figures::Choices choices;

    CountedCharacter(std::size_t triangles, int points, const figures::Way& way)
        : CountedCharacter(mesh_of(triangles), poses_of(points), way) {}

    double triangles() const { return static_cast<double>(mesh.triangle_count()); }

private:
    CountedCharacter(model::Mesh of_mesh, motion::PoseTable of_poses, const figures::Way& way)
        : mesh(std::move(of_mesh)), poses(std::move(of_poses)), choices({&mesh, &poses, nullptr}, way) {}

    static model::Mesh mesh_of(std::size_t triangles) {
        model::Mesh mesh;
        mesh.indices.resize(3 * triangles);
        return mesh;
    }
    static motion::PoseTable poses_of(int points) {
        motion::PoseTable poses;
        poses.point_count = points;
        poses.pose_count = 1;
        poses.clips = {{}};
        return poses;
    }
};

}  // namespace tests
