// What a person covers of a picture and the light that they send, by brute force in double precision: every triangle
// of their mesh, in its pose, on many samples a pixel.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "figures/figure.h"
#include "render/view.h"
#include "scene/light.h"
#include "scene/palette.h"

namespace tests {

struct Seen {
    double covered = 0;     // [px^2]
    glm::dvec3 light{0.0};  // linear, times [px^2]
};

// Feet at `at` [m], so many metres a model unit. `samples` a pixel, across and down.
inline Seen look_at(const figures::Figure& figure, int pose, glm::dvec3 at, double yaw, double scale,
                    const scene::Palette& palette, const scene::Light& light, const render::View& view, int samples) {
    const motion::PoseTable& poses = *figure.poses;
    const model::Mesh& mesh = *figure.mesh;
    struct Corner {
        glm::dvec2 spot;  // [samples]
        double nearness;  // 1 / view depth
        glm::dvec3 normal, color;
    };
    std::vector<Corner> corners(mesh.vertex_count());
    glm::dvec2 low(INFINITY), high(-INFINITY);
    const double s = std::sin(yaw), c = std::cos(yaw);
    const auto turned = [&](glm::dvec3 v) { return glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const motion::PosedVertex& vertex =
            poses.vertices[static_cast<std::size_t>(pose) * static_cast<std::size_t>(poses.vertex_count) + i];
        const glm::dvec3 p =
            at + scale * turned(glm::dvec3(motion::unpack_position(vertex, poses.box))) - view.position;
        const double depth = glm::dot(p, glm::dvec3(view.forward));
        const glm::dvec2 half = 0.5 * samples * glm::dvec2(view.width, view.height);
        Corner& corner = corners[i];
        corner.spot = half * glm::dvec2(1 + glm::dot(p, glm::dvec3(view.right)) / (depth * view.tan_half_x),
                                        1 - glm::dot(p, glm::dvec3(view.up)) / (depth * view.tan_half_y));
        corner.nearness = 1 / depth;
        corner.normal = turned(glm::dvec3(motion::unpack_normal(vertex)));
        corner.color = glm::dvec3(mesh.colors[i]) / 255.0;
        if (mesh.slots[i] != model::no_slot) corner.color *= glm::dvec3(palette[mesh.slots[i]]) / 255.0;
        corner.color *= corner.color;
        low = glm::min(low, corner.spot);
        high = glm::max(high, corner.spot);
    }
    const glm::ivec2 first(glm::floor(low)), end = glm::ivec2(glm::ceil(high)) + 1, size = end - first;
    struct Sample {
        double nearness = 0;
        glm::dvec3 light{0.0};
    };
    std::vector<Sample> all(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Corner* p[3];
        for (std::size_t k = 0; k < 3; ++k) p[k] = &corners[mesh.indices[i + k]];
        const auto across = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 d) {
            return (b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x);
        };
        const double area = across(p[0]->spot, p[1]->spot, p[2]->spot);
        if (area == 0) continue;
        const glm::ivec2 from(glm::floor(glm::min(p[0]->spot, glm::min(p[1]->spot, p[2]->spot))));
        const glm::ivec2 to(glm::ceil(glm::max(p[0]->spot, glm::max(p[1]->spot, p[2]->spot))));
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x) {
                const glm::dvec2 middle(x + 0.5, y + 0.5);
                const double u = across(p[1]->spot, p[2]->spot, middle) / area,
                             v = across(p[2]->spot, p[0]->spot, middle) / area, w = 1 - u - v;
                if (u < 0 || v < 0 || w < 0) continue;
                Sample& sample = all[static_cast<std::size_t>(y - first.y) * static_cast<std::size_t>(size.x) +
                                     static_cast<std::size_t>(x - first.x)];
                const double nearness = u * p[0]->nearness + v * p[1]->nearness + w * p[2]->nearness;
                if (nearness <= sample.nearness) continue;
                const glm::dvec3 n = glm::normalize(u * p[0]->normal + v * p[1]->normal + w * p[2]->normal);
                const glm::dvec3 color = u * p[0]->color + v * p[1]->color + w * p[2]->color;
                const glm::dvec3 around =
                    glm::mix(glm::dvec3(light.from_below), glm::dvec3(light.from_above), 0.5 + 0.5 * n.y);
                const double facing = std::max(0.0, glm::dot(n, glm::dvec3(light.to_sun)));
                sample = {nearness, color * (around + facing * glm::dvec3(light.sun))};
            }
    }
    Seen seen;
    for (const Sample& sample : all) {
        if (sample.nearness == 0) continue;
        seen.covered += 1;
        seen.light += sample.light;
    }
    seen.covered /= samples * samples;
    seen.light /= samples * samples;
    return seen;
}

}  // namespace tests
