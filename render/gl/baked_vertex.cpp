#include "render/gl/baked_vertex.h"

#include <algorithm>

#include "render/frame.h"
#include "render/gl/upload.h"

namespace render::gl {

namespace {

static_assert(offsetof(BakedVertex, red) == 8 && offsetof(BakedVertex, look) == 11 &&
              offsetof(BakedVertex, extra) == 12);
static_assert(offsetof(motion::PosedVertex, normal_u) == 6);

constexpr GLuint vertex_binding = 0;
constexpr GLuint instance_binding = 1;
constexpr GLuint few_binding = 2;

}  // namespace

Buffer upload_poses(std::span<const motion::PosedVertex> posed, int per_pose, std::span<const Record> records) {
    const std::size_t pose_count = posed.size() / static_cast<std::size_t>(per_pose);
    std::vector<BakedVertex> baked;
    baked.reserve(pose_count * records.size());
    for (std::size_t pose = 0; pose < pose_count; ++pose) {
        for (const Record& record : records) {
            baked.push_back(record.look);
            baked.back().posed = posed[pose * static_cast<std::size_t>(per_pose) + record.posed];
        }
    }
    return upload<BakedVertex>(baked);
}

VertexArray make_person_array(const Buffer& vertices, const Buffer& instances, Extra extra) {
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
    add_float(a, attribute_turn, 2, GL_SHORT, true, offsetof(Instance, turn), instance_binding);
    for (int i = 0; i < slot_vectors; ++i)
        add_integer(a, attribute_palette + i, std::min(4, slot_count - 4 * i), GL_UNSIGNED_INT,
                    offsetof(Instance, palette) + i * sizeof(glm::uvec4), instance_binding);
    if (extra == Extra::uv)
        add_float(a, attribute_uv, 2, GL_HALF_FLOAT, false, offsetof(BakedVertex, extra), vertex_binding);
    if (extra == Extra::shares)
        for (int i = 0; i < slot_vectors; ++i)
            add_float(a, attribute_shares + i, 4, GL_UNSIGNED_BYTE, true,
                      offsetof(BakedVertex, extra) + i * sizeof(glm::u8vec4), vertex_binding);
    return array;
}

void add_alphas(const VertexArray& array, const Buffer& alphas) {
    glVertexArrayVertexBuffer(array.name(), few_binding, alphas.name(), 0, 1);
    add_float(array.name(), attribute_alpha, 1, GL_UNSIGNED_BYTE, true, 0, few_binding);
}

void add_own_lights(const VertexArray& array, const Buffer& own_lights) {
    glVertexArrayVertexBuffer(array.name(), few_binding, own_lights.name(), 0, sizeof(glm::u8vec4));
    add_float(array.name(), attribute_own_light, 4, GL_UNSIGNED_BYTE, true, 0, few_binding);
}

}  // namespace render::gl
