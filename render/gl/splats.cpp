#include "render/gl/splats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "figures/splats.h"
#include "render/gl/program.h"
#include "render/gl/upload.h"
#include "render/native/far_looks.h"
#include "render/native/splat_model.h"
#include "shaders/layout.h"

namespace render::gl {

namespace {

static_assert(far_rings == native::rings && far_nodes == native::ring_nodes && far_suns == native::sun_azimuths);

constexpr GLuint person_binding = 0, key_binding = 1;

// Of one person, for as long as they stay where they are.
struct FarVertex {
    glm::vec3 center;
    float side;
    Turn turn;
    std::uint8_t character;
    scene::Palette palette;
};

// As the shader reads them: [key][ring][slot][sun][node] of four values.
std::vector<float> texels_of(const native::FarLooks& looks, const motion::PoseTable& poses) {
    constexpr std::size_t values = native::far_row_values;
    const std::size_t keys = looks.rows.size() / (values * native::far_key_rows);
    const float silhouette = looks.largest_silhouette / poses.area;
    std::vector<float> texels;
    texels.reserve(looks.rows.size());
    for (std::size_t key = 0; key < keys; ++key)
        for (std::size_t ring = 0; ring < far_rings; ++ring)
            for (std::size_t slot = 0; slot < slot_count; ++slot)
                for (std::size_t sun = 0; sun < far_suns; ++sun)
                    for (std::size_t node = 0; node < native::far_ring_rows; ++node) {
                        const std::size_t row = key * native::far_key_rows + sun * native::far_sun_rows +
                                                ring * native::far_ring_rows + node;
                        for (std::size_t value = 0; value < 4; ++value) {
                            const bool is_silhouette = slot + 1 == slot_count && value == 3;
                            const float share = looks.rows[values * row + 4 * slot + value] / 32767.0f;
                            texels.push_back(share * native::far_color_share * (is_silhouette ? silhouette : 1.0f));
                        }
                    }
    return texels;
}

}  // namespace

FarDrawer::FarDrawer(std::span<const figures::Figure> figures, const scene::Light& light)
    : figures_(figures.begin(), figures.end()),
      light_(light),
      program_(build_program("person_splats.vert", "person_splats.frag")) {}

void FarDrawer::draw(const Frame& frame) {
    if (frame.far_blocks.empty()) return;
    if (looks_.name() == 0) look_at_figures();
    if (frame.far_people.crowd != crowd_) upload_crowd(frame.far_people);
    // A fresh store each frame: the device may still be reading the last one.
    glNamedBufferData(keys_.name(), static_cast<GLsizeiptr>(crowd_->size()), frame.far_people.keys, GL_STREAM_DRAW);
    glUseProgram(program_.name());
    glBindTextureUnit(texture_unit_looks, looks_.name());
    glBindVertexArray(array_.name());
    const std::span<const FarBlock> all = frame.far_blocks;
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        const glm::dvec3& origin = origin_of(all[first]);
        while (end < all.size() && origin_of(all[end]) == origin) ++end;
        draw_from(glm::vec3(frame.view.position - origin), all.subspan(first, end - first));
    }
}

const glm::dvec3& FarDrawer::origin_of(const FarBlock& block) const {
    return crowd_->blocks[block.block].origin;
}

void FarDrawer::draw_from(glm::vec3 eye, std::span<const FarBlock> blocks) {
    first_.clear();
    count_.clear();
    for (const FarBlock& block : blocks) {
        first_.push_back(static_cast<GLint>(crowd_->blocks[block.block].first));
        count_.push_back(static_cast<GLsizei>(crowd_->blocks[block.block].count));
    }
    glUniform3f(uniform_far_eye, eye.x, eye.y, eye.z);
    glMultiDrawArrays(GL_POINTS, first_.data(), count_.data(), static_cast<GLsizei>(first_.size()));
}

void FarDrawer::look_at_figures() {
    std::vector<std::vector<float>> layers;
    std::size_t largest = 0;
    for (const figures::Figure& figure : figures_) {
        if (figures::splat_levels(figure).empty()) {  // nobody of it is ever in a far block
            layers.emplace_back();
            continue;
        }
        const native::FarLooks looks(figure, native::SplatModel(figure, light_));
        layers.push_back(texels_of(looks, *figure.poses));
        largest = std::max(largest, layers.back().size());
    }
    constexpr GLsizei width = slot_count * far_suns * native::far_ring_rows;
    const auto height = static_cast<GLsizei>(largest / (4 * width));
    looks_ = TextureObject::create(GL_TEXTURE_2D_ARRAY);
    glTextureStorage3D(looks_.name(), 1, GL_RGBA16F, width, height, static_cast<GLsizei>(layers.size()));
    for (std::size_t layer = 0; layer < layers.size(); ++layer)
        glTextureSubImage3D(looks_.name(), 0, 0, 0, static_cast<GLint>(layer), width,
                            static_cast<GLsizei>(layers[layer].size() / (4 * width)), 1, GL_RGBA, GL_FLOAT,
                            layers[layer].data());
    glTextureParameteri(looks_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(looks_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void FarDrawer::upload_crowd(const FarPeople& people) {
    crowd_ = people.crowd;
    std::vector<glm::vec3> centers;
    for (const figures::Figure& figure : figures_) centers.push_back(native::far_shape(*figure.poses).center);
    std::vector<FarVertex> vertices(crowd_->size());
    for (std::size_t person = 0; person < vertices.size(); ++person) {
        const std::uint8_t character = crowd_->character[person];
        const motion::PoseTable& poses = *figures_[character].poses;
        const float scale = crowd_->height[person] / poses.rest_height;
        const float sine = people.turns[person].sin_yaw / 32767.0f, cosine = people.turns[person].cos_yaw / 32767.0f;
        const glm::vec3 c = scale * centers[character];
        const glm::vec3 turned(cosine * c.x + sine * c.z, c.y, cosine * c.z - sine * c.x);
        vertices[person] = {crowd_->position[person] + turned, scale * std::sqrt(poses.area), people.turns[person],
                            character, crowd_->palette[person]};
    }
    people_ = upload<FarVertex>(vertices);
    keys_ = Buffer::create();
    array_ = VertexArray::create();
    const GLuint a = array_.name();
    glVertexArrayVertexBuffer(a, person_binding, people_.name(), 0, sizeof(FarVertex));
    glVertexArrayVertexBuffer(a, key_binding, keys_.name(), 0, 1);
    add_float(a, attribute_far_center, 4, GL_FLOAT, false, offsetof(FarVertex, center), person_binding);
    add_float(a, attribute_far_turn, 2, GL_SHORT, true, offsetof(FarVertex, turn), person_binding);
    add_integer(a, attribute_far_character, 1, GL_UNSIGNED_BYTE, offsetof(FarVertex, character), person_binding);
    for (int slot = 0; slot < slot_count; ++slot)
        add_float(a, attribute_far_palette + slot, 4, GL_UNSIGNED_BYTE, true,
                  offsetof(FarVertex, palette) + sizeof(glm::u8vec4) * static_cast<std::size_t>(slot), person_binding);
    add_integer(a, attribute_far_key, 1, GL_UNSIGNED_BYTE, 0, key_binding);
}

}  // namespace render::gl
