// Compressed glTF: the same mesh as without, or refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <stdexcept>

#include "tests/model/draco_packer.h"
#include "tests/model/gltf_packer.h"

namespace {

using tests::GltfBuilder;
using tests::json;

model::Character load_glb(const std::string& bytes) {
    const tests::TemporaryFolder folder;
    return model::load_gltf(folder.write("a.glb", bytes));
}

std::string complaint(const std::string& bytes) {
    try {
        load_glb(bytes);
    } catch (const std::runtime_error& error) {
        const std::string said = error.what();
        EXPECT_LT(said.size(), 300u) << said;
        return said.substr(said.find("a.glb"));
    }
    ADD_FAILURE() << "it was read";
    return {};
}

bool contains(const std::string& text, const std::string& part) {
    if (text.find(part) == std::string::npos) ADD_FAILURE() << text << " lacks " << part;
    return text.find(part) != std::string::npos;
}

// The vertex of `mesh` that is nearest to `other`'s vertex, by position and texture coordinates.
std::size_t nearest(const model::Mesh& mesh, const model::Mesh& other, std::size_t vertex) {
    std::size_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const float away =
            glm::distance(mesh.positions[i], other.positions[vertex]) + glm::distance(mesh.uvs[i], other.uvs[vertex]);
        if (away < least) best = i;
        least = std::min(least, away);
    }
    return best;
}

using Triangle = std::array<std::size_t, 3>;

// The triangles by `vertices`, each from its lowest vertex on, sorted.
std::vector<Triangle> sorted_triangles(const model::Mesh& mesh, const std::vector<std::size_t>& vertices) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        Triangle& triangle = triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = vertices[mesh.indices[i + k]];
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

// The same surface and all on it, whatever the order of vertices and triangles.
void expect_same(const model::Mesh& mesh, const model::Mesh& plain, float tolerance) {
    std::vector<std::size_t> to_plain(mesh.vertex_count()), itself(plain.vertex_count());
    for (std::size_t i = 0; i < itself.size(); ++i) itself[i] = i;
    for (std::size_t i = 0; i < to_plain.size(); ++i) {
        const std::size_t at = to_plain[i] = nearest(plain, mesh, i);
        ASSERT_LE(glm::distance(mesh.positions[i], plain.positions[at]), tolerance);
        ASSERT_LE(glm::distance(mesh.normals[i], plain.normals[at]), tolerance);
        ASSERT_LE(glm::distance(mesh.uvs[i], plain.uvs[at]), tolerance);
        ASSERT_LE(glm::distance(glm::vec4(mesh.colors[i]), glm::vec4(plain.colors[at])), 1000 * tolerance);
        ASSERT_EQ(mesh.joints[i], plain.joints[at]);
        ASSERT_LE(glm::distance(mesh.weights[i], plain.weights[at]), tolerance);
    }
    EXPECT_EQ(sorted_triangles(mesh, to_plain), sorted_triangles(plain, itself));
}

TEST(GltfPacked, MeshoptIsReadAsItWas) {
    for (const GltfBuilder& plain : {tests::make_square(), tests::make_everything(), tests::make_barrel()}) {
        const model::Character expected = tests::load(plain);
        for (const char* mode : {"TRIANGLES", "INDICES"}) {
            for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
                const model::Character got = load_glb(tests::packed_glb(tests::pack_meshopt(plain, mode, name)));
                expect_same(got.mesh, expected.mesh, 0);
                EXPECT_EQ(got.mesh.morphs.size(), expected.mesh.morphs.size());
                EXPECT_EQ(got.clips.size(), expected.clips.size());
            }
        }
    }
}

TEST(GltfPacked, MeshoptFiltersOfVerticesAreUndone) {
    const model::Mesh expected = tests::load(tests::make_barrel()).mesh;
    const tests::MeshoptFilter short_normals{"OCTAHEDRAL", 8, meshopt_encodeFilterOct, 16};
    const tests::MeshoptFilter byte_normals{"OCTAHEDRAL", 4, meshopt_encodeFilterOct, 8};
    for (const tests::MeshoptFilter& normals : {short_normals, byte_normals}) {
        GltfBuilder builder = tests::make_barrel();
        const json attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
        tests::filter_accessor(builder, attributes["POSITION"], 3, {"EXPONENTIAL", 12, meshopt_encodeFilterExp, 22});
        tests::filter_accessor(builder, attributes["NORMAL"], 3, normals);
        expect_same(load_glb(tests::packed_glb(builder)).mesh, expected, normals.stride == 4 ? 0.03f : 1e-4f);
    }
}

TEST(GltfPacked, MeshoptFiltersOfRotationsAreUndone) {
    GltfBuilder plain = tests::make_barrel();
    json& clip = plain.document["animations"][0];
    clip["channels"][0]["target"]["path"] = "rotation";
    const int rotations = plain.vec4({0, 0, 0, 1, 0.6f, 0, 0, 0.8f, 0, 0.5f, -0.5f, 0.70710678f});
    clip["samplers"][0]["output"] = rotations;
    GltfBuilder filtered = plain;
    tests::filter_accessor(filtered, rotations, 4, {"QUATERNION", 8, meshopt_encodeFilterQuat, 16});
    const model::Clip expected = tests::load(plain).clips.at(0);
    const model::Clip got = load_glb(tests::packed_glb(filtered)).clips.at(0);
    ASSERT_EQ(got.channels.size(), 1u);
    const std::vector<float>&values = got.channels[0].values, &wanted = expected.channels[0].values;
    ASSERT_EQ(values.size(), wanted.size());
    for (std::size_t i = 0; i < values.size(); i += 4) {
        const glm::vec4 a(values[i], values[i + 1], values[i + 2], values[i + 3]),
            b(wanted[i], wanted[i + 1], wanted[i + 2], wanted[i + 3]);
        EXPECT_NEAR(std::abs(glm::dot(a, b)), 1, 1e-3);
        EXPECT_LT(glm::distance(a, glm::dot(a, b) < 0 ? -b : b), 1e-3f);
    }
}

TEST(GltfPacked, AFallbackBufferThatNothingNeedsIsNoError) {
    EXPECT_EQ(load_glb(tests::packed_glb(tests::make_square())).mesh.triangle_count(), 2u);
}

TEST(GltfPacked, WrongMeshoptIsRefusedByName) {
    const struct {
        const char *key, *said;
        json value;
    } cases[] = {{"buffer", "buffer 7", 7},
                 {"buffer", "without 'buffer'", -1},
                 {"byteOffset", "beyond the end", 1 << 30},
                 {"byteLength", "beyond the end", 1 << 30},
                 {"byteLength", "damaged", 20},
                 {"count", "damaged", 80},
                 {"count", "what they can hold", 2147483647},
                 {"count", "without 'count'", "4"},
                 {"byteStride", "stride of 0", 0},
                 {"byteStride", "stride of 13", 13},
                 {"byteStride", "stride of 260", 260},
                 {"mode", "mode 'POINTS'", "POINTS"},
                 {"mode", "without mode", nullptr},
                 {"mode", "stride of 12", "TRIANGLES"},
                 {"mode", "stride of 12", "INDICES"},
                 {"filter", "filter 'COLOR'", "COLOR"},
                 {"filter", "stride of 12", "OCTAHEDRAL"},
                 {"filter", "stride of 12", "QUATERNION"}};
    for (const auto& wrong : cases) {
        GltfBuilder builder = tests::pack_meshopt(tests::make_square(), "TRIANGLES");
        json& view = builder.document["bufferViews"][0];
        view["extensions"]["EXT_meshopt_compression"][wrong.key] = wrong.value;
        contains(complaint(tests::packed_glb(builder)), wrong.said);
    }
}

// One view of little data that unfolds to much, again and again.
TEST(GltfPacked, MeshoptThatUnfoldsToTooMuchIsRefused) {
    GltfBuilder builder = tests::make_square();
    constexpr std::size_t count = 8192, stride = 256;
    const std::vector<char> zeros(count * stride, '\0');
    const tests::PackedData packed = tests::pack_attributes(zeros.data(), count, stride);
    const int view = builder.add_view("");
    tests::replace_view(builder, view, packed, "EXT_meshopt_compression");
    json& views = builder.document["bufferViews"];
    const json one = views[static_cast<std::size_t>(view)];
    EXPECT_EQ(load_glb(tests::packed_glb(builder)).mesh.triangle_count(), 2u);
    for (int i = 0; i < 50; ++i) views.push_back(one);
    contains(complaint(tests::packed_glb(builder)), "more compressed data");
}

constexpr std::array draco_methods{draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING};

TEST(GltfPacked, DracoIsReadToItsQuantisation) {
    constexpr float step = 4.0f / (1 << tests::draco_position_bits), normals = 2e-3f;
    for (const GltfBuilder& plain : {tests::make_square(), tests::make_barrel()}) {
        const model::Character expected = tests::load(plain);
        for (const int method : draco_methods) {
            const model::Character got = tests::load(tests::pack_draco(plain, method));
            expect_same(got.mesh, expected.mesh, normals);
            for (std::size_t i = 0; i < got.mesh.vertex_count(); ++i) {
                const std::size_t at = nearest(expected.mesh, got.mesh, i);
                ASSERT_LE(glm::distance(got.mesh.positions[i], expected.mesh.positions[at]), step);
            }
            EXPECT_EQ(got.clips.size(), expected.clips.size());
        }
    }
}

TEST(GltfPacked, DracoThatIsNotRequiredIsReadToo) {
    GltfBuilder builder = tests::pack_draco(tests::make_square(), draco::MESH_EDGEBREAKER_ENCODING);
    builder.document.erase("extensionsRequired");
    EXPECT_EQ(tests::load(builder).mesh.triangle_count(), 2u);
}

TEST(GltfPacked, DracoBeyondItsAccessorsIsRefused) {
    for (const int method : draco_methods) {
        for (const char* what : {"vertices", "indices"}) {
            GltfBuilder builder = tests::pack_draco(tests::make_square(), method);
            const json& primitive = builder.document["meshes"][0]["primitives"][0];
            const bool vertices = std::string(what) == "vertices";
            const std::size_t accessor = vertices ? primitive["attributes"]["POSITION"] : primitive["indices"];
            builder.document["accessors"][accessor]["count"] = 3;
            contains(complaint(builder.glb()), std::string(what) + " in Draco's data; expected 3");
        }
    }
}

TEST(GltfPacked, WrongDracoIsRefusedByName) {
    const struct {
        const char *place, *said;
        json value;
    } cases[] = {{"/bufferView", "buffer view 99", 99},
                 {"/bufferView", "without 'bufferView'", "x"},
                 {"/bufferView", "no data of Draco", 0},
                 {"/attributes/POSITION", "no 'POSITION' in Draco's data", 77},
                 {"/attributes/POSITION", "without 'POSITION'", -5}};
    for (const auto& wrong : cases) {
        GltfBuilder builder = tests::pack_draco(tests::make_square(), draco::MESH_EDGEBREAKER_ENCODING);
        json& extension = builder.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
        extension[json::json_pointer(wrong.place)] = wrong.value;
        contains(complaint(builder.glb()), wrong.said);
    }
}

TEST(GltfPacked, TruncatedDracoIsRefused) {
    for (const int method : draco_methods) {
        GltfBuilder builder = tests::pack_draco(tests::make_square(), method);
        const std::size_t length = builder.document["bufferViews"].back()["byteLength"];
        for (std::size_t left = 0; left < length; ++left) {
            builder.document["bufferViews"].back()["byteLength"] = left;
            contains(complaint(builder.glb()), "Draco");
        }
    }
}

std::string warnings_of(const model::Character& character) {
    std::string lines;
    for (const model::Warning& warning : character.warnings) lines += model::text_of(warning) + '\n';
    return lines;
}

// Positions by meshopt, and as they were before.
GltfBuilder with_plain_copy(const GltfBuilder& plain, std::size_t view) {
    GltfBuilder builder = plain;
    const std::vector<float> values =
        tests::floats_of(plain, plain.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
    tests::replace_view(builder, static_cast<int>(view), tests::pack_attributes(values.data(), values.size() / 3, 12),
                        "EXT_meshopt_compression");
    builder.document["bufferViews"][view].merge_patch(plain.document["bufferViews"][view]);
    return builder;
}

TEST(GltfPacked, DamagedMeshoptIsReadFromItsPlainCopy) {
    const GltfBuilder plain = tests::make_barrel();
    const std::size_t positions = plain.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    const std::size_t view = plain.document["accessors"][positions]["bufferView"];
    GltfBuilder builder = with_plain_copy(plain, view);
    const model::Character whole = tests::load(builder);
    EXPECT_EQ(warnings_of(whole), "");
    json& length = builder.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]["byteLength"];
    length = length.get<std::size_t>() - 8;
    const model::Character damaged = tests::load(builder);
    EXPECT_EQ(damaged.mesh.positions, tests::load(plain).mesh.positions);
    EXPECT_EQ(warnings_of(damaged),
              "compressed data is damaged, its plain copy is read: 'buffer view " + std::to_string(view) + "'\n");
    builder.document["bufferViews"][view]["byteLength"] = 1 << 20;  // beyond what there is
    contains(complaint(builder.glb()), "damaged");
}

TEST(GltfPacked, DamagedDracoIsReadFromItsPlainCopy) {
    const GltfBuilder plain = tests::make_barrel();
    GltfBuilder builder = tests::pack_draco(plain, draco::MESH_EDGEBREAKER_ENCODING);
    json& length = builder.document["bufferViews"].back()["byteLength"];
    length = length.get<std::size_t>() / 2;
    builder.document["accessors"] = plain.document["accessors"];
    const model::Character character = tests::load(builder);
    EXPECT_EQ(character.mesh.positions, tests::load(plain).mesh.positions);
    EXPECT_EQ(character.mesh.indices, tests::load(plain).mesh.indices);
    EXPECT_EQ(warnings_of(character), "compressed data is damaged, its plain copy is read: 'Draco's'\n");
    const int indices = builder.document["meshes"][0]["primitives"][0]["indices"];
    builder.document["accessors"][static_cast<std::size_t>(indices)].erase("bufferView");
    contains(complaint(builder.glb()), "Draco");
}

}  // namespace
