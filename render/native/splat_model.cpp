#include "render/native/splat_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pointsample/prefix_ladder.h"
#include "pointsample/prefix_look.h"
#include "render/native/facets.h"
#include "render/native/linear_codes.h"
#include "render/native/self_occlusion.h"

namespace render::native {

namespace {

std::int16_t q15(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 32767.0f));
}

// Two bytes that find a slot's 16-bit entry in a table of bytes.
std::uint16_t table_index(model::Slot slot) {
    return static_cast<std::uint16_t>((2 * slot + 1) << 8 | 2 * slot);
}

// The values of a point lie a chunk's points apart.
void pack_own_light(const glm::u8vec4& light, std::int16_t* to) {
    for (int channel = 0; channel < 3; ++channel) to[channel * chunk_points] = linear_of_code[light[channel]];
    to[3 * chunk_points] = q15(static_cast<float>(light.a) / 255.0f);
}

constexpr std::uint32_t first_rung = 1;  // two points
constexpr float facet_unit = 64.0f;
constexpr float share_unit = 16384.0f;

constexpr float light_unit = 16384.0f;
constexpr int lit_points = 512;  // as many tell what light a body sends

// As std::lround, but in line.
int nearest(float value) {
    const int whole = static_cast<int>(value);
    const float rest = value - static_cast<float>(whole);
    return whole + (rest >= 0.5f ? 1 : 0) - (rest <= -0.5f ? 1 : 0);
}

// Poses hold normals of two bytes: there are only so many.
using PackedNormal = std::array<std::int8_t, 3>;

std::size_t code_of(const motion::PosedVertex& vertex) {
    return static_cast<std::size_t>(static_cast<std::uint8_t>(vertex.normal_u)) << 8 |
           static_cast<std::uint8_t>(vertex.normal_v);
}

std::vector<PackedNormal> packed_normals() {
    std::vector<PackedNormal> normals(std::size_t{1} << 16);
    for (int u = -128; u < 128; ++u) {
        for (int v = -128; v < 128; ++v) {
            const motion::PosedVertex vertex{0, 0, 0, static_cast<std::int8_t>(u), static_cast<std::int8_t>(v)};
            const glm::vec3 normal = 127.0f * motion::unpack_normal(vertex);
            for (int axis = 0; axis < 3; ++axis)
                normals[code_of(vertex)][axis] = static_cast<std::int8_t>(nearest(normal[axis]));
        }
    }
    return normals;
}

glm::vec3 sun_at(int azimuth, glm::vec3 to_sun) {
    const float out = std::sqrt(std::max(0.0f, 1.0f - to_sun.y * to_sun.y));
    const glm::vec2 around = out * glm::normalize(on_diamond(4.0f * static_cast<float>(azimuth) / sun_azimuths));
    return {around.x, to_sun.y, around.y};
}

// All nodes of a pole are one; this one is looked from.
int seen_of_pole(int node) {
    constexpr int above = (rings - 1) * ring_nodes;
    return node < above ? opposite_of(above) : above;
}

// So many points that showed alike much would be as uneven: those that are seen edge-on show little and even out
// little.
float share_alike(const SelfOcclusion::Seen& seen) {
    return seen.squares > 0.0f ? seen.facing * seen.facing / seen.squares : 0.0f;
}

// So many triangles and points are looked at, over all directions and key poses.
constexpr double look_budget = 1.5e8;

}  // namespace

SplatModel::SplatModel(const figures::Figure& figure, const scene::Light& light)
    : points_(figure.poses->point_count),
      chunks_((points_ + chunk_points - 1) / chunk_points),
      double_sided_(figure.mesh->double_sided()),
      area_(figure.poses->area),
      light_(light) {
    if (points_ == 0) return;
    pack_poses(figure);
    pack_looks(figure);
    pack_shares(figure);
    choose_keys(figure);
    look_around(figure);
}

void SplatModel::pack_poses(const figures::Figure& figure) {
    const motion::PoseTable& poses = *figure.poses;
    first_chunks_.resize(static_cast<std::size_t>(poses.pose_count));
    other_chunks_.resize(static_cast<std::size_t>(poses.pose_count) * (chunks_ - 1));
    extents_.resize(static_cast<std::size_t>(poses.pose_count));
    const Facets facets(figure);
    const std::vector<PackedNormal> normal_of = packed_normals();
    tbb::parallel_for(0, poses.pose_count, [&](int pose) {
        const std::vector<glm::vec3> pieces = facets.in_pose(pose);
        Extent extent;
        extent.min.fill(32767);
        extent.max.fill(-32768);
        for (int i = 0; i < chunks_ * chunk_points; ++i) {
            const int point = std::min(i, points_ - 1);  // the last chunk is filled up
            const motion::PosedVertex& posed = poses.points[static_cast<std::size_t>(pose) * poses.point_count + point];
            const PackedNormal normal = normal_of[code_of(posed)];
            const std::array<std::uint16_t, 3> packed{posed.x, posed.y, posed.z};
            PosedChunk& chunk = chunk_of(static_cast<std::uint32_t>(pose), i / chunk_points);
            const int lane = i % chunk_points;
            for (int axis = 0; axis < 3; ++axis) {
                const auto position = static_cast<std::int16_t>(packed[axis] - 32768);
                chunk.position[axis][lane] = position;
                chunk.normal[axis][lane] = normal[axis];
                chunk.facet[axis][lane] =
                    static_cast<std::int8_t>(nearest(std::clamp(facet_unit * pieces[point][axis], -127.0f, 127.0f)));
                extent.min[axis] = std::min(extent.min[axis], position);
                extent.max[axis] = std::max(extent.max[axis], position);
            }
        }
        extents_[static_cast<std::size_t>(pose)] = extent;
    });
}

void SplatModel::pack_looks(const figures::Figure& figure) {
    const pointsample::PointModel& model = *figure.points;
    colors_.resize(std::size_t{3} * chunk_points * chunks_);
    slots_.resize(std::size_t{chunk_points} * chunks_);
    for (int i = 0; i < chunks_ * chunk_points; ++i) {
        const int point = std::min(i, points_ - 1);
        for (int channel = 0; channel < 3; ++channel)
            colors_[((i / chunk_points) * 3 + channel) * chunk_points + i % chunk_points] =
                linear_of_code[model.colors[point][channel]];
        slots_[i] = table_index(model.slots[point]);
    }
    if (!model.own_lights.empty()) {
        constexpr std::size_t chunk_values = std::size_t{own_light_values} * chunk_points;
        own_lights_.resize(chunk_values * chunks_);
        mean_own_lights_.resize(chunk_values * (longest_mean_prefix + 1));
        for (int i = 0; i < chunks_ * chunk_points; ++i)
            pack_own_light(model.own_lights[std::min(i, points_ - 1)],
                           &own_lights_[chunk_values * (i / chunk_points) + i % chunk_points]);
    }
    mean_colors_.resize(std::size_t{3} * chunk_points * (longest_mean_prefix + 1));
    mean_shares_.resize(std::size_t{1 + model::slot_count} * chunk_points * (longest_mean_prefix + 1));
    for (int prefix = 1; prefix <= std::min(longest_mean_prefix, points_); ++prefix) {
        std::int16_t* colors = &mean_colors_[prefix * 3 * chunk_points];
        std::int16_t* shares = &mean_shares_[prefix * (1 + model::slot_count) * chunk_points];
        int point = 0;
        for (const pointsample::PrefixLook& look : pointsample::prefix_looks(model, prefix)) {
            for (int channel = 0; channel < 3; ++channel)
                colors[channel * chunk_points + point] = linear_of_code[look.color[channel]];
            if (own_lights())
                pack_own_light(look.own_light, &mean_own_lights_[prefix * own_light_values * chunk_points + point]);
            float untinted = 1.0f;
            for (int slot = 1; slot <= model::slot_count; ++slot) {
                const float share = static_cast<float>(look.shares[slot - 1]) / 255.0f;
                untinted -= share;
                shares[slot * chunk_points + point] = q15(share);
            }
            shares[point++] = q15(untinted);
        }
    }
}

void SplatModel::pack_shares(const figures::Figure& figure) {
    for (std::uint32_t rung = first_rung; static_cast<int>(pointsample::points_of_rung(rung)) < points_; ++rung)
        rungs_.push_back(static_cast<int>(pointsample::points_of_rung(rung)));
    rungs_.push_back(points_);
    const std::size_t row = std::size_t{chunk_points} * chunks_;
    shares_.assign(row * rungs_.size(), 0);
    const std::vector<std::vector<float>> shares = shares_of_prefixes(*figure.points, rungs_);
    for (std::size_t rung = 0; rung < rungs_.size(); ++rung)
        std::ranges::transform(shares[rung], &shares_[row * rung], [](float share) {
            return static_cast<std::int16_t>(std::lround(std::min(share * share_unit, 32767.0f)));
        });
    for (std::size_t rung = 0; rung + 1 < rungs_.size(); ++rung)
        for (int i = rungs_[rung]; i < rungs_[rung + 1]; ++i) shares_[row * rung + i] = shares_[row * (rung + 1) + i];
}

SplatModel::Blend SplatModel::shares(float count) const {
    const std::size_t row = std::size_t{chunk_points} * chunks_;
    std::size_t rung = pointsample::rung_of(static_cast<std::uint32_t>(count));
    rung = std::min(rung < first_rung ? 0 : rung - first_rung, rungs_.size() - 1);
    const std::int16_t* near = &shares_[row * rung];
    if (rung + 1 == rungs_.size() || count <= static_cast<float>(rungs_[rung])) return {near, near, 0.0f};
    const float step = static_cast<float>(rungs_[rung + 1] - rungs_[rung]);
    return {near, near + row, (count - static_cast<float>(rungs_[rung])) / step};
}

// As many as the budget allows, spread evenly over each clip.
void SplatModel::choose_keys(const figures::Figure& figure) {
    const motion::PoseTable& poses = *figure.poses;
    const double each = direction_nodes * (static_cast<double>(figure.mesh->triangle_count()) + points_);
    const int step = std::max(1, static_cast<int>(std::ceil(poses.pose_count * each / look_budget)));
    key_of_.resize(static_cast<std::size_t>(poses.pose_count));
    for (const motion::ClipPoses& clip : poses.clips) {
        const int keys = (clip.pose_count + step - 1) / step;
        const auto first = static_cast<std::uint32_t>(key_poses_.size());
        for (int key = 0; key < keys; ++key)
            key_poses_.push_back(static_cast<std::uint32_t>(clip.first_pose + key * step));
        for (int pose = 0; pose < clip.pose_count; ++pose)  // clips are loops: behind the last key comes the first
            key_of_[static_cast<std::size_t>(clip.first_pose + pose)] =
                first + static_cast<std::uint32_t>((pose + step / 2) / step % keys);
    }
}

void SplatModel::look_around(const figures::Figure& figure) {
    const auto keys = static_cast<std::uint32_t>(key_poses_.size());
    looks_.resize(std::size_t{keys} * direction_nodes);
    visible_.assign(std::size_t{keys} * distinct_directions * chunks_, 0);
    lights_.assign(std::size_t{keys} * sun_azimuths * distinct_directions * light_stride, 0);
    const Facets facets(figure);
    const float area_each = area_ / static_cast<float>(points_);
    std::vector<float> own(static_cast<std::size_t>(points_));
    for (int i = 0; i < points_; ++i)
        own[i] =
            static_cast<float>(shares_[std::size_t{chunk_points} * chunks_ * (rungs_.size() - 1) + i]) / share_unit;
    tbb::parallel_for(std::uint32_t{0}, keys, [&](std::uint32_t key) {
        const int pose = static_cast<int>(key_poses_[key]);
        SelfOcclusion body(figure, pose, facets.in_pose(pose), own);
        const std::vector<LitPoint> lit = light_points(key_poses_[key]);
        // From above and all around; the opposite directions are the others.
        for (int node = (rings / 2) * ring_nodes; node < direction_nodes; ++node) {
            if (node / ring_nodes == rings / 2 && opposite_of(node) < node) continue;
            if (is_pole(node) && node % ring_nodes > 0) continue;
            const glm::vec3 direction = direction_of(node);
            const std::array<SelfOcclusion::Seen, 2> seen = body.look_both_ways(direction);
            for (int way = 0; way < 2; ++way) {
                const int from = way == 0 ? node : opposite_of(node);
                std::ranges::copy(seen[way].visible, &visible_[visible_of(key, from)]);
                Look& look = looks_[std::size_t{key} * direction_nodes + from];
                look.silhouette = seen[way].silhouette;
                look.summed = area_each * seen[way].facing;
                look.alike = share_alike(seen[way]) / static_cast<float>(points_);
                look.first_visible = seen[way].visible[0];
                find_lights(key, from, way == 0 ? direction : -direction, lit, seen[way].shown);
            }
        }
        Look* looks = &looks_[std::size_t{key} * direction_nodes];
        for (int node = 0; node < direction_nodes; ++node)
            if (is_pole(node)) looks[node] = looks[seen_of_pole(node)];
    });
    find_bends();
}

std::vector<SplatModel::LitPoint> SplatModel::light_points(std::uint32_t pose) const {
    std::array<glm::vec3, sun_azimuths> suns;
    for (int azimuth = 0; azimuth < sun_azimuths; ++azimuth) suns[azimuth] = sun_at(azimuth, light_.to_sun);
    std::vector<LitPoint> lit(static_cast<std::size_t>(std::min(points_, lit_points)));
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const PosedChunk& chunk = chunk_of(pose, static_cast<int>(i) / chunk_points);
        const std::size_t lane = i % chunk_points;
        const auto three = [&](const auto& of, float unit) {
            return glm::vec3(of[0][lane], of[1][lane], of[2][lane]) / unit;
        };
        const std::int16_t* own = colors() + 3 * chunk_points * (i / chunk_points) + lane;
        const glm::vec3 color = glm::vec3(own[0], own[chunk_points], own[2 * chunk_points]) / 32767.0f;
        const glm::vec3 normal = three(chunk.normal, 127.0f);
        const auto own_light = [&](std::size_t value) {
            if (!own_lights()) return 0.0f;
            return own_lights()[(own_light_values * (i / chunk_points) + value) * chunk_points + lane] / 32767.0f;
        };
        const float seen_anyway = own_light(3);
        lit[i].emitted = {own_light(0), own_light(1), own_light(2)};
        lit[i].slot = (slots_[i] & 0xff) / 2;
        lit[i].facet = three(chunk.facet, facet_unit);
        for (int side = 0; side < 2; ++side) {
            const glm::vec3 outward = side == 0 ? normal : -normal;
            const glm::vec3 around = glm::mix(light_.from_below, light_.from_above, 0.5f + 0.5f * outward.y);
            for (int azimuth = 0; azimuth < sun_azimuths; ++azimuth) {
                const glm::vec3 falling = around + light_.sun * std::max(0.0f, glm::dot(outward, suns[azimuth]));
                const glm::vec3 light = color * (falling + seen_anyway * (1.0f - falling));
                for (int channel = 0; channel < 3; ++channel)
                    lit[i].light[side][3 * azimuth + channel] = light[channel];
            }
        }
    }
    return lit;
}

void SplatModel::find_lights(std::uint32_t key, int node, glm::vec3 direction, std::span<const LitPoint> lit,
                             std::span<const float> shown) {
    std::array<std::array<float, 3 * sun_azimuths>, 1 + model::slot_count> sums{};
    float weights = 0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const float weight = shown[i];
        if (!(weight > 0.0f)) continue;
        std::array<float, 3 * sun_azimuths>& sum = sums[lit[i].slot];
        const int side = double_sided_ && glm::dot(lit[i].facet, direction) < 0.0f ? 1 : 0;
        const std::array<float, 3 * sun_azimuths>& light = lit[i].light[side];
        for (std::size_t value = 0; value < sum.size(); ++value) sum[value] += weight * light[value];
        if (own_lights())
            for (std::size_t value = 0; value < sum.size(); ++value)
                sums[model::no_slot][value] += weight * lit[i].emitted[static_cast<int>(value % 3)];
        weights += weight;
    }
    if (!(weights > 0.0f)) return;
    for (int azimuth = 0; azimuth < sun_azimuths; ++azimuth) {
        std::uint16_t* light = &lights_[lights_of(key, azimuth, node)];
        for (const auto& sum : sums)
            for (int channel = 0; channel < 3; ++channel)
                *light++ =
                    static_cast<std::uint16_t>(std::min(light_unit * sum[3 * azimuth + channel] / weights, 65535.0f));
    }
}

SplatModel::SlotLights SplatModel::lights(std::uint32_t pose, const Between& between, glm::vec3 to_sun) const {
    const float turn = diamond_of(to_sun.x, to_sun.z) * (sun_azimuths / 4.0f);
    const int below = std::min(static_cast<int>(turn), sun_azimuths - 1), above = (below + 1) % sun_azimuths;
    const float share = turn - static_cast<float>(below);
    std::array<const std::uint16_t*, mixed_rows> rows;
    std::array<float, mixed_rows> weights;
    for (int i = 0; i < 4; ++i) {
        rows[2 * i] = &lights_[lights_of(key_of_[pose], below, between.node[i])];
        rows[2 * i + 1] = &lights_[lights_of(key_of_[pose], above, between.node[i])];
        weights[2 * i + 1] = between.share[i] * share / light_unit;
        weights[2 * i] = between.share[i] / light_unit - weights[2 * i + 1];
    }
    std::array<float, mixed_values> sums;
    mix(rows, weights, sums);
    SlotLights out;
    for (int value = 0; value < light_values; ++value) out[value / 3][value % 3] = sums[value];
    return out;
}

SplatModel::SlotLights SplatModel::lights(std::uint32_t pose, int azimuth, int node) const {
    const std::uint16_t* row = &lights_[lights_of(key_of_[pose], azimuth, node)];
    SlotLights out;
    for (int value = 0; value < light_values; ++value) out[value / 3][value % 3] = row[value] / light_unit;
    return out;
}

void SplatModel::find_bends() {
    for (std::size_t key = 0; key < key_poses_.size(); ++key) {
        Look* looks = &looks_[key * direction_nodes];
        const auto s = [looks](int node) { return looks[node].silhouette; };
        for (int node = 0; node < direction_nodes; ++node) {
            const int ring = node / ring_nodes, first = ring * ring_nodes, at = node - first;
            const float left = s(first + (at + ring_nodes - 1) % ring_nodes), right = s(first + (at + 1) % ring_nodes);
            looks[node].bend_around = 0.5f * (left - 2.0f * s(node) + right);
            // Beyond a pole the ring that it came from goes on, on the other side.
            const int opposite = (at + ring_nodes / 2) % ring_nodes;
            const float below = ring > 0 ? s(node - ring_nodes) : s(ring_nodes + opposite);
            const float above = ring + 1 < rings ? s(node + ring_nodes) : s((rings - 2) * ring_nodes + opposite);
            looks[node].bend_up = 0.5f * (below - 2.0f * s(node) + above);
        }
    }
}

float SplatModel::most_alike() const {
    float most = 0;
    for (const Look& look : looks_) most = std::max(most, look.alike);
    return most * static_cast<float>(points_);
}

// Between two nodes a silhouette bulges out: a straight line would be up to 5 % short of it.
float SplatModel::silhouette(std::uint32_t pose, const Between& between) const {
    const float around = between.around * (1.0f - between.around), up = between.up * (1.0f - between.up);
    float sum = 0;
    for (int i = 0; i < 4; ++i) {
        const Look& there = look(pose, between.node[i]);
        sum += between.share[i] * (there.silhouette - around * there.bend_around - up * there.bend_up);
    }
    return sum;
}

}  // namespace render::native
