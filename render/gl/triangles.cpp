// figures/triangles.h by indexed triangles.
#include <algorithm>
#include <array>
#include <glm/gtc/packing.hpp>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/own_light.h"
#include "render/gl/baked_vertex.h"
#include "render/gl/figure_drawer.h"
#include "render/gl/program.h"
#include "render/gl/texture_array.h"
#include "render/gl/upload.h"
#include "shaders/layout.h"

namespace render::gl {

namespace {

static_assert(slot_count == model::slot_count && slot_count < 1 << look_slot_bits);

// As shaders/layout.h has it.
struct Texturing {
    glm::vec4 base, emission;

    bool operator==(const Texturing&) const = default;
};
static_assert(sizeof(Texturing) == 2 * sizeof(glm::vec4));

struct Objects {
    Buffer vertices, indices;
    VertexArray array;
    TextureObject layers;  // none if the character has no textures
    GLuint vertex_count = 0;
    Buffer alphas;  // none without texturings
    // What materials differ in, if it is more than their texture (shaders/texturing.glsl).
    std::vector<Texturing> texturings;
    bool double_sided = false, textured = false;
};

std::uint8_t look_of(model::Slot slot, std::uint8_t layer) {
    return static_cast<std::uint8_t>(static_cast<unsigned>(slot) | (static_cast<unsigned>(layer) << look_slot_bits));
}

std::uint8_t layer_of(std::uint8_t texture) {
    return texture == model::no_texture ? no_layer : texture;
}

// What draws a texture as most characters have it won't do.
bool needs_texturing(const model::Material& material) {
    return material.alpha_cutoff > 0 || model::has_own_light(material) ||
           (material.texture != model::no_texture && material.sampler != model::Sampler{});
}

Texturing texturing_of(const model::Material& material) {
    static_assert(wrap_repeat == static_cast<int>(model::Wrap::repeat) &&
                  wrap_mirror == static_cast<int>(model::Wrap::mirror) &&
                  wrap_clamp == static_cast<int>(model::Wrap::clamp));
    const std::uint8_t emissive = model::emits(material) ? material.emissive_texture : model::no_texture;
    const bool textured = material.texture != model::no_texture || emissive != model::no_texture;
    const model::Sampler sampler = textured ? material.sampler : model::Sampler{};
    const glm::vec3 emission = model::emission_of(material);
    return {{layer_of(material.texture), static_cast<int>(sampler.across) + 4 * static_cast<int>(sampler.down),
             (sampler.nearest ? texturing_nearest : 0) | (material.unlit ? texturing_unlit : 0), material.alpha_cutoff},
            {emission * emission, layer_of(emissive)}};
}

// For each material the number of its texturing, which is added where it is new. Beyond as many as there may be, the
// first of the same texture serves.
std::vector<std::uint8_t> number_texturings(const model::Mesh& mesh, std::vector<Texturing>& texturings) {
    std::vector<std::uint8_t> numbers;
    for (const model::Material& material : mesh.materials) {
        const Texturing wanted = texturing_of(material);
        auto place = std::ranges::find(texturings, wanted);
        if (place == texturings.end() && texturings.size() < texturing_count)
            place = texturings.insert(place, wanted);
        else if (place == texturings.end())
            place = std::ranges::find(texturings, wanted.base.x, [](const Texturing& known) { return known.base.x; });
        numbers.push_back(place == texturings.end() ? 0 : static_cast<std::uint8_t>(place - texturings.begin()));
    }
    return numbers;
}

// `layers`: of each material, what goes into a look.
std::vector<Record> records_of(const model::Mesh& mesh, const std::vector<std::uint8_t>& layers) {
    std::vector<Record> records;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const glm::u8vec4 color = mesh.colors[v];
        const std::uint8_t layer = layers[mesh.material_ids[v]];
        records.push_back(
            {v, {{}, color.r, color.g, color.b, look_of(mesh.slots[v], layer), {glm::packHalf2x16(mesh.uvs[v])}}});
    }
    return records;
}

Buffer upload_alphas(const model::Mesh& mesh, std::size_t poses) {
    std::vector<std::uint8_t> alphas;
    alphas.reserve(poses * mesh.vertex_count());
    for (std::size_t pose = 0; pose < poses; ++pose)
        for (const glm::u8vec4& color : mesh.colors) alphas.push_back(color.a);
    return upload<std::uint8_t>(alphas);
}

class TriangleDrawer final : public FigureDrawer {
public:
    void add(const figures::Figure& figure, const Buffer& instances) override {
        const model::Mesh& mesh = *figure.mesh;
        Objects& objects = objects_.emplace_back();
        const bool has_texturings = std::ranges::any_of(mesh.materials, needs_texturing);
        objects.textured = !mesh.textures.empty() || has_texturings;
        objects.double_sided = mesh.double_sided();
        const model::Texture white{1, 1, {glm::u8vec4(255)}};  // for cutouts by vertices alone
        if (objects.textured)
            objects.layers =
                make_texture_array(mesh.textures.empty() ? std::span(&white, 1) : std::span(mesh.textures));
        std::vector<std::uint8_t> layers;
        if (has_texturings)
            layers = number_texturings(mesh, objects.texturings);
        else
            std::ranges::transform(mesh.materials, std::back_inserter(layers), layer_of, &model::Material::texture);
        objects.vertices = upload_poses(figure.poses->vertices, figure.poses->vertex_count, records_of(mesh, layers));
        objects.indices = upload<std::uint32_t>(mesh.indices);
        objects.vertex_count = static_cast<GLuint>(mesh.vertex_count());
        objects.array = make_person_array(objects.vertices, instances, objects.textured ? Extra::uv : Extra::nothing);
        if (has_texturings) {
            objects.alphas = upload_alphas(mesh, static_cast<std::size_t>(figure.poses->pose_count));
            add_alphas(objects.array, objects.alphas);
        }
        glVertexArrayElementBuffer(objects.array.name(), objects.indices.name());
        build(objects);
    }

    void append_command(const Batch& batch, std::vector<std::uint32_t>& words) const override {
        words.insert(words.end(), {batch.count, batch.instance_count, batch.first,
                                   batch.pose * objects_[batch.character].vertex_count, batch.first_instance});
    }

    bool draws_points() const override { return false; }

    void draw(std::uint32_t character, std::uintptr_t offset, GLsizei count) const override {
        const Objects& objects = objects_[character];
        if (objects.double_sided) glDisable(GL_CULL_FACE);
        if (objects.textured) glBindTextureUnit(texture_unit_layers, objects.layers.name());
        glUseProgram(programs_[program_number(objects)]->name());
        if (!objects.texturings.empty())
            glUniform4fv(uniform_texturings, 2 * static_cast<GLsizei>(objects.texturings.size()),
                         &objects.texturings.front().base.x);
        glBindVertexArray(objects.array.name());
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset), count, 0);
        glEnable(GL_CULL_FACE);
    }

private:
    // By textured, with texturings, double-sided.
    static std::size_t program_number(const Objects& objects) {
        return (objects.textured ? 1 : 0) + (objects.texturings.empty() ? 0 : 1) + (objects.double_sided ? 3 : 0);
    }

    void build(const Objects& objects) {
        std::optional<Program>& program = programs_[program_number(objects)];
        if (program) return;
        std::vector<std::string_view> defines;
        if (objects.textured) defines.emplace_back("TEXTURED");
        if (!objects.texturings.empty()) defines.emplace_back("MATERIALS");
        if (objects.double_sided) defines.emplace_back("TWO_SIDED");
        program = build_program("person_triangles.vert", "person_triangles.frag", defines);
    }

    std::array<std::optional<Program>, 6> programs_;  // null: nobody is drawn by it
    std::vector<Objects> objects_;
};

}  // namespace

std::unique_ptr<FigureDrawer> make_triangle_drawer() {
    return std::make_unique<TriangleDrawer>();
}

}  // namespace render::gl
