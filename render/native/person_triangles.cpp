#include "render/native/person_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/unorm.h"
#include "render/native/clip.h"

namespace render::native {

namespace {

constexpr int grid_per_pixel = grid_per_sample * samples_across;

// Where vertices are before they are sorted out; one a thread.
struct GridPlaces {
    std::vector<std::int32_t> across, down;
};

GridPlaces& grid_places(std::size_t vertices) {
    thread_local GridPlaces places;
    places.across.resize(std::max(places.across.size(), vertices));
    places.down.resize(places.across.size());
    return places;
}

double snorm(std::int16_t value) {
    return std::max(value / 32767.0, -1.0);
}

// A person's turn and the other way around, in double precision.
struct Turn {
    double sin, cos;

    explicit Turn(const Instance& instance) : sin(snorm(instance.turn.sin_yaw)), cos(snorm(instance.turn.cos_yaw)) {}
    glm::dvec3 operator()(const glm::dvec3& v) const { return {cos * v.x + sin * v.z, v.y, cos * v.z - sin * v.x}; }
    glm::dvec3 transposed(const glm::dvec3& v) const { return {cos * v.x - sin * v.z, v.y, sin * v.x + cos * v.z}; }
};

Form form_of(const glm::dmat4x3& place, const glm::dvec3& direction, double scale) {
    const glm::dvec4 row = scale * (direction * place);
    return {static_cast<float>(row.x), static_cast<float>(row.y), static_cast<float>(row.z), static_cast<float>(row.w)};
}

bool usable(const Form& form) {
    constexpr float most = 1e15f;  // [grid steps m], [m]: nobody is there, and sums and products stay finite
    return std::abs(form.x) < most && std::abs(form.y) < most && std::abs(form.z) < most && std::abs(form.one) < most;
}

// From packed positions to metres from the camera, along the world's axes.
glm::dmat4x3 place_of(const motion::Bounds& box, const Instance& instance) {
    const Turn turn(instance);
    const double scale = instance.scale;
    const glm::dvec3 step = scale * glm::dvec3(box.size()) / static_cast<double>(model::unorm_steps);
    return {turn({step.x, 0, 0}), turn({0, step.y, 0}), turn({0, 0, step.z}),
            glm::dvec3(instance.position) + scale * turn(glm::dvec3(box.min))};
}

}  // namespace

std::optional<Placement> placement_of(const View& view, const glm::vec3& to_sun, const motion::Bounds& box,
                                      const Instance& instance) {
    const glm::dmat4x3 place = place_of(box, instance);
    const double half_width = 0.5 * grid_per_pixel * view.width, half_height = 0.5 * grid_per_pixel * view.height;
    const Turn turn(instance);
    Placement p;
    p.across = form_of(place, view.right, half_width / view.tan_half_x);
    p.down = form_of(place, view.up, -half_height / view.tan_half_y);
    p.depth = form_of(place, view.forward, 1);
    p.center_x = static_cast<float>(half_width);
    p.center_y = static_cast<float>(half_height);
    const glm::vec3 sun(turn.transposed(to_sun));
    for (int axis = 0; axis < 3; ++axis) p.sun[axis] = sun[axis];
    if (!usable(p.across) || !usable(p.down) || !usable(p.depth)) return std::nullopt;
    return p;
}

namespace {

// The least and the greatest depth of anything in the pose table's box.
std::array<float, 2> depth_range(const Form& depth) {
    std::array<float, 2> range{depth.one, depth.one};
    for (const float slope : {depth.x, depth.y, depth.z}) {
        const float step = slope * static_cast<float>(model::unorm_steps);
        range[0] += std::min(step, 0.0f);
        range[1] += std::max(step, 0.0f);
    }
    return range;
}

bool fits_grid(const Extent& extent) {
    const auto length = [](std::int32_t min, std::int32_t max) { return std::int64_t{max} - min; };
    return length(extent.min_x, extent.max_x) <= reach_on_grid && length(extent.min_y, extent.max_y) <= reach_on_grid;
}

int floor_divided(int value, int by) {
    return value >= 0 ? value / by : -((by - 1 - value) / by);
}

Rect pixels_of(const View& view, const Extent& extent) {
    const auto from = [](std::int32_t grid) { return std::max(floor_divided(grid, grid_per_pixel), 0); };
    const auto end = [](std::int32_t grid, int size) {
        return std::min(floor_divided(grid, grid_per_pixel) + 1, size);
    };
    const Rect pixels{from(extent.min_x), from(extent.min_y), end(extent.max_x, view.width),
                      end(extent.max_y, view.height)};
    return pixels.empty() ? Rect{} : pixels;
}

// With those seen from behind.
std::size_t lit_vertices(const PersonMesh& mesh) {
    return (mesh.double_sided ? 2 : 1) * in_groups(mesh.vertex_count);
}

// As motion::unpack_position and the placement have it, in the place of a vertex.
glm::dvec3 applied(const Placement& placement, const motion::PosedVertex& v) {
    const auto apply = [&](const Form& form) {
        return double{form.x} * v.x + double{form.y} * v.y + double{form.z} * v.z + double{form.one};
    };
    return {apply(placement.across), apply(placement.down), apply(placement.depth)};
}

// Clockwise on the screen is from before, wherever the corners are.
bool is_from_behind(const std::array<PlacedCorner, 3>& triangle) {
    return glm::dot(triangle[0].position, glm::cross(triangle[1].position, triangle[2].position)) < 0;
}

}  // namespace

Daylight daylight_of(const scene::Light& light) {
    Daylight daylight;
    for (int c = 0; c < 3; ++c) {
        daylight.level[c] = 0.5f * (light.from_above[c] + light.from_below[c]);
        daylight.slope[c] = 0.5f * (light.from_above[c] - light.from_below[c]);
        daylight.sun[c] = light.sun[c];
    }
    daylight.to_sun = light.to_sun;
    return daylight;
}

std::size_t PersonTriangles::size_of(const PersonMesh& mesh) {
    return lit_vertices(mesh) * sizeof(LitVertex) + mesh.paints.size() * sizeof(Tint) +
           (in_groups(mesh.faces.size()) + group) * sizeof(FacingTriangle);
}

void PersonTriangles::reserve(const PersonMesh& mesh) {
    const std::size_t vertices = lit_vertices(mesh), faces = in_groups(mesh.faces.size()) + group;
    if (vertices > vertex_room_) lit_ = hwy::AllocateAligned<LitVertex>(vertex_room_ = vertices);
    if (mesh.paints.size() > paint_room_) tints_ = hwy::AllocateAligned<Tint>(paint_room_ = mesh.paints.size());
    if (faces > face_room_) facing_ = hwy::AllocateAligned<FacingTriangle>(face_room_ = faces);
}

void PersonTriangles::paint(const PersonMesh& mesh, const scene::Palette& palette) {
    for (std::size_t i = 0; i < mesh.paints.size(); ++i) {
        const Paint& paint = mesh.paints[i];
        glm::vec3 color = paint.color * full;
        if (paint.slot != model::no_slot) {
            const glm::vec3 own = glm::vec3(palette[paint.slot]) / 255.0f;
            color *= own * own;
        }
        tints_[i] = {color.r, color.g, color.b};
    }
}

Rect PersonTriangles::place(const View& view, const Daylight& daylight, const PersonMesh& mesh, const Person& person) {
    facing_count_ = 0;
    wide_.clear();
    const auto placement = placement_of(view, daylight.to_sun, mesh.poses->box, person.instance);
    if (!placement) return {};
    const auto [nearest, farthest] = depth_range(placement->depth);
    if (!(farthest >= near_plane)) return {};
    reserve(mesh);
    GridPlaces& places = grid_places(in_groups(mesh.vertex_count));
    const std::span posed(mesh.poses->vertices.data() + std::size_t{person.pose} * mesh.vertex_count,
                          mesh.vertex_count);
    const Extent extent = place_vertices(*placement, daylight, posed, mesh.double_sided, lit_.get(),
                                         places.across.data(), places.down.data());
    for (const std::uint32_t v : mesh.unlit)
        for (LitVertex* side : {&lit_[v], &lit_[mesh.behind() + v]}) std::fill_n(side->light, 3, 1.0f);
    const bool in_front = nearest >= near_plane;
    if (in_front && pixels_of(view, extent).empty()) return {};
    paint(mesh, person.instance.palette);
    if (in_front && fits_grid(extent)) return place_on_grid(view, mesh, extent);
    return place_anywhere(view, mesh, *placement, posed);
}

Rect PersonTriangles::place_on_grid(const View& view, const PersonMesh& mesh, const Extent& extent) {
    const auto block_at = [](std::int32_t min, std::int32_t max) {
        return sample_block_side * floor_divided(min + (max - min) / 2, sample_block_side * grid_per_sample);
    };
    origin_x_ = block_at(extent.min_x, extent.max_x);
    origin_y_ = block_at(extent.min_y, extent.max_y);
    GridPlaces& places = grid_places(in_groups(mesh.vertex_count));
    // Packed where x was.
    auto* packed = reinterpret_cast<std::uint32_t*>(places.across.data());
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
        const auto x = static_cast<std::uint32_t>(places.across[v] - origin_x_ * grid_per_sample);
        const auto y = static_cast<std::uint32_t>(places.down[v] - origin_y_ * grid_per_sample);
        packed[v] = (x & 0xffffu) | y << 16;
    }
    facing_count_ = find_facing(mesh, packed, facing_.get());
    pixels_ = pixels_of(view, extent);
    nearest_ = extent.nearest;
    return facing_count_ == 0 ? Rect{} : pixels_;
}

Rect PersonTriangles::place_anywhere(const View& view, const PersonMesh& mesh, const Placement& placement,
                                     std::span<const motion::PosedVertex> posed) {
    for (const Face& face : mesh.faces) {
        std::array<PlacedCorner, 3> triangle;
        for (int k = 0; k < 3; ++k) triangle[k].position = applied(placement, posed[face.corners[k]]);
        const LitVertex* lit = lit_.get() + (is_from_behind(triangle) ? mesh.behind() : 0);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = face.corners[k];
            const Tint& tint = tints_[face.paints[k]];
            const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[v];
            const float alpha = mesh.alphas.empty() ? 1.0f : mesh.alphas[v];
            const float* light = lit[v].light;
            triangle[k].look = {
                {light[0], light[1], light[2]}, 0, {tint.red, tint.green, tint.blue}, uv.x, uv.y, alpha};
        }
        append_clipped(triangle, placement.center_x, placement.center_y, mesh.double_sided,
                       mesh.texturings[face.texturing], wide_);
    }
    Extent extent{INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
    for (const WideTriangle& t : wide_) {
        for (int k = 0; k < 3; ++k) {
            extent = {std::min(extent.min_x, t.x[k]), std::min(extent.min_y, t.y[k]), std::max(extent.max_x, t.x[k]),
                      std::max(extent.max_y, t.y[k])};
        }
    }
    return wide_.empty() ? Rect{} : pixels_of(view, extent);
}

void PersonTriangles::draw(const PersonMesh& mesh, NearLayer& layer) const {
    if (wide_.empty())
        fill(mesh,
             {std::span(facing_.get(), facing_count_), origin_x_, origin_y_, pixels_, nearest_, lit_.get(),
              tints_.get()},
             layer);
    else
        fill(mesh.textures, wide_, layer);
}

}  // namespace render::native
