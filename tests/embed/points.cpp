// A program outside of Grandstand: points of an octahedron.
#include <cstdio>
#include <span>

#include "model/mesh.h"
#include "pointsample/point_model.h"
#include "pointsample/sample.h"

int main() {
    model::Mesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.normals = mesh.positions;
    mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    const std::size_t vertices = mesh.positions.size();
    mesh.uvs.resize(vertices);
    mesh.colors.resize(vertices, glm::u8vec4(255));
    mesh.slots.resize(vertices, model::no_slot);
    mesh.materials.resize(1);
    mesh.material_ids.resize(vertices);
    mesh.joints.resize(vertices);
    mesh.weights.resize(vertices, {1, 0, 0, 0});
    const pointsample::PosedMesh pose{mesh.positions, mesh.normals};
    pointsample::SampleOptions options;
    options.count = 64;
    const std::size_t found = pointsample::sample(mesh, std::span(&pose, 1), options).size();
    if (found != options.count) std::fprintf(stderr, "found %zu points, expected %zu\n", found, options.count);
    return found == options.count ? 0 : 1;
}
