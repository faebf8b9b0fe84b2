#include "pointsample/attributes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "model/own_light.h"
#include "model/srgb.h"
#include "model/texture_sample.h"

namespace pointsample {
namespace {

using model::Mesh;
using motion::SurfacePoint;

// Linear light.
glm::vec3 linear(const glm::u8vec4& color) {
    return {model::linear_of_srgb(color.r), model::linear_of_srgb(color.g), model::linear_of_srgb(color.b)};
}

// One triangle's corners and how much of each a point has.
struct Corners {
    std::array<std::uint32_t, 3> vertex;
    std::array<float, 3> share;

    Corners(const Mesh& mesh, const SurfacePoint& point) : share{1.0f - point.u - point.v, point.u, point.v} {
        std::copy_n(mesh.indices.begin() + std::ptrdiff_t{3} * point.triangle, 3, vertex.begin());
    }
    template <typename Get>
    auto blend(Get get) const {
        return get(vertex[0]) * share[0] + get(vertex[1]) * share[1] + get(vertex[2]) * share[2];
    }
    std::uint32_t nearest() const {
        return vertex[static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin())];
    }
};

// Interpolated; where the corners' normals cancel out, the triangle's own.
glm::vec3 normal_of(const Corners& corners, const PosedMesh& pose) {
    glm::dvec3 normal = corners.blend([&](std::uint32_t i) { return pose.normals[i]; });
    double length = glm::length(normal);
    if (!(length > 1e-6) || !std::isfinite(length)) {
        const auto corner = [&](std::size_t i) { return glm::dvec3(pose.positions[corners.vertex[i]]); };
        normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        length = glm::length(normal);
    }
    return glm::vec3(normal / length);
}

glm::u8vec4 color_of(const Mesh& mesh, const Corners& corners) {
    glm::vec3 light = corners.blend([&](std::uint32_t i) { return linear(mesh.colors[i]); });
    const float alpha = corners.blend([&](std::uint32_t i) { return static_cast<float>(mesh.colors[i].a); });
    // Most scans have none: that spares them a look somewhere in memory for each point.
    if (!mesh.textures.empty()) {
        const model::Material& material = mesh.material_of(corners.vertex[2]);
        if (material.texture != model::no_texture)
            light *= glm::vec3(model::texture_at(mesh.textures[material.texture], material.sampler,
                                                 corners.blend([&](std::uint32_t i) { return mesh.uvs[i]; })));
    }
    return {model::srgb_of_linear(light.r), model::srgb_of_linear(light.g), model::srgb_of_linear(light.b),
            static_cast<std::uint8_t>(std::min(alpha + 0.5f, 255.0f))};
}

glm::u8vec4 own_light_of(const Mesh& mesh, const Corners& corners) {
    const model::Material& material = mesh.material_of(corners.vertex[2]);
    if (material.unlit) return {0, 0, 0, 255};
    glm::vec3 light = material.emissive;
    if (material.emissive_texture != model::no_texture)
        light *= glm::vec3(model::texture_at(mesh.textures[material.emissive_texture], material.sampler,
                                             corners.blend([&](std::uint32_t i) { return mesh.uvs[i]; })));
    return {model::srgb_of_linear(light.r), model::srgb_of_linear(light.g), model::srgb_of_linear(light.b), 0};
}

struct Influences {
    glm::u16vec4 joints{0};
    glm::vec4 weights{0.0f};
};

// The corners' influences, the same joint once, and of those the four heaviest.
Influences influences_of(const Mesh& mesh, const Corners& corners) {
    std::array<std::pair<float, std::uint16_t>, 24> found{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        mesh.visit_influences(corners.vertex[i], [&](std::uint16_t joint, float of_corner) {
            const float weight = of_corner * corners.share[i];
            if (!(weight > 0.0f)) return;
            std::size_t at = 0;
            while (at < count && found[at].second != joint) ++at;
            if (at == count) found[count++] = {0.0f, joint};
            found[at].first += weight;
        });
    }
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(found.begin(), end, [](const auto& a, const auto& b) {
        return a.first > b.first || (a.first == b.first && a.second < b.second);
    });
    Influences out;
    float sum = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i) sum += found[i].first;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i) {
        out.joints[static_cast<int>(i)] = found[i].second;
        out.weights[static_cast<int>(i)] = found[i].first / sum;
    }
    if (!(sum > 0.0f)) out.weights.x = 1.0f;
    return out;
}

}  // namespace

void describe(const Mesh& mesh, const PosedMesh& pose, PointModel& model) {
    const std::size_t count = model.surface.size();
    model.positions.resize(count);
    model.normals.resize(count);
    model.colors.resize(count);
    model.slots.resize(count);
    const bool shines = model::has_own_light(mesh);
    model.own_lights.resize(shines ? count : 0);
    model.joints.resize(count);
    model.weights.resize(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Corners corners(mesh, model.surface[i]);
            model.positions[i] = place_of(model.surface[i], mesh.indices, pose).position;
            model.normals[i] = normal_of(corners, pose);
            model.colors[i] = color_of(mesh, corners);
            model.slots[i] = mesh.slots[corners.nearest()];
            if (shines) model.own_lights[i] = own_light_of(mesh, corners);
            const Influences influences = influences_of(mesh, corners);
            model.joints[i] = influences.joints;
            model.weights[i] = influences.weights;
        }
    });
}

}  // namespace pointsample
