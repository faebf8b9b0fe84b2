#include "pointsample/hidden.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "model/cutout.h"

namespace pointsample {
namespace {

// Whether what is of any one-sided material encloses less than nothing: it faces inward.
bool has_hull(const model::Mesh& mesh, const PosedMesh& pose) {
    std::vector<double> volumes(mesh.materials.size());
    const glm::dvec3 origin = pose.positions.empty() ? glm::dvec3(0) : glm::dvec3(pose.positions.front());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(pose.positions[mesh.indices[3 * t + k]]) - origin; };
        volumes[mesh.material_ids[mesh.indices[3 * t + 2]]] += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
    }
    for (std::size_t i = 0; i < volumes.size(); ++i)
        if (volumes[i] < 0 && !mesh.materials[i].double_sided) return true;
    return false;
}

bool is_of_one_kind(const model::Mesh& mesh) {
    return std::ranges::all_of(mesh.materials, [&](const model::Material& material) {
        return material.double_sided == mesh.materials.front().double_sided;
    });
}

}  // namespace

HiddenTest::HiddenTest(const Surface& surface, bool two_sided)
    : surface_(surface), two_sided_(two_sided), scenes_(surface.poses().size()) {}

HiddenTest::HiddenTest(const Surface& surface, const model::Mesh& mesh) : HiddenTest(surface, mesh.double_sided()) {
    if (!is_of_one_kind(mesh)) mesh_ = &mesh;
    if (!model::has_cutouts(mesh) && !has_hull(mesh, surface.poses().front())) return;
    in_the_way_ = [&mesh](std::size_t triangle, float u, float v, bool seen_from_behind) {
        if (seen_from_behind && !model::material_of_triangle(mesh, triangle).double_sided) return false;
        return model::has_surface(mesh, triangle, u, v);
    };
}

std::vector<char> HiddenTest::look(std::size_t pose, std::span<const motion::SurfacePoint> points,
                                   std::span<const std::size_t> chosen) {
    const PosedMesh& posed = surface_.poses()[pose];
    if (!scenes_[pose]) scenes_[pose] = std::make_unique<Visibility>(posed.positions, surface_.indices(), in_the_way_);
    std::vector<Place> places;
    for (const std::size_t i : chosen) places.push_back(place_of(points[i], surface_.indices(), posed));
    if (mesh_ == nullptr) return scenes_[pose]->look(places, two_sided_);
    std::vector<char> two_sided;
    for (const std::size_t i : chosen)
        two_sided.push_back(model::material_of_triangle(*mesh_, points[i].triangle).double_sided);
    return scenes_[pose]->look(places, two_sided);
}

std::vector<char> HiddenTest::visible(std::span<const motion::SurfacePoint> points) {
    std::vector<char> visible(points.size(), 0);
    std::vector<std::size_t> unseen(points.size());
    std::iota(unseen.begin(), unseen.end(), std::size_t{0});
    for (std::size_t pose = 0; pose < scenes_.size() && !unseen.empty(); ++pose) {
        const std::vector<char> seen = look(pose, points, unseen);
        std::size_t left = 0;
        for (std::size_t k = 0; k < unseen.size(); ++k) {
            visible[unseen[k]] = seen[k];
            if (!seen[k]) unseen[left++] = unseen[k];
        }
        unseen.resize(left);
    }
    return visible;
}

}  // namespace pointsample
