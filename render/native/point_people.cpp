#include "render/native/point_people.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace render::native {

namespace {

constexpr float unit = 32767.0f;
// Normals are stored as 127 = 1 and read as 32512 = 1.
constexpr float normal_unit = 32767.0f / 32512.0f;
// Sums over so few points depend on which they are: they are made to cover what the silhouette does, one by one.
constexpr std::uint32_t longest_summed_prefix = 64;

// To the nearest; the offset keeps what is cut off positive.
std::int16_t fixed(float value, float one = unit) {
    return static_cast<std::int16_t>(static_cast<int>(std::clamp(value * one, -unit, unit) + 32768.5f) - 32768);
}

std::array<std::int16_t, 3> fixed(glm::vec3 value, float one = unit) {
    return {fixed(value.x, one), fixed(value.y, one), fixed(value.z, one)};
}

struct Turn {
    float sine, cosine;
    glm::vec3 to_world(glm::vec3 v) const { return {cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x}; }
    glm::vec3 to_model(glm::vec3 v) const { return {cosine * v.x - sine * v.z, v.y, cosine * v.z + sine * v.x}; }
};

}  // namespace

PointPeople::PointPeople(std::span<const figures::Figure> figures, const scene::Light& light)
    : figures_(figures.begin(), figures.end()), models_(figures.size()), to_sun_(light.to_sun) {
    constexpr float one = 16384.0f;
    light_.level = fixed(0.5f * (light.from_below + light.from_above), one);
    light_.slope = fixed(0.5f * normal_unit * (light.from_above - light.from_below), one);
    light_.sun = fixed(normal_unit * light.sun, one);
}

void PointPeople::prepare(const View& view, double splat_size, std::span<const Person* const> people) {
    for (const Person* person : people)
        if (!models_[person->character])
            models_[person->character] = std::make_unique<SplatModel>(figures_[person->character]);
    const float cell = std::max(1.0f, static_cast<float>(splat_size));
    people_.resize(people.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, people.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) people_[i] = ready(view, *people[i], cell);
    });
}

SplatPerson PointPeople::ready(const View& view, const Person& person, float cell) const {
    const Instance& instance = person.instance;
    const SplatModel& model = *models_[person.character];
    const motion::Bounds& box = figures_[person.character].poses->box;
    const Turn turn{static_cast<float>(instance.sin_yaw) / unit, static_cast<float>(instance.cos_yaw) / unit};
    SplatPerson out;
    out.positions = model.positions(person.pose);
    out.normals = model.normals(person.pose);
    out.count = static_cast<int>(person.count);
    out.last_share = fixed(person.last_share);

    // Where 32768 of each axis goes, and the middle of the box.
    constexpr float half_steps = 32768.0f / 65535.0f;
    const glm::vec3 half = instance.scale * half_steps * box.size();
    const glm::vec3 middle =
        instance.position + turn.to_world(instance.scale * (box.min + half_steps * box.size()));
    out.depth = std::max(view.depth(middle), near_plane);
    out.reach = glm::length(half);
    out.nearness = fixed(out.reach / out.depth);
    const float cells_per_metre = view.pixels_per_metre(out.depth) / cell;
    constexpr float steps = 1 << cell_bits;
    const glm::vec2 from_center = cells_per_metre * glm::vec2(glm::dot(view.right, middle), -glm::dot(view.up, middle));
    const glm::vec2 center = 0.5f / cell * glm::vec2(view.width, view.height);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 e(0.0f);
        e[axis] = half[axis];
        const glm::vec3 world = turn.to_world(e);
        const float back = glm::dot(view.forward, world);
        out.axes[0][axis] =
            fixed(cells_per_metre * glm::dot(view.right, world) - from_center.x * back / out.depth, steps);
        out.axes[1][axis] =
            fixed(-cells_per_metre * glm::dot(view.up, world) - from_center.y * back / out.depth, steps);
        out.axes[2][axis] = fixed(back / out.reach);
    }
    constexpr float farthest = 1e6f;  // [cells] beyond every picture
    const glm::vec2 at = glm::clamp(from_center + center, -farthest, farthest);
    out.middle = {static_cast<std::int32_t>(std::floor(at.x * steps)),
                  static_cast<std::int32_t>(std::floor(at.y * steps))};
    out.cell = cell;

    // What its points may touch; perspective makes the nearest larger.
    const SplatModel::Extent& extent = model.extent(person.pose);
    const float larger = 1.0f / std::max(1.0f - out.reach / out.depth, 0.25f);
    std::array<std::int16_t, 4> bounds;
    for (int i = 0; i < 2; ++i) {
        float low = 0, high = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float a = out.axes[i][axis] / 32768.0f * extent.min[axis];
            const float b = out.axes[i][axis] / 32768.0f * extent.max[axis];
            low += std::min(a, b);
            high += std::max(a, b);
        }
        low = std::min(low, low * larger) / steps + at[i];
        high = std::max(high, high * larger) / steps + at[i];
        bounds[i] = static_cast<std::int16_t>(std::clamp(std::floor(low) - 1.0f, -16000.0f, 16000.0f));
        bounds[2 + i] = static_cast<std::int16_t>(std::clamp(std::floor(high) + 3.0f, -16000.0f, 16000.0f));
    }
    out.x0 = bounds[0], out.y0 = bounds[1], out.x1 = bounds[2], out.y1 = bounds[3];

    const glm::vec3 to_eye = turn.to_model(-glm::normalize(middle));
    out.to_eye = fixed(to_eye);
    out.to_sun = fixed(turn.to_model(to_sun_));
    out.two_sided = out.count <= longest_two_sided_prefix;

    const float samples = static_cast<float>(person.count - 1) + person.last_share;
    const float cells_per_unit = cells_per_metre * instance.scale;
    const Between between = between_nodes(to_eye);
    float silhouette = 0, summed = 0;
    for (int i = 0; i < 4; ++i) {
        out.visible[i] = model.visible(person.pose, between.node[i]);
        out.visible_share[i] = fixed(between.share[i], unit - 4.0f);  // rounded up, four still sum to at most one
        silhouette += between.share[i] * model.silhouette(person.pose, between.node[i]);
        summed += between.share[i] * model.summed(person.pose, between.node[i]);
    }
    const float cells = cells_per_unit * cells_per_unit;
    out.total = person.count <= longest_summed_prefix ? silhouette * cells : 0.0f;
    const float covers = summed > 0.0f ? silhouette / summed : 1.0f;
    out.area_each = normal_unit * covers * model.area() * cells / samples;

    const bool is_mean = out.count <= longest_mean_prefix;
    out.colors = is_mean ? model.mean_colors(out.count) : model.colors();
    out.shares = is_mean ? model.mean_shares(out.count) : nullptr;
    out.slots = model.slots();
    for (int channel = 0; channel < 3; ++channel) {
        out.palette[channel] = {};
        out.palette[channel][model::no_slot] = 32767;
        for (int slot = 1; slot <= model::slot_count; ++slot) {
            const float share = static_cast<float>(instance.palette[static_cast<model::Slot>(slot)][channel]) / 255.0f;
            out.palette[channel][slot] = fixed(share * share);
        }
    }
    return out;
}

}  // namespace render::native
