// figures/triangles.h by indexed triangles.
#include <glm/gtc/packing.hpp>

#include "render/gl/baked_vertex.h"
#include "render/gl/figure_drawer.h"
#include "render/gl/program.h"
#include "render/gl/texture_array.h"
#include "render/gl/upload.h"
#include "shaders/layout.h"

namespace render::gl {

namespace {

static_assert(slot_count == model::slot_count && slot_count < 1 << look_slot_bits);

struct Objects {
    Buffer vertices, indices;
    VertexArray array;
    TextureObject layers;  // none if the character has no textures
    GLuint vertex_count = 0;
    bool double_sided = false, textured = false;
};

std::uint8_t look_of(model::Slot slot, std::uint8_t layer) {
    return static_cast<std::uint8_t>(static_cast<unsigned>(slot) | (static_cast<unsigned>(layer) << look_slot_bits));
}

std::vector<Record> records_of(const model::Mesh& mesh) {
    std::vector<Record> records;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const glm::u8vec4 color = mesh.colors[v];
        const std::uint8_t texture = mesh.material_of(v).texture;
        const std::uint8_t layer = texture == model::no_texture ? no_layer : texture;
        records.push_back(
            {v, {{}, color.r, color.g, color.b, look_of(mesh.slots[v], layer), {glm::packHalf2x16(mesh.uvs[v])}}});
    }
    return records;
}

class TriangleDrawer final : public FigureDrawer {
public:
    TriangleDrawer()
        : program_(build_program("person_triangles.vert", "person_triangles.frag")),
          textured_program_(build_program("person_triangles.vert", "person_triangles.frag", {"TEXTURED"})) {}

    void add(const figures::Figure& figure, const Buffer& instances) override {
        const model::Mesh& mesh = *figure.mesh;
        Objects& objects = objects_.emplace_back();
        objects.textured = !mesh.textures.empty();
        objects.double_sided = mesh.double_sided();
        if (objects.textured) objects.layers = make_texture_array(mesh.textures);
        objects.vertices = upload_poses(figure.poses->vertices, figure.poses->vertex_count, records_of(mesh));
        objects.indices = upload<std::uint32_t>(mesh.indices);
        objects.vertex_count = static_cast<GLuint>(mesh.vertex_count());
        objects.array = make_person_array(objects.vertices, instances, objects.textured ? Extra::uv : Extra::nothing);
        glVertexArrayElementBuffer(objects.array.name(), objects.indices.name());
    }

    void append_command(const Batch& batch, std::vector<std::uint32_t>& words) const override {
        words.insert(words.end(), {batch.count, batch.instance_count, batch.first,
                                   batch.pose * objects_[batch.character].vertex_count, batch.first_instance});
    }

    void draw(std::uint32_t character, std::uintptr_t offset, GLsizei count) const override {
        const Objects& objects = objects_[character];
        if (objects.double_sided) glDisable(GL_CULL_FACE);
        if (objects.textured) glBindTextureUnit(texture_unit_layers, objects.layers.name());
        glUseProgram(objects.textured ? textured_program_.name() : program_.name());
        glBindVertexArray(objects.array.name());
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset), count, 0);
        glEnable(GL_CULL_FACE);
    }

private:
    Program program_, textured_program_;
    std::vector<Objects> objects_;
};

}  // namespace

std::unique_ptr<FigureDrawer> make_triangle_drawer() {
    return std::make_unique<TriangleDrawer>();
}

}  // namespace render::gl
