// A character of so many triangles and points; nobody looks at where they are.
#pragma once

#include <cstddef>

#include "figures/choices.h"

namespace tests {

struct CountedFigure {
    model::Mesh mesh;
    motion::PoseTable poses;

    CountedFigure(std::size_t triangles, int points) {
        mesh.indices.resize(3 * triangles);
        poses.point_count = points;
        poses.pose_count = 1;
        poses.clips = {{}};
    }
    figures::Figure figure() const { return {&mesh, &poses, nullptr}; }
};

// With all that its people can be drawn as.
struct CountedCharacter : CountedFigure {
    figures::Choices choices;

    CountedCharacter(std::size_t triangles, int points, const figures::Way& way)
        : CountedFigure(triangles, points), choices(figure(), way) {}

    double triangles() const { return static_cast<double>(mesh.triangle_count()); }
};

}  // namespace tests
