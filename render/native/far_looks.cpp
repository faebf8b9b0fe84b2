#include "render/native/far_looks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "figures/splats.h"

namespace render::native {

namespace {

std::int16_t fixed(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value / far_color_share, 0.0f, 1.0f) * 32767.0f));
}

// Between nodes a silhouette bulges out, by a third of that on average either way; so much is added at the nodes.
float mean_silhouette(const SplatModel::Look& look) {
    constexpr float mean = 1.0f / 6.0f;  // of t (1 - t)
    return look.silhouette - mean * (look.bend_around + look.bend_up);
}

// Unit, along the picture's vertical for whoever looks from there; none from straight above or below.
glm::vec3 upward(glm::vec3 direction) {
    const glm::vec3 up = glm::vec3(0, 1, 0) - direction.y * direction;
    const float length = glm::length(up);
    return length > 1e-3f ? up / length : glm::vec3(0.0f);
}

struct SeenPoint {
    float height, weight;
    const SplatModel::LitPoint* lit;
    int side;
};

void sum_up(std::vector<SeenPoint>& points, Leaning& leaning) {
    std::ranges::sort(points, {}, [](const SeenPoint& point) { return -point.height; });
    float all = 0;
    for (const SeenPoint& point : points) all += point.weight;
    if (!(all > 0.0f)) return;
    float above = 0;
    for (const SeenPoint& point : points) {
        const float share = point.weight / all, t = above + 0.5f * share;
        above += share;
        const auto& light = point.lit->light[point.side];
        glm::vec3 sum(0.0f);
        for (int sun = 0; sun < sun_azimuths; ++sun)
            sum += glm::vec3(light[3 * sun], light[3 * sun + 1], light[3 * sun + 2]);
        sum *= share / sun_azimuths;
        leaning.mean[point.lit->slot] += sum;
        leaning.lean[point.lit->slot] += (0.5f - t) * sum;
        leaning.mean[model::no_slot] += share * point.lit->emitted;
        leaning.lean[model::no_slot] += (0.5f - t) * share * point.lit->emitted;
    }
}

}  // namespace

FarShape far_shape(const motion::PoseTable& poses) {
    const std::vector<int> keys = figures::splat_keys(poses).poses;
    glm::dvec3 sum(0.0);
    double squares = 0;
    for (const int pose : keys)
        for (int i = 0; i < poses.point_count; ++i) {
            const std::size_t point = static_cast<std::size_t>(pose) * static_cast<std::size_t>(poses.point_count) + i;
            const glm::dvec3 at(motion::unpack_position(poses.points[point], poses.box));
            sum += at;
            squares += at.y * at.y;
        }
    const double count = static_cast<double>(keys.size()) * poses.point_count;
    const glm::dvec3 center = sum / count;
    return {glm::vec3(center),
            static_cast<float>(std::sqrt(12.0 * std::max(0.0, squares / count - center.y * center.y)))};
}

FarLooks::FarLooks(const figures::Figure& figure, const SplatModel& model) {
    const std::vector<int> keys = figures::splat_keys(*figure.poses).poses;
    rows.resize(keys.size() * far_key_rows * far_row_values);
    for (const int pose : keys) {
        for (int node = 0; node < direction_nodes; ++node)
            largest_silhouette =
                std::max(largest_silhouette, mean_silhouette(model.look(static_cast<std::uint32_t>(pose), node)));
    }
    largest_silhouette /= far_color_share;
    find_leanings(figure, model, keys);
    tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t key) {
        const auto pose = static_cast<std::uint32_t>(keys[key]);
        std::int16_t* row = &rows[key * far_key_rows * far_row_values];
        for (int sun = 0; sun < sun_azimuths; ++sun) {
            for (int i = 0; i < far_sun_rows; ++i, row += far_row_values) {
                const int node = i / far_ring_rows * ring_nodes + i % far_ring_rows % ring_nodes;
                const SplatModel::SlotLights lights = model.lights(pose, sun, node);
                for (int channel = 0; channel < 3; ++channel) {
                    for (int slot = 1; slot <= model::slot_count; ++slot)
                        row[4 * (slot - 1) + channel] = fixed(lights[slot][channel]);
                    row[4 * channel + 3] = fixed(lights[model::no_slot][channel]);
                }
                row[far_row_values - 1] = fixed(mean_silhouette(model.look(pose, node)) / largest_silhouette);
            }
        }
    });
}

// Some keys and directions tell enough: it is a mean.
void FarLooks::find_leanings(const figures::Figure& figure, const SplatModel& model, const std::vector<int>& keys) {
    constexpr std::size_t key_step = 4;
    constexpr int node_step = 4;
    std::vector<SeenPoint> seen;
    for (std::size_t key = 0; key < keys.size(); key += key_step) {
        const auto pose = static_cast<std::uint32_t>(keys[key]);
        const std::vector<SplatModel::LitPoint> lit = model.light_points(pose);
        for (int node = 0; node < direction_nodes; node += node_step) {
            const glm::vec3 direction = direction_of(node), up = upward(direction);
            const std::uint32_t* visible = model.visible(pose, node);
            seen.clear();
            for (std::size_t i = 0; i < lit.size(); ++i) {
                const float facing = glm::dot(lit[i].facet, direction);
                const float weight = model.double_sided() ? std::abs(facing) : std::max(facing, 0.0f);
                if (!(visible[i / 32] >> i % 32 & 1) || weight == 0.0f) continue;
                const motion::PosedVertex& point =
                    figure.poses->points[std::size_t{pose} * static_cast<std::size_t>(figure.poses->point_count) + i];
                seen.push_back({glm::dot(up, motion::unpack_position(point, figure.poses->box)), weight, &lit[i],
                                facing < 0.0f ? 1 : 0});
            }
            sum_up(seen, leanings[static_cast<std::size_t>(node / ring_nodes)]);
        }
    }
}

}  // namespace render::native
