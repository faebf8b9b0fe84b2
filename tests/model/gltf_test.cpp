// The loader against files built here, each of whose contents is known.
#include "model/io/gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "motion/pose.h"
#include "tests/model/gltf_builder.h"

namespace {

using tests::GltfBuilder;
using tests::json;
using tests::load;

// What the loader says against a file; fails the test if it says nothing.
std::string complaint(const std::filesystem::path& path) {
    try {
        model::load_gltf(path);
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        EXPECT_NE(text.find(path.filename().string()), std::string::npos) << text;
        EXPECT_NE(text.find("found"), std::string::npos) << text;
        EXPECT_NE(text.find("expected"), std::string::npos) << text;
        return text;
    }
    ADD_FAILURE() << path << " loaded";
    return {};
}

std::string complaint(GltfBuilder builder) {
    const tests::TemporaryFolder folder;
    return complaint(folder.write("built.glb", builder.glb()));
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::vector<glm::vec3> rest_positions(const model::Character& character) {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, positions, normals);
    for (glm::vec3& position : positions) position += glm::vec3(character.mesh.origin);
    return positions;
}

TEST(Gltf, LoadsAllThatAFileHolds) {
    const model::Character character = load(tests::make_everything());
    const model::Mesh& mesh = character.mesh;
    EXPECT_EQ(character.name, "built");
    ASSERT_EQ(mesh.vertex_count(), 4u);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs[2], glm::vec2(1, 1));
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(255, 188, 0, 128));  // half of the light is sRGB's 188
    EXPECT_EQ(mesh.weights[0], glm::vec4(0.5f, 0.5f, 0, 0));   // 2 and 2 in the file
    EXPECT_TRUE(mesh.double_sided());
    ASSERT_EQ(mesh.textures.size(), 1u);
    EXPECT_EQ(mesh.material_of(0).texture, 0);
    EXPECT_EQ(mesh.textures[0].width, 2);
    EXPECT_EQ(mesh.textures[0].texels[0], glm::u8vec4(255, 32, 16, 255));
    EXPECT_EQ(mesh.textures[0].texels[1], glm::u8vec4(1, 2, 3, 255));
    ASSERT_EQ(mesh.morphs.size(), 1u);
    EXPECT_EQ(mesh.morphs[0].rest_weight, 0.25f);
    EXPECT_EQ(mesh.morphs[0].position_offsets[3], glm::vec3(0, 0, 4));
    ASSERT_EQ(character.skeleton.palette.size(), 2u);
    ASSERT_EQ(character.clips.size(), 1u);
    EXPECT_EQ(character.clips[0].name, "wag");
    EXPECT_EQ(character.clips[0].duration, 2.0);
    EXPECT_EQ(character.clips[0].channels.size(), 2u);
    EXPECT_EQ(character.clips[0].channels[1].interpolation, model::Interpolation::step);
}

TEST(Gltf, SkinnedVerticesIgnoreTheirNode) {
    const std::vector<glm::vec3> positions = rest_positions(load(tests::make_everything()));
    // Vertex 1 hangs on the tip, two above; vertex 0 half-way; a quarter of the morph target lifts them.
    EXPECT_EQ(positions[1], glm::vec3(1, 2, 0.5f)) << "expected no 100 of node 0, and the tip's";
    EXPECT_EQ(positions[0], glm::vec3(0, 1, 0.25f));
}

TEST(Gltf, RigidPartsFollowTheirNodes) {
    GltfBuilder builder = tests::make_square();
    builder.node(0) = {{"children", {1}}, {"translation", {10, 0, 0}}};
    builder.node(1) = {{"mesh", 0}, {"scale", {2, 2, 2}}};
    EXPECT_EQ(rest_positions(load(builder))[2], glm::vec3(12, 2, 0));
}

TEST(Gltf, OnlyTheDefaultScenesMeshesAreShown) {
    GltfBuilder builder = tests::make_square();
    builder.node(1) = {{"mesh", 0}};
    EXPECT_EQ(load(builder).mesh.triangle_count(), 2u);
    builder.document["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(load(builder).mesh.triangle_count(), 4u);
    builder.document["scenes"][0]["nodes"] = json::array();
    EXPECT_TRUE(contains(complaint(builder), "no triangles"));
}

TEST(Gltf, StripsAndFansAreTheirTriangles) {
    GltfBuilder strip = tests::make_square();
    json& primitive = strip.document["meshes"][0]["primitives"][0];
    primitive["mode"] = 5;
    primitive["indices"] = strip.indices({0, 1, 3, 2});
    EXPECT_EQ(load(strip).mesh.indices, (std::vector<std::uint32_t>{0, 1, 3, 1, 2, 3}));
    GltfBuilder fan = tests::make_square();
    fan.document["meshes"][0]["primitives"][0]["mode"] = 6;
    fan.document["meshes"][0]["primitives"][0].erase("indices");
    EXPECT_EQ(load(fan).mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    GltfBuilder lines = tests::make_square();
    lines.document["meshes"][0]["primitives"][0]["mode"] = 1;
    EXPECT_TRUE(contains(complaint(lines), "no triangles"));
}

TEST(Gltf, MissingNormalsAreTheSurfaces) {
    for (const glm::vec3& normal : load(tests::make_square()).mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    GltfBuilder zero = tests::make_square();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    zero.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        zero.vec3({0, 0, 0, nan, 0, 0, 0, 3, 0, 0, 0, 1});
    const model::Mesh mesh = load(zero).mesh;
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 1, 0));
}

TEST(Gltf, MirroredNodesStayRightSideOut) {
    for (const glm::vec3& scale : {glm::vec3(-1, 1, 1), glm::vec3(1, 1, 1), glm::vec3(-1, -2, 1)}) {
        GltfBuilder builder = tests::make_square();
        builder.node(0)["scale"] = {scale.x, scale.y, scale.z};
        const model::Character character = load(builder);
        motion::Pose pose;
        std::vector<glm::vec3> positions, normals;
        motion::evaluate_rest(character, pose);
        motion::skin(character.mesh, pose, positions, normals);
        const auto at = [&](std::size_t i) { return positions[character.mesh.indices[i]]; };
        EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0.0f) << scale.x;
        EXPECT_EQ(normals[0], glm::vec3(0, 0, 1)) << scale.x;
    }
}

TEST(Gltf, MatrixNodesAreDecomposed) {
    GltfBuilder builder = tests::make_square();
    builder.node(1)["matrix"] = {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1};  // a quarter turn about z
    const model::Node node = load(builder).skeleton.nodes[1];
    EXPECT_EQ(node.rest.translation, glm::vec3(5, 6, 7));
    EXPECT_LT(glm::distance(node.rest.scale, glm::vec3(2, 3, 4)), 1e-5f);
    EXPECT_NEAR(std::abs(node.rest.rotation.z), std::sqrt(0.5f), 1e-6f);
    EXPECT_EQ(node.rest_matrix[1].x, -3.0f);
}

TEST(Gltf, SparseValuesReplaceTheirElements) {
    GltfBuilder builder = tests::make_square();
    const int indices = builder.add_view({'\x02', '\0'});
    const float moved[3] = {9, 8, 7};
    const int values = builder.add_view({reinterpret_cast<const char*>(moved), sizeof moved});
    json& positions = builder.document["accessors"][0];
    positions["sparse"] = {{"count", 1},
                           {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                           {"values", {{"bufferView", values}}}};
    EXPECT_EQ(load(builder).mesh.positions[2], glm::vec3(9, 8, 7));
    EXPECT_EQ(load(builder).mesh.positions[1], glm::vec3(1, 0, 0));
    positions.erase("bufferView");  // then the others are zero
    EXPECT_EQ(load(builder).mesh.positions[2], glm::vec3(9, 8, 7));
    EXPECT_EQ(load(builder).mesh.positions[1], glm::vec3(0, 0, 0));
    for (const char* part : {"indices", "values"}) {
        positions["sparse"][part]["byteOffset"] = 1;
        EXPECT_TRUE(contains(complaint(builder), "beyond the end")) << part;
        positions["sparse"][part].erase("byteOffset");
    }
    for (const int count : {2, -1, std::numeric_limits<int>::min()}) {
        positions["sparse"]["count"] = count;
        EXPECT_TRUE(contains(complaint(builder), "beyond the end")) << count;
    }
}

TEST(Gltf, NormalisedIntegersAreFractions) {
    GltfBuilder builder = tests::make_square();
    const int positions = builder.add<std::int16_t>(
        "VEC3", tests::i16, 4, {0, 0, 0, 0, 32767, 0, 0, 0, 32767, 16384, 0, 0, -32768, 32767, 0, 0});
    builder.document["accessors"][positions]["normalized"] = true;
    builder.document["bufferViews"].back()["byteStride"] = 8;
    builder.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
    const model::Mesh mesh = load(builder).mesh;
    EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(mesh.positions[2].y, 16384.0f / 32767.0f);
    EXPECT_EQ(mesh.positions[3].x, -1.0f);
}

TEST(Gltf, TheFourHeaviestOfEightInfluencesStay) {
    GltfBuilder builder = tests::make_everything();
    std::vector<int> joints;
    for (std::size_t i = 1; i <= 8; ++i) {
        builder.node(i + 2);
        joints.push_back(static_cast<int>(i + 2));
    }
    builder.document["skins"] = {{{"joints", joints}}};
    json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
    const auto four = [&](std::vector<std::uint8_t> v) {
        std::vector<std::uint8_t> all;
        for (int i = 0; i < 4; ++i) all.insert(all.end(), v.begin(), v.end());
        return builder.add("VEC4", tests::u8, 4, all);
    };
    attributes["JOINTS_0"] = four({0, 1, 2, 3});
    attributes["JOINTS_1"] = four({4, 5, 6, 7});
    attributes["WEIGHTS_0"] = four({10, 20, 30, 40});
    attributes["WEIGHTS_1"] = four({50, 5, 60, 0});
    for (const char* name : {"WEIGHTS_0", "WEIGHTS_1"})
        builder.document["accessors"][attributes[name].get<int>()]["normalized"] = true;
    const model::Character character = load(builder);
    const std::vector<float> expected{60, 50, 40, 30, 20, 10, 5, 0};
    std::vector<std::pair<std::int32_t, float>> found;
    character.mesh.visit_influences(0, [&](std::uint16_t joint, float weight) {
        found.emplace_back(character.skeleton.palette[joint].node, weight);
    });
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < 8; ++k) EXPECT_FLOAT_EQ(found[k].second, expected[k] / 215);
    for (std::size_t a = 0; a < 7; ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(found[a].first, found[b].first);
}

TEST(Gltf, EqualSkinsShareTheirPalette) {
    GltfBuilder builder = tests::make_everything();
    builder.document["skins"].push_back(builder.document["skins"][0]);
    builder.node(3) = {{"mesh", 0}, {"skin", 1}};
    builder.document["scenes"][0]["nodes"] = {0, 1, 3};
    const model::Character character = load(builder);
    EXPECT_EQ(character.mesh.vertex_count(), 8u);
    EXPECT_EQ(character.skeleton.palette.size(), 2u);
}

TEST(Gltf, TextureTransformsMoveTheCoordinates) {
    GltfBuilder builder = tests::make_everything();
    builder.document["extensionsRequired"] = {"KHR_texture_transform"};
    builder
        .document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0}}, {"scale", {2, 3}}, {"rotation", 1.5707963267948966}};
    // Scaled, turned counter-clockwise as seen with v down (so (1, 0) goes to (0, -1)), moved.
    const model::Mesh mesh = load(builder).mesh;
    EXPECT_LT(glm::distance(mesh.uvs[0], glm::vec2(0.5f, 0)), 1e-6f);
    EXPECT_LT(glm::distance(mesh.uvs[1], glm::vec2(0.5f, -2)), 1e-6f);
    EXPECT_LT(glm::distance(mesh.uvs[3], glm::vec2(3.5f, 0)), 1e-6f);
}

// All that a character's file lost, a line each but the last.
std::string warnings_of(const model::Character& character) {
    std::string lines;
    for (const model::Warning& warning : character.warnings)
        lines += (lines.empty() ? "" : "\n") + model::text_of(warning);
    return lines;
}

TEST(Gltf, TexturesLieBesideTheFileToo) {
    const tests::TemporaryFolder folder;
    GltfBuilder builder = tests::make_everything();
    builder.document["images"][0] = {{"uri", "my%20skin.png"}};
    const auto path = folder.write("built.glb", builder.glb());
    EXPECT_EQ(warnings_of(model::load_gltf(path)), "texture not found, left out: 'my skin.png'");
    folder.write("my skin.png", tests::make_png(1, 1, "abc"));
    EXPECT_EQ(model::load_gltf(path).mesh.textures[0].texels[0], glm::u8vec4('a', 'b', 'c', 255));
}

TEST(Gltf, BuffersLieBesideTheFileToo) {
    const tests::TemporaryFolder folder;
    GltfBuilder builder = tests::make_square();
    builder.document["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "data.bin"}}};
    const auto path = folder.write("built.gltf", builder.document.dump());
    EXPECT_TRUE(contains(complaint(path), "data.bin"));
    folder.write("data.bin", builder.binary.substr(1));
    complaint(path);
    folder.write("data.bin", builder.binary);
    EXPECT_EQ(model::load_gltf(path).mesh.triangle_count(), 2u);
}

TEST(GltfRefuses, WhatLiesInTheWorkingDirectoryAlone) {
    const tests::TemporaryFolder folder, elsewhere;
    GltfBuilder builder = tests::make_everything();
    builder.document["images"][0] = {{"uri", "skin.png"}};
    const auto textured = folder.write("textured.glb", builder.glb());
    elsewhere.write("skin.png", tests::make_png(1, 1, "abc"));
    builder = tests::make_square();
    builder.document["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "data.bin"}}};
    const auto buffered = folder.write("buffered.gltf", builder.document.dump());
    elsewhere.write("data.bin", builder.binary);
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(elsewhere / "");
    EXPECT_EQ(warnings_of(model::load_gltf(textured)), "texture not found, left out: 'skin.png'");
    EXPECT_TRUE(contains(complaint(buffered), "data.bin"));
    std::filesystem::current_path(before);
}

TEST(Gltf, ChainsOfTwentyThousandNodesLoad) {
    GltfBuilder builder = tests::make_square();
    constexpr std::size_t depth = 20000;
    builder.node(depth - 1)["mesh"] = 0;
    builder.node(0).erase("mesh");
    for (std::size_t i = 0; i + 1 < depth; ++i) builder.node(i)["children"] = {i + 1};
    for (std::size_t i = 0; i < depth; ++i) builder.node(i)["translation"] = {1, 0, 0};
    const model::Character character = load(builder);
    EXPECT_EQ(character.skeleton.nodes.size(), depth);
    EXPECT_EQ(rest_positions(character)[0], glm::vec3(depth, 0, 0));
}

TEST(GltfRefuses, NodesThatAreNoTree) {
    GltfBuilder cycle = tests::make_square();
    cycle.node(0)["children"] = {1};
    cycle.node(1)["children"] = {0};
    EXPECT_TRUE(contains(complaint(cycle), "cycle"));
    GltfBuilder self = tests::make_square();
    self.node(0)["children"] = {0};
    EXPECT_TRUE(contains(complaint(self), "cycle"));
    GltfBuilder shared = tests::make_square();
    shared.node(0)["children"] = {2};
    shared.node(1)["children"] = {2};
    shared.node(2);
    EXPECT_TRUE(contains(complaint(shared), "two parents"));
}

TEST(GltfRefuses, UnknownRequiredExtensionsByName) {
    GltfBuilder builder = tests::make_square();
    builder.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    EXPECT_TRUE(contains(complaint(builder), "EXT_mesh_gpu_instancing"));
}

TEST(GltfRefuses, WhatIsNoGltf) {
    const tests::TemporaryFolder folder;
    complaint(folder / "missing.glb");
    complaint(folder / ".");
    complaint(folder.write("empty.glb", ""));
    complaint(folder.write("short.glb", "glTF"));
    complaint(folder.write("text.gltf", "o spot\nv 1 2 3\n"));
    complaint(folder.write("array.gltf", "[1, 2, 3]"));
    complaint(folder.write("no_asset.gltf", "{}"));
    complaint(folder.write("picture.glb", tests::make_png(1, 1, "abc")));
    complaint("/dev/zero");
}

TEST(GltfRefuses, NumbersThatAreNotFinite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfBuilder builder = tests::make_square();
        std::memcpy(builder.binary.data() + 16, &bad, sizeof bad);
        EXPECT_TRUE(contains(complaint(builder), "finite"));
    }
    GltfBuilder large = tests::make_square();
    large.node(0)["translation"] = {1e300, 0, 0};
    EXPECT_TRUE(contains(complaint(large), "finite"));
}

TEST(GltfRefuses, CountsThatTheBytesDoNotHold) {
    for (const std::uint64_t count :
         {std::uint64_t{5}, std::uint64_t{1} << 31, std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
        GltfBuilder builder = tests::make_square();
        builder.document["accessors"][0]["count"] = count;
        complaint(builder);
        builder.document["accessors"][0].erase("bufferView");  // zeros without end
        if (count > 5) complaint(builder);
    }
}

TEST(GltfRefuses, FilesThatUnfoldWithoutEnd) {
    GltfBuilder instances = tests::make_square();
    std::vector<float> many(300'000, 0.5f);
    instances.document["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", instances.vec3(many)}}}};
    std::vector<int> roots;
    for (int i = 0; i < 1000; ++i) {
        instances.node(static_cast<std::size_t>(i))["mesh"] = 0;
        roots.push_back(i);
    }
    instances.document["scenes"][0]["nodes"] = roots;
    EXPECT_TRUE(contains(complaint(instances), "repeated"));
}

TEST(GltfRefuses, JsonNestedWithoutEnd) {
    const tests::TemporaryFolder folder;
    for (const auto& [open, close] : {std::pair{"[", "]"}, {"{\"a\":", "}"}}) {
        std::string text = R"({"asset":{"version":"2.0"},"extras":)";
        for (int i = 0; i < 200'000; ++i) text += open;
        text += "1";
        for (int i = 0; i < 200'000; ++i) text += close;
        EXPECT_TRUE(contains(complaint(folder.write("deep.gltf", text + "}")), "nested"));
    }
}

}  // namespace
