#include "tests/reference/harlequin.h"

#include <array>
#include <cmath>
#include <utility>

namespace reference {

namespace {

using model::no_slot;
using model::Slot;

enum Node : std::uint16_t { root, chest, mirrored };

// How one part looks and what carries it.
struct Part {
    glm::vec3 center, half;  // [m]
    Node lower = root, upper = root;
    std::uint16_t material = 0;  // plain, then one a texture
    bool dyed = false;           // in slots
};

void add_vertex(model::Mesh& mesh, const Part& part, glm::vec3 position, glm::vec3 normal, glm::vec2 uv,
                glm::u8vec4 color, Slot slot) {
    const float share = 0.5f + 0.5f * (position.y - part.center.y) / part.half.y;
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
    mesh.colors.push_back(color);
    mesh.slots.push_back(slot);
    mesh.material_ids.push_back(part.material);
    mesh.joints.push_back({part.lower, part.upper, 0, 0});
    mesh.weights.push_back({1 - share, share, 0, 0});
}

void add_box(model::Mesh& mesh, const Part& part) {
    const auto own = static_cast<std::uint8_t>(mesh.vertex_count());  // no two parts have the same colours
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0), right(0), up(0);
            normal[axis] = side;
            right[(axis + 1) % 3] = 1;
            up = glm::cross(normal, right);
            const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
            const int face = 2 * axis + (side > 0);
            // Every face in the next slot, the first in none.
            const Slot slot = part.dyed ? static_cast<Slot>(face % (1 + model::slot_count)) : no_slot;
            const auto shade = static_cast<std::uint8_t>(90 + 30 * face);
            for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                const glm::vec3 position = part.center + part.half * (normal + corner.x * right + corner.y * up);
                add_vertex(mesh, part, position, normal, 0.5f + 0.45f * corner + 0.3f * static_cast<float>(face),
                           {shade, static_cast<std::uint8_t>(250 - shade + own % 5),
                            static_cast<std::uint8_t>(120 + own % 100), 255},
                           slot);
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
            if (part.lower == mirrored)
                for (std::size_t i = mesh.indices.size() - 6; i < mesh.indices.size(); i += 3)
                    std::swap(mesh.indices[i], mesh.indices[i + 1]);
        }
    }
}

// A wavy flag to the left of the body, textured in its lower half.
void add_sheet(model::Mesh& mesh) {
    constexpr int cells = 6;
    const Part plain{{-0.75f, 1.0f, 0}, {0.35f, 0.45f, 0}, chest, chest};
    Part textured = plain;
    textured.material = 2;
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
            for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                const glm::vec2 at = glm::vec2(i + di, j + dj) / static_cast<float>(cells);
                const float wave = 3 * at.x + at.y;
                const glm::vec3 position =
                    plain.center +
                    glm::vec3(plain.half.x * (2 * at.x - 1), plain.half.y * (2 * at.y - 1), 0.08f * std::sin(wave));
                const glm::vec3 normal = glm::normalize(glm::vec3(-0.08f * 3 / (2 * plain.half.x) * std::cos(wave),
                                                                  -0.08f / (2 * plain.half.y) * std::cos(wave), 1));
                const bool lower = j < cells / 2;
                add_vertex(mesh, lower ? textured : plain, position, normal, at,
                           {230, static_cast<std::uint8_t>(60 + 25 * i), static_cast<std::uint8_t>(60 + 25 * j), 255},
                           lower ? no_slot : Slot{3});
            }
            for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
        }
    }
}

// No two texels of a row alike, and none of a column.
model::Texture make_texture(int width, int height, glm::ivec3 step) {
    model::Texture texture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            texture.texels.emplace_back(70 + (step.x * x + 11 * y) % 180, 70 + (step.y * y + 23 * x) % 180,
                                        70 + (step.z * (x + 2 * y)) % 180, 255);
    return texture;
}

glm::quat turn(float angle, glm::vec3 axis) {
    const glm::vec3 v = std::sin(angle / 2) * glm::normalize(axis);
    return {std::cos(angle / 2), v.x, v.y, v.z};
}

void add_keys(model::Channel& channel, float time, std::initializer_list<float> values) {
    channel.times.push_back(time);
    channel.values.insert(channel.values.end(), values);
}

model::Clip stand() {
    model::Clip clip{"stand", 1.0, {}};
    model::Channel bend{chest, model::Path::rotation, model::Interpolation::linear, {}, {}};
    for (const float t : {0.0f, 0.5f, 1.0f}) {
        const glm::quat q = turn(0.2f + 0.9f * t, {0.3f, 1.0f, 0.6f});
        add_keys(bend, t, {q.x, q.y, q.z, q.w});
    }
    model::Channel swell{root, model::Path::morph_weights, model::Interpolation::linear, {}, {}};
    add_keys(swell, 0, {0.1f});
    add_keys(swell, 1, {0.9f});
    clip.channels = {bend, swell};
    return clip;
}

model::Clip leap() {
    model::Clip clip{"leap", 0.4, {}};
    model::Channel rise{root, model::Path::translation, model::Interpolation::cubic_spline, {}, {}};
    add_keys(rise, 0, {0, 0, 0, 0, 0, 0, 0.4f, 2, 0});
    add_keys(rise, 0.4f, {-0.5f, -1, 0, 0.1f, 0.4f, -0.1f, 0, 0, 0});
    model::Channel stretch{mirrored, model::Path::scale, model::Interpolation::step, {}, {}};
    add_keys(stretch, 0, {-1, 1, 1});
    add_keys(stretch, 0.2f, {-1.3f, 0.8f, 1.1f});
    const glm::quat from = turn(-0.8f, {1, 0, 0}), to = turn(0.6f, {1, 0.2f, 0});
    model::Channel bend{chest, model::Path::rotation, model::Interpolation::linear, {}, {}};
    add_keys(bend, 0, {from.x, from.y, from.z, from.w});
    add_keys(bend, 0.4f, {to.x, to.y, to.z, to.w});
    clip.channels = {rise, stretch, bend};
    return clip;
}

}  // namespace

model::Character make_harlequin(bool open) {
    model::Character harlequin;
    harlequin.name = open ? "open harlequin" : "harlequin";
    model::Mesh& mesh = harlequin.mesh;
    mesh.textures = {make_texture(8, 8, {37, 53, 29}), make_texture(24, 10, {61, 17, 43})};
    if (open) std::swap(mesh.textures[0], mesh.textures[1]);  // nor do two harlequins share theirs
    mesh.materials.resize(3);
    mesh.materials[1].texture = 0;
    mesh.materials[2].texture = 1;
    mesh.materials[2].double_sided = open;
    add_box(mesh, {{0, 0.9f, 0}, {0.28f, 0.45f, 0.17f}, root, chest, 0, true});
    add_box(mesh, {{0.05f, 1.55f, 0.05f}, {0.14f, 0.18f, 0.16f}, chest, chest, 1});
    add_box(mesh, {{0.45f, 1.1f, 0.1f}, {0.12f, 0.35f, 0.1f}, chest, chest, 2});
    add_box(mesh, {{0.12f, 0.2f, 0}, {0.09f, 0.2f, 0.2f}, mirrored, mirrored});
    add_box(mesh, {{0.12f, 0.2f, 0}, {0.09f, 0.2f, 0.12f}, root, root});
    if (open) add_sheet(mesh);

    model::MorphTarget belly;
    belly.node = root;
    for (std::size_t v = 0; v < 24; ++v) {  // the first box
        belly.position_offsets.push_back(0.12f * mesh.normals[v]);
        belly.normal_offsets.push_back({0, 0.6f, 0.2f});
    }
    mesh.morphs.push_back(belly);

    model::Skeleton& skeleton = harlequin.skeleton;
    skeleton.nodes.resize(3);
    skeleton.nodes[chest].parent = root;
    skeleton.nodes[chest].rest.translation = {0, 1, 0};
    skeleton.nodes[chest].rest_matrix[3] = {0, 1, 0, 1};
    skeleton.nodes[mirrored].parent = root;
    skeleton.nodes[mirrored].rest.scale = {-1, 1, 1};
    skeleton.nodes[mirrored].rest_matrix[0] = {-1, 0, 0, 0};
    for (int node = 0; node < 3; ++node) skeleton.palette.push_back({node, glm::mat4(1)});
    skeleton.palette[chest].inverse_bind[3] = {0, -1, 0, 1};
    harlequin.clips = {stand(), leap()};
    return harlequin;
}

model::Character make_masked_harlequin() {
    model::Character harlequin = make_harlequin(true);
    harlequin.name = "masked harlequin";
    model::Mesh& mesh = harlequin.mesh;
    using enum model::Wrap;
    mesh.materials[1].sampler = {mirror, clamp, false};
    mesh.materials[2].sampler = {clamp, repeat, true};
    for (const std::size_t material : {1u, 2u}) mesh.materials[material].alpha_cutoff = 0.5f;
    for (model::Texture& texture : mesh.textures)  // a hole
        for (int y = texture.height / 4; y < texture.height / 2; ++y)
            for (int x = texture.width / 4; x < texture.width * 3 / 4; ++x)
                texture.texels[static_cast<std::size_t>(y) * texture.width + x].a = 0;
    return harlequin;
}

model::Character make_leaning_harlequin() {
    model::Character character = make_harlequin(true);
    for (model::Material& material : character.mesh.materials) material.double_sided = true;
    for (glm::vec3& normal : character.mesh.normals) normal = glm::normalize(normal + glm::vec3(1.2f, 0, 0));
    return character;
}

}  // namespace reference
