// What the renderer puts on the device once: characters in all their poses, and the structure.
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <stdexcept>

#include "pointsample/prefix_look.h"
#include "render/frame.h"
#include "render/texture_array.h"
#include "shaders/layout.h"

namespace render {

namespace {

// One vertex or point in one pose with its looks beside it: the base vertex of a draw shifts all attributes alike, so
// what doesn't change with the pose is repeated for each.
struct BakedVertex {
    motion::PosedVertex posed;
    std::uint8_t red, green, blue;  // sRGB
    std::uint8_t look;              // of vertices: tint and texture layer; of points: whether seen from everywhere
    std::uint32_t uv_or_shares;     // of vertices: half x 2; of points: unorm 8 x 4, shares of the palette
};
static_assert(sizeof(BakedVertex) == 16);
static_assert(offsetof(BakedVertex, red) == 8 && offsetof(BakedVertex, look) == 11 &&
              offsetof(BakedVertex, uv_or_shares) == 12);
static_assert(offsetof(motion::PosedVertex, normal_u) == 6);
static_assert(model::tint_count == 5, "four shares of the palette, and the rest untinted");

constexpr GLuint vertex_binding = 0;
constexpr GLuint instance_binding = 1;

template <typename T>
Buffer upload(const std::vector<T>& data) {
    Buffer buffer = Buffer::create();
    if (data.empty()) return buffer;  // GL has no storage of no bytes
    glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), 0);
    return buffer;
}

std::uint8_t look_of(model::Tint tint, std::uint8_t layer) {
    return static_cast<std::uint8_t>(static_cast<unsigned>(tint) | (static_cast<unsigned>(layer) << look_tint_bits));
}

// What is drawn of a pose: some of its vertices or points in some order, each with its look.
struct Record {
    std::uint32_t posed;  // which of the pose's
    BakedVertex look;
};

// Pose after pose of `posed`, `per_pose` each, as the records ask for them.
Buffer upload_poses(const std::vector<motion::PosedVertex>& posed, int per_pose, const std::vector<Record>& records) {
    const std::size_t pose_count = posed.size() / static_cast<std::size_t>(per_pose);
    std::vector<BakedVertex> baked;
    baked.reserve(pose_count * records.size());
    for (std::size_t pose = 0; pose < pose_count; ++pose) {
        for (const Record& record : records) {
            baked.push_back(record.look);
            baked.back().posed = posed[pose * static_cast<std::size_t>(per_pose) + record.posed];
        }
    }
    return upload(baked);
}

std::vector<Record> vertex_records(const model::Mesh& mesh) {
    std::vector<Record> records;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const glm::u8vec4 color = mesh.colors[v];
        const std::uint8_t layer = mesh.texture_ids[v] == model::no_texture ? no_layer : mesh.texture_ids[v];
        records.push_back(
            {v, {{}, color.r, color.g, color.b, look_of(mesh.tints[v], layer), glm::packHalf2x16(mesh.uvs[v])}});
    }
    return records;
}

std::uint32_t own_share(model::Tint tint) {
    constexpr std::uint32_t whole = 255;
    return tint == model::Tint::none ? 0 : whole << (8 * (static_cast<unsigned>(tint) - 1));
}

// First the short prefixes with averaged looks, one after the other, then all points with their own: see
// Renderer::first_point.
std::vector<Record> point_records(const pointsample::PointModel& model) {
    // Of a handful of points none may happen to face the camera: these are never dropped for facing away.
    constexpr std::uint32_t longest_two_sided_prefix = 8;
    std::vector<Record> records;
    for (std::uint32_t level = 1; level_points(level) <= longest_averaged_prefix; ++level) {
        if (level_points(level) > model.size()) break;
        const std::uint8_t two_sided = level_points(level) <= longest_two_sided_prefix;
        std::uint32_t point = 0;
        for (const pointsample::PrefixLook& look : pointsample::prefix_looks(model, level_points(level)))
            records.push_back(
                {point++,
                 {{}, look.color.r, look.color.g, look.color.b, two_sided, std::bit_cast<std::uint32_t>(look.tint)}});
    }
    for (std::uint32_t p = 0; p < model.size(); ++p) {
        const glm::u8vec4 color = model.colors[p];
        records.push_back({p, {{}, color.r, color.g, color.b, 0, own_share(model.tints[p])}});
    }
    return records;
}

void add_float(GLuint array, int attribute, int size, GLenum type, bool normalized, std::size_t offset,
               GLuint binding) {
    const auto index = static_cast<GLuint>(attribute);
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribFormat(array, index, size, type, normalized, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array, index, binding);
}

void add_integer(GLuint array, int attribute, int size, GLenum type, std::size_t offset, GLuint binding) {
    const auto index = static_cast<GLuint>(attribute);
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribIFormat(array, index, size, type, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array, index, binding);
}

// Reads people: `vertices` a pose at a time, `instances` a person at a time.
VertexArray make_person_array(const Buffer& vertices, const Buffer& instances) {
    VertexArray array = VertexArray::create();
    const GLuint a = array.name();
    glVertexArrayVertexBuffer(a, vertex_binding, vertices.name(), 0, sizeof(BakedVertex));
    glVertexArrayVertexBuffer(a, instance_binding, instances.name(), 0, sizeof(Instance));
    glVertexArrayBindingDivisor(a, instance_binding, 1);
    add_float(a, attribute_position, 3, GL_UNSIGNED_SHORT, true, 0, vertex_binding);
    add_float(a, attribute_normal, 2, GL_BYTE, true, offsetof(motion::PosedVertex, normal_u), vertex_binding);
    add_float(a, attribute_color, 3, GL_UNSIGNED_BYTE, true, offsetof(BakedVertex, red), vertex_binding);
    add_integer(a, attribute_look, 1, GL_UNSIGNED_BYTE, offsetof(BakedVertex, look), vertex_binding);
    add_float(a, attribute_placement, 4, GL_FLOAT, false, offsetof(Instance, position), instance_binding);
    add_float(a, attribute_turn, 2, GL_SHORT, true, offsetof(Instance, sin_yaw), instance_binding);
    add_integer(a, attribute_palette, 4, GL_UNSIGNED_INT, offsetof(Instance, palette), instance_binding);
    return array;
}

VertexArray make_triangle_array(const Buffer& vertices, const Buffer& indices, const Buffer& instances, bool textured) {
    VertexArray array = make_person_array(vertices, instances);
    if (textured)
        add_float(array.name(), attribute_uv, 2, GL_HALF_FLOAT, false, offsetof(BakedVertex, uv_or_shares),
                  vertex_binding);
    glVertexArrayElementBuffer(array.name(), indices.name());
    return array;
}

VertexArray make_point_array(const Buffer& points, const Buffer& instances) {
    VertexArray array = make_person_array(points, instances);
    add_float(array.name(), attribute_uv, 4, GL_UNSIGNED_BYTE, true, offsetof(BakedVertex, uv_or_shares),
              vertex_binding);
    return array;
}

}  // namespace

Renderer::FigureObjects Renderer::upload_figure(const FigureAssets& assets) const {
    const model::Mesh& mesh = *assets.mesh;
    FigureObjects figure;
    figure.textured = !mesh.textures.empty();
    figure.double_sided = mesh.double_sided;
    if (figure.textured) figure.layers = make_texture_array(mesh.textures);
    figure.vertices = upload_poses(assets.poses->vertices, assets.poses->vertex_count, vertex_records(mesh));
    figure.indices = upload(mesh.indices);
    figure.index_count = static_cast<GLsizei>(mesh.indices.size());
    figure.vertex_count = static_cast<GLuint>(mesh.vertex_count());
    figure.triangle_array = make_triangle_array(figure.vertices, figure.indices, instances_, figure.textured);
    if (assets.poses->point_count > 0) {
        const std::vector<Record> records = point_records(*assets.points);
        figure.points = upload_poses(assets.poses->points, assets.poses->point_count, records);
        figure.point_record_count = static_cast<GLuint>(records.size());
        figure.point_count = static_cast<GLuint>(assets.poses->point_count);
        figure.point_array = make_point_array(figure.points, instances_);
    }
    const motion::Bounds& box = assets.poses->box;
    const float silhouette = 0.25f * assets.poses->area;  // a quarter of the surface, as of any convex body
    const FigureBlock block{glm::vec4(box.min, figure.double_sided ? 1.0f : 0.0f),
                            glm::vec4(box.size(), std::sqrt(silhouette))};
    figure.box = Buffer::create();
    glNamedBufferStorage(figure.box.name(), sizeof block, &block, 0);
    return figure;
}

// Painted triangles and ground have programs of their own, so each sector's indices are parted by surface.
void Renderer::upload_structure(const scene::StaticMesh& structure) {
    std::vector<std::uint32_t> indices;
    indices.reserve(structure.indices.size());
    for (const scene::Surface surface : {scene::Surface::painted, scene::Surface::ground}) {
        std::vector<SectorRange>& ranges = surface == scene::Surface::painted ? painted_ : ground_;
        for (const scene::StaticSector& sector : structure.sectors) {
            const auto first = static_cast<std::uint32_t>(indices.size());
            for (std::uint32_t i = sector.first_index; i < sector.first_index + sector.index_count; i += 3)
                if (structure.vertices[structure.indices[i]].color.a == static_cast<std::uint8_t>(surface))
                    indices.insert(indices.end(),
                                   {structure.indices[i], structure.indices[i + 1], structure.indices[i + 2]});
            const auto count = static_cast<std::uint32_t>(indices.size()) - first;
            if (count > 0) ranges.push_back({sector.box, first, count});
        }
    }
    structure_vertices_ = upload(structure.vertices);
    structure_indices_ = upload(indices);
    structure_array_ = VertexArray::create();
    const GLuint a = structure_array_.name();
    glVertexArrayVertexBuffer(a, vertex_binding, structure_vertices_.name(), 0, sizeof(scene::StaticVertex));
    glVertexArrayElementBuffer(a, structure_indices_.name());
    add_float(a, attribute_static_position, 3, GL_FLOAT, false, offsetof(scene::StaticVertex, position),
              vertex_binding);
    add_float(a, attribute_static_normal, 3, GL_FLOAT, false, offsetof(scene::StaticVertex, normal), vertex_binding);
    add_float(a, attribute_static_color, 4, GL_UNSIGNED_BYTE, true, offsetof(scene::StaticVertex, color),
              vertex_binding);
}

}  // namespace render
