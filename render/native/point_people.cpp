#include "render/native/point_people.h"

#include <hwy/cache_control.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "figures/points.h"
#include "render/contact_shade.h"
#include "render/native/cell_grid.h"
#include "render/native/linear_codes.h"
#include "render/room.h"

namespace render::native {

namespace {

constexpr float unit = 32767.0f;
// Between directions that disagree it is unknown whether a point is hidden. If it isn't, it leaves a hole unless it
// shows wholly; if it is, the cell is full anyway. Of surfaces with two sides half the points are hidden: those would
// show.
constexpr float shown_by_halves = 2.0f;
// Normals are stored as 127 = 1 and read as 32512 = 1.
constexpr float normal_unit = 32767.0f / 32512.0f;

template <typename T>
void prefetch_all(const T& object) {
    constexpr std::size_t line = 64;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&object);
    for (std::size_t at = 0; at < sizeof object; at += line) hwy::Prefetch(bytes + at);
}

// To the nearest; the offset keeps what is cut off positive.
std::int16_t fixed(float value, float one = unit) {
    return static_cast<std::int16_t>(static_cast<int>(std::min(std::max(value * one, -unit), unit) + 32768.5f) - 32768);
}

std::array<std::int16_t, 3> fixed(glm::vec3 value, float one = unit) {
    return {fixed(value.x, one), fixed(value.y, one), fixed(value.z, one)};
}

struct Turn {
    float sine, cosine;
    glm::vec3 to_world(glm::vec3 v) const { return {cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x}; }
    glm::vec3 to_model(glm::vec3 v) const { return {cosine * v.x - sine * v.z, v.y, cosine * v.z + sine * v.x}; }
};

// One person, as the eye and the sun see them.
struct Sight {
    const View& view;
    const Person& person;
    const SplatModel& model;
    Turn turn;
    float cell;          // [px]
    glm::vec3 half;      // [m] where 32768 of each axis goes, from the middle of the box
    glm::vec3 middle;    // [m] of the box, camera-relative
    float depth, reach;  // [m]
    float cells_per_metre;
    float samples;  // points, the last in part
    glm::vec3 to_eye, to_sun;
    Between between;

    Sight(const View& from, const Person& whom, const SplatModel& points, const motion::Bounds& box, glm::vec3 sun,
          float cell_px)
        : view(from),
          person(whom),
          model(points),
          turn{static_cast<float>(whom.instance.turn.sin_yaw) / unit,
               static_cast<float>(whom.instance.turn.cos_yaw) / unit},
          cell(cell_px) {
        constexpr float half_steps = 32768.0f / 65535.0f;
        half = whom.instance.scale * half_steps * box.size();
        middle = whom.instance.position + turn.to_world(whom.instance.scale * (box.min + half_steps * box.size()));
        depth = std::max(view.depth(middle), near_plane);
        reach = glm::length(half);
        cells_per_metre = view.pixels_per_metre(depth) / cell;
        samples = static_cast<float>(whom.count - 1) + whom.last_share;
        to_eye = turn.to_model(-glm::normalize(middle));
        to_sun = turn.to_model(sun);
        between = between_nodes(to_eye);
    }

    // [cells] From the middle of the picture.
    glm::vec2 from_center() const { return from_center(middle); }
    glm::vec2 from_center(glm::vec3 place) const {
        return cells_per_metre * glm::vec2(glm::dot(view.right, place), -glm::dot(view.up, place));
    }
    // [cells] On the picture; of another place that is as far.
    glm::vec2 at() const { return at(middle); }
    glm::vec2 at(glm::vec3 place) const {
        constexpr float farthest = 1e6f;  // beyond every picture
        const glm::vec2 center = 0.5f / cell * glm::vec2(view.width, view.height);
        return glm::clamp(from_center(place) + center, -farthest, farthest);
    }
};

constexpr float steps_a_cell = 1 << cell_bits;

void take_points(const Sight& sight, SplatPerson& out) {
    const SplatModel& model = sight.model;
    const std::uint32_t pose = sight.person.pose;
    out.first_chunk = model.first_chunk(pose);
    out.other_chunks = model.other_chunks(pose);
    out.count = static_cast<int>(sight.person.count);
    out.last_share = fixed(sight.person.last_share);
    out.hides_itself = out.count > longest_two_sided_prefix;
    out.two_sided = !out.hides_itself || model.double_sided();
    const SplatModel::Blend shares = model.shares(sight.samples);
    out.shares = {shares.near, shares.far};
    out.to_far = fixed(shares.to_far);
    const bool is_mean = out.count <= longest_mean_prefix;
    out.colors = is_mean ? model.mean_colors(out.count) : model.colors();
    out.slot_shares = is_mean ? model.mean_shares(out.count) : nullptr;
    out.own_lights = is_mean ? model.mean_own_lights(out.count) : model.own_lights();
    out.slots = model.slots();
}

// Perspective to the first order in the axes; the kernel does the rest with `nearness`.
void place(const Sight& sight, SplatPerson& out) {
    // About a body's own depth: three quarters of the side of a square as large as its silhouette.
    const float side = sight.person.instance.scale * std::sqrt(0.25f * sight.model.area());
    static_cast<InDepth&>(out) = in_depth(sight.depth, sight.reach, 0.75f * side);
    out.nearness = fixed(sight.reach / sight.depth);
    const View& view = sight.view;
    const glm::vec2 from_center = sight.from_center();
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 along(0.0f);
        along[axis] = sight.half[axis];
        const glm::vec3 world = sight.turn.to_world(along);
        const float back = glm::dot(view.forward, world), shift = back / sight.depth;
        out.axes[0][axis] =
            fixed(sight.cells_per_metre * glm::dot(view.right, world) - from_center.x * shift, steps_a_cell);
        out.axes[1][axis] =
            fixed(-sight.cells_per_metre * glm::dot(view.up, world) - from_center.y * shift, steps_a_cell);
        out.axes[2][axis] = fixed(back / sight.reach);
    }
    const glm::vec2 at = sight.at();
    for (int i = 0; i < 2; ++i) out.middle[i] = static_cast<std::int32_t>(std::floor(at[i] * steps_a_cell));
    out.to_eye = fixed(sight.to_eye);
    out.to_sun = fixed(sight.to_sun);
}

// What the points may touch; perspective makes the nearest larger.
void find_bounds(const Sight& sight, SplatPerson& out) {
    const SplatModel::Extent& extent = sight.model.extent(sight.person.pose);
    const float larger = 1.0f / std::max(1.0f - sight.reach / sight.depth, 0.25f);
    const glm::vec2 at = sight.at();
    std::array<std::int16_t, 4> bounds;
    for (int i = 0; i < 2; ++i) {
        float low = 0, high = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float a = out.axes[i][axis] / 32768.0f * extent.min[axis];
            const float b = out.axes[i][axis] / 32768.0f * extent.max[axis];
            low += std::min(a, b);
            high += std::max(a, b);
        }
        low = std::min(low, low * larger) / steps_a_cell + at[i];
        high = std::max(high, high * larger) / steps_a_cell + at[i];
        constexpr float most = 16000.0f;
        bounds[i] = static_cast<std::int16_t>(std::clamp(std::floor(low) - 1.0f, -most, most));
        bounds[2 + i] = static_cast<std::int16_t>(std::clamp(std::floor(high) + 3.0f, -most, most));
    }
    out.x0 = bounds[0], out.y0 = bounds[1], out.x1 = bounds[2], out.y1 = bounds[3];
}

// How much the points cover, together and each.
void weigh(const Sight& sight, const Gains& gains, SplatPerson& out) {
    const SplatModel& model = sight.model;
    const std::uint32_t pose = sight.person.pose;
    float interpolated = 0, summed = 0, alike = 0;
    const float visible_unit = out.two_sided ? unit - 4.0f : shown_by_halves * unit;
    for (int i = 0; i < 4; ++i) {
        const int node = sight.between.node[i];
        const float share = sight.between.share[i];
        const SplatModel::Look& look = model.look(pose, node);
        out.first_visible[i] = look.first_visible;
        out.visible[i] = model.visible(pose, node);
        out.visible_share[i] = fixed(share, visible_unit);  // rounded up, four still sum to at most one
        interpolated += share * look.silhouette;
        summed += share * look.summed;
        alike += share * look.alike;
    }
    // Off the screen's middle a silhouette's image is larger, as it is cast aslant.
    const float cells_per_unit = sight.cells_per_metre * sight.person.instance.scale;
    const float cells = cells_per_unit * cells_per_unit * glm::length(sight.middle) / sight.depth;
    out.silhouette = cells * model.silhouette(pose, sight.between);
    out.alike = alike * sight.samples;
    const float gain = gains.at(out.silhouette, out.alike);
    out.total = out.count <= longest_summed_prefix ? gain * out.silhouette : 0.0f;
    const float covers = summed > 0.0f ? interpolated / summed : 1.0f;
    out.area_each = gain * covers * model.area() * cells / sight.samples;
}

void color(const Sight& sight, SplatPerson& out) {
    for (int channel = 0; channel < 3; ++channel) {
        out.palette[channel] = {};
        out.palette[channel][model::no_slot] = 32767;
        for (int slot = 1; slot <= model::slot_count; ++slot)
            out.palette[channel][slot] =
                linear_of_code[sight.person.instance.palette[static_cast<model::Slot>(slot)][channel]];
    }
    out.mean_light = {};
    if (!(out.total > 0.0f)) return;
    const SplatModel::SlotLights lights = sight.model.lights(sight.person.pose, sight.between, sight.to_sun);
    for (int channel = 0; channel < 3; ++channel)
        for (int slot = 0; slot <= model::slot_count; ++slot)
            out.mean_light[channel] += lights[slot][channel] * (out.palette[channel][slot] * (1.0f / unit));
}

// What is too small to be drawn round; seen from aside it is smaller still.
void find_spot(const Sight& sight, SplatPerson& out) {
    out.spot = 0;
    const float radius = sight.person.shade_radius;
    if (!(radius > 0.0f)) return;
    const float share = 1.0f - contact_share(radius * sight.view.pixels_per_metre(sight.depth));
    const float cells = radius * sight.cells_per_metre;
    const float aside = std::abs(sight.middle.y) / sight.depth;
    out.spot = fixed(share * contact_area * cells * cells * aside, cell_full);
    const glm::vec2 at = sight.at(sight.person.instance.position);
    for (int i = 0; i < 2; ++i) out.feet[i] = static_cast<std::int32_t>(std::floor(at[i] * steps_a_cell));
}

// [px] The side of cells for S.
float cell_of(float splat_size) {
    return std::max(1.0f, static_cast<float>(figures::cell_share) * splat_size);
}

}  // namespace

PointPeople::PointPeople(std::span<const figures::Figure> figures, const scene::Light& light)
    : figures_(figures.begin(), figures.end()), kinds_(figures.size()), daylight_(light) {
    constexpr float one = 16384.0f;
    light_.level = fixed(0.5f * (light.from_below + light.from_above), one);
    light_.slope = fixed(0.5f * normal_unit * (light.from_above - light.from_below), one);
    light_.sun = fixed(normal_unit * light.sun, one);
}

void PointPeople::prepare(const View& view, double splat_size, std::span<const Person* const> people) {
    cell_ = cell_of(static_cast<float>(splat_size));
    resize_anew(people_, people.size());
    resize_anew(bounds_, people.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, people.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            ready(view, *people[i], cell_, people_[i]);
            bounds_[i] = pixels_of(people_[i].cells(), cell_);
        }
    });
}

float PointPeople::reach_of(const Person& person) const {
    return person.instance.scale * glm::length(figures_[person.character].poses->box.size());
}

InDepth in_depth(float depth, float reach, float thickness) {
    constexpr float codes_per_metre = 16.0f;  // they repeat after 4 km, where nobody is a body's depth apart
    return {depth, reach, static_cast<std::int16_t>(static_cast<std::int64_t>(depth * codes_per_metre)),
            static_cast<std::int16_t>(std::min(thickness * codes_per_metre, unit))};
}

void SplatPerson::prefetch() const {
    prefetch_all(*this);
}

void SplatPerson::prefetch_points() const {
    prefetch_all(*first_chunk);
}

void PointPeople::make_kind(std::uint32_t character) {
    kinds_[character] = std::make_unique<Kind>(figures_[character], daylight_);
    Gains gains;
    PatchRoom room;
    gains.measure([&](float cells, float alike, int trial) { return draw_alone(character, cells, alike, trial, room); },
                  kinds_[character]->model.most_alike());
    kinds_[character]->gains = gains;
}

// In a pose, from a direction and with a fraction of a pixel that the trial's number chooses.
Gains::Trial PointPeople::draw_alone(std::uint32_t character, float cells, float alike, int trial,
                                     PatchRoom& room) const {
    const motion::PoseTable& poses = *figures_[character].poses;
    const auto chance = [&](float step) { return std::fmod(step * static_cast<float>(trial + 1), 1.0f); };
    const float yaw = 6.2831853f * chance(0.618034f), height = 1.6f * chance(0.754878f) - 0.6f;
    // Far away, on a screen on which a unit of the model is as large as it takes.
    constexpr float away = 100.0f;
    const glm::vec3 target = poses.box.center();
    scene::CameraPose camera;
    camera.target = target;
    camera.position = target + away * glm::length(poses.box.size()) *
                                   glm::normalize(glm::vec3(chance(0.569840f) - 0.5f, height, 1.0f));
    constexpr int side = largest_patch_side - 4;
    Person person{};
    person.character = character;
    person.pose = static_cast<std::uint32_t>(chance(0.381966f) * static_cast<float>(poses.pose_count));
    person.count = static_cast<std::uint32_t>(figures_[character].poses->point_count);
    person.last_share = 1.0f;
    person.instance.scale = 1.0f;
    person.instance.turn.sin_yaw = fixed(std::sin(yaw));
    person.instance.turn.cos_yaw = fixed(std::cos(yaw));
    View view = make_view(camera, side, side);
    person.instance.position = view.relative(glm::vec3(0.0f));
    // A first look tells how large the silhouette is and how many points show alike; the field of view and their number
    // follow.
    SplatPerson drawn;
    ready(view, person, 1.0f, drawn);
    camera.fov_y = 2.0 * std::atan(view.tan_half_y * std::sqrt(drawn.silhouette / cells));
    const float all = static_cast<float>(person.count);
    const float points = drawn.alike > 0.0f ? std::clamp(all * alike / drawn.alike, 1.0f, all) : all;
    person.count = static_cast<std::uint32_t>(std::ceil(points));
    person.last_share = points - static_cast<float>(person.count - 1);
    view = make_view(camera, side, side);
    // Another place within the pixel.
    const float pixel = 2.0f * view.tan_half_y * drawn.depth / side;
    person.instance.position += pixel * (chance(0.414214f) * view.right + chance(0.732051f) * view.up);
    ready(view, person, 1.0f, drawn);

    const Patch patch = room.patch(-2, -2, largest_patch_side, largest_patch_side);
    splat(drawn, light_, patch);
    Gains::Trial out;
    out.silhouette = static_cast<double>(drawn.silhouette);
    for_each_used_group(patch, [&](std::int16_t* group) {
        for (int lane = 3; lane < 8 * group_cells; lane += 8)
            if (group[lane] > 0) out.coverage.push_back(static_cast<float>(group[lane]) / cell_full);
    });
    clear(patch);
    return out;
}

void PointPeople::ready(const View& view, const Person& person, float cell, SplatPerson& out) const {
    const Kind& kind = *kinds_[person.character];
    const Sight sight(view, person, kind.model, figures_[person.character].poses->box, daylight_.to_sun, cell);
    take_points(sight, out);
    place(sight, out);
    find_bounds(sight, out);
    weigh(sight, kind.gains, out);
    color(sight, out);
    find_spot(sight, out);
}

}  // namespace render::native
