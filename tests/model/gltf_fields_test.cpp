// What single fields of a glTF file mean: each is set alone, and what comes out is worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "model/clip_list.h"
#include "model/io/gltf.h"
#include "motion/pose.h"
#include "tests/model/gltf_builder.h"
#include "tests/motion/tentacle.h"

namespace {

using tests::GltfBuilder;
using tests::json;
using tests::load;

template <typename Value>
std::string bytes_of(const std::vector<Value>& values) {
    std::string bytes(values.size() * sizeof(Value), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

json& attributes(GltfBuilder& builder) {
    return builder.document["meshes"][0]["primitives"][0]["attributes"];
}

// --- Numbers

// Normals of a square's four vertices: without any they would part where its triangles bend.
int add_normals(GltfBuilder& builder) {
    return builder.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
}

// A square whose corners lie at these numbers, among others that are no part of it: the accessor begins within its
// view, the view within the buffer, and elements are a stride apart.
template <typename Value>
GltfBuilder square_at(tests::ComponentType type, bool normalized, const std::vector<Value>& twelve) {
    GltfBuilder builder = tests::make_square();
    const std::size_t element = 3 * sizeof(Value), stride = element / 4 * 4 + 4, offset = 8;
    std::string bytes(offset + 4 * stride, '\x55');
    for (std::size_t i = 0; i < 4; ++i) std::memcpy(&bytes[offset + i * stride], &twelve[3 * i], element);
    const int view = builder.add_view(bytes);
    builder.document["bufferViews"][view]["byteStride"] = stride;
    builder.document["accessors"].push_back({{"bufferView", view},
                                             {"byteOffset", offset},
                                             {"componentType", static_cast<int>(type)},
                                             {"normalized", normalized},
                                             {"count", 4},
                                             {"type", "VEC3"}});
    attributes(builder)["POSITION"] = builder.document["accessors"].size() - 1;
    attributes(builder)["NORMAL"] = add_normals(builder);
    return builder;
}

// Every number the type has at its ends and one in the middle; `largest` is what stands for 1.
template <typename Value>
void expect_read(tests::ComponentType type, bool is_signed, double largest) {
    using Limits = std::numeric_limits<Value>;
    const std::vector<Value> numbers{0, 1, 2, Limits::max(), 3, 5, Limits::lowest(), 7, 11, 13, Limits::max() / 3, 17};
    for (const bool normalized : {false, true}) {
        const std::vector<glm::vec3> positions = load(square_at(type, normalized, numbers)).mesh.positions;
        ASSERT_EQ(positions.size(), 4u);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            double expected = static_cast<double>(numbers[i]);
            if (normalized) expected = is_signed ? std::max(expected / largest, -1.0) : expected / largest;
            EXPECT_FLOAT_EQ(positions[i / 3][static_cast<int>(i % 3)], static_cast<float>(expected))
                << "type " << type << " number " << i << (normalized ? " normalised" : "");
        }
    }
}

TEST(GltfNumbers, OfEveryTypeAreReadWholeAndAsFractions) {
    expect_read<std::int8_t>(tests::i8, true, 127);
    expect_read<std::uint8_t>(tests::u8, false, 255);
    expect_read<std::int16_t>(tests::i16, true, 32767);
    expect_read<std::uint16_t>(tests::u16, false, 65535);
    expect_read<std::uint32_t>(tests::u32, false, 4294967295.0);
    const std::vector<float> numbers{0, 1, -2, 3.5f, 1e30f, -1e-30f, 7, 8, 9, 10, 11, 12};
    const std::vector<glm::vec3> positions = load(square_at(tests::f32, false, numbers)).mesh.positions;
    for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(positions[i / 3][static_cast<int>(i % 3)], numbers[i]);
}

template <typename Index>
void expect_sparse(tests::ComponentType type) {
    std::vector<std::int16_t> base(12), own{10, 20, 30, 40, 50, 60};
    for (std::size_t i = 0; i < base.size(); ++i) base[i] = static_cast<std::int16_t>(100 + i);
    GltfBuilder builder = square_at(tests::i16, false, base);
    const int indices = builder.add_view("abcd" + bytes_of(std::vector<Index>{1, 3})),
              values = builder.add_view("ef" + bytes_of(own));
    builder.document["accessors"][attributes(builder)["POSITION"].get<std::size_t>()]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"byteOffset", 4}, {"componentType", static_cast<int>(type)}}},
        {"values", {{"bufferView", values}, {"byteOffset", 2}}}};
    const std::vector<glm::vec3> expected{{100, 101, 102}, {10, 20, 30}, {106, 107, 108}, {40, 50, 60}};
    EXPECT_EQ(load(builder).mesh.positions, expected) << type;
}

TEST(GltfNumbers, SparseOnesReplaceTheirElementsAndNoOthers) {
    expect_sparse<std::uint8_t>(tests::u8);
    expect_sparse<std::uint16_t>(tests::u16);
    expect_sparse<std::uint32_t>(tests::u32);
}

template <typename Index>
void expect_indices(tests::ComponentType type) {
    GltfBuilder builder = tests::make_square();
    attributes(builder)["NORMAL"] = add_normals(builder);
    builder.document["meshes"][0]["primitives"][0]["indices"] =
        builder.add("SCALAR", type, 1, std::vector<Index>{2, 3, 0, 3, 2, 1});
    EXPECT_EQ(load(builder).mesh.indices, (std::vector<std::uint32_t>{2, 3, 0, 3, 2, 1})) << type;
}

TEST(GltfNumbers, IndicesOfEveryTypeNameTheirVertices) {
    expect_indices<std::uint8_t>(tests::u8);
    expect_indices<std::uint16_t>(tests::u16);
    expect_indices<std::uint32_t>(tests::u32);
    constexpr std::uint32_t many = 70'000;  // beyond sixteen bits
    GltfBuilder builder = tests::make_square();
    std::vector<float> places(std::size_t{3} * many);
    for (std::uint32_t i = 0; i < many; ++i)
        places[3 * i] = static_cast<float>(i), places[3 * i + 1] = i % 2 ? 1.0f : 0.0f;
    attributes(builder)["POSITION"] = builder.vec3(places);
    builder.document["meshes"][0]["primitives"][0]["indices"] =
        builder.add<std::uint32_t>("SCALAR", tests::u32, 1, {69'997, 69'999, 256});
    const model::Mesh mesh = load(builder).mesh;
    ASSERT_EQ(mesh.vertex_count(), 3u);  // those that are used, in the file's order
    EXPECT_EQ(mesh.positions[mesh.indices[0]].x, 69'997.0f);
    EXPECT_EQ(mesh.positions[mesh.indices[1]].x, 69'999.0f);
    EXPECT_EQ(mesh.positions[mesh.indices[2]].x, 256.0f);
}

// --- Vertices

TEST(GltfVertices, OnesThatNoTriangleUsesTakeNothingWithThem) {
    GltfBuilder builder = tests::make_everything();
    json& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = builder.vec2({1, 2, 3, 4, 5, 6, 7, 8});
    primitive["attributes"]["COLOR_0"] = builder.vec4({1, 1, 1, 1, 1, 1, 1, .5f, 1, 1, 1, .25f, 1, 1, 1, .75f});
    primitive["attributes"]["NORMAL"] = builder.vec3({1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0});
    primitive["indices"] = builder.indices({3, 1, 2});
    const model::Character character = load(builder);
    const model::Mesh& mesh = character.mesh;
    ASSERT_EQ(mesh.vertex_count(), 3u);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{2, 0, 1}));
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}));
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{3, 4}, {5, 6}, {7, 8}}));
    EXPECT_EQ(mesh.colors[0].a, 64);  // half of the material's
    EXPECT_EQ(mesh.colors[1].a, 32);
    EXPECT_EQ(mesh.morphs[0].position_offsets, (std::vector<glm::vec3>{{0, 0, 2}, {0, 0, 3}, {0, 0, 4}}));
    EXPECT_EQ(mesh.weights[1], glm::vec4(0.5f, 0.5f, 0, 0));
    EXPECT_EQ(mesh.weights[2], glm::vec4(1, 0, 0, 0));
}

TEST(GltfVertices, ColorsOfThreeChannelsAreOpaque) {
    GltfBuilder builder = tests::make_square();
    attributes(builder)["COLOR_0"] = builder.vec3({1, 0, 0, 0, 1, 0, 0, 0, 1, 2, -1, 0.5f});
    const model::Mesh mesh = load(builder).mesh;
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(mesh.colors[1], glm::u8vec4(0, 255, 0, 255));
    EXPECT_EQ(mesh.colors[3], glm::u8vec4(255, 0, 188, 255));
}

TEST(GltfVertices, NormalsThatAreNoneWeighTrianglesByTheirArea) {
    GltfBuilder builder = tests::make_square();
    // A corner of a box: two square units face z, half a one faces x, both with the corners 0 and 1.
    attributes(builder)["POSITION"] = builder.vec3({0, 0, 0, 0, 1, 0, 4, 0, 0, 0, 0, 1});
    builder.document["meshes"][0]["primitives"][0]["indices"] = builder.indices({0, 2, 1, 0, 1, 3});
    attributes(builder)["NORMAL"] = builder.vec3(std::vector<float>(12, 0.0f));
    const model::Mesh mesh = load(builder).mesh;
    const glm::vec3 shared = glm::normalize(glm::vec3(0.5f, 0, 2));
    EXPECT_LT(glm::distance(mesh.normals[0], shared), 1e-6f);
    EXPECT_LT(glm::distance(mesh.normals[1], shared), 1e-6f);
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[3], glm::vec3(1, 0, 0));
}

TEST(GltfVertices, GivenNormalsAreMadeUnitAndStay) {
    GltfBuilder builder = tests::make_square();
    attributes(builder)["NORMAL"] = builder.vec3({3, 0, 4, 0, -2, 0, 0, 0, 0, 1e-30f, 0, 0});
    const model::Mesh mesh = load(builder).mesh;
    EXPECT_LT(glm::distance(mesh.normals[0], glm::vec3(0.6f, 0, 0.8f)), 1e-6f);
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, -1, 0));
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));  // has none: the face's
    EXPECT_EQ(mesh.normals[3], glm::vec3(1, 0, 0));
}

TEST(GltfVertices, EachTriangleIsWoundByTheMirrorsOfItsOwnJoints) {
    GltfBuilder builder = tests::make_square();
    builder.document["meshes"].push_back(builder.document["meshes"][0]);
    builder.node(0) = {{"mesh", 0}, {"scale", {-1, 1, 1}}};
    builder.node(1) = {{"mesh", 1}, {"translation", {5, 0, 0}}};
    for (const json& order : {json{0, 1}, json{1, 0}}) {
        builder.document["scenes"][0]["nodes"] = order;
        const model::Character character = load(builder);
        motion::Pose pose;
        std::vector<glm::vec3> positions, normals;
        motion::evaluate_rest(character, pose);
        motion::skin(character.mesh, pose, positions, normals);
        for (std::size_t i = 0; i < character.mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return positions[character.mesh.indices[i + k]]; };
            EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0.0f) << i;
        }
    }
}

// --- Materials

TEST(GltfMaterials, ATransformsOwnSetOfCoordinatesOverridesTheTextures) {
    GltfBuilder builder = tests::make_everything();
    attributes(builder)["TEXCOORD_1"] = builder.vec2({.5f, .5f, .25f, .5f, .5f, .75f, .125f, .5f});
    json& texture = builder.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"]["KHR_texture_transform"] = {{"offset", {1, 2}}};
    EXPECT_EQ(load(builder).mesh.uvs[1], glm::vec2(2, 2));
    texture["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
    EXPECT_EQ(load(builder).mesh.uvs[1], glm::vec2(1.25f, 2.5f));
}

TEST(GltfMaterials, WithoutCoordinatesThereIsNoTexture) {
    GltfBuilder builder = tests::make_everything();
    attributes(builder).erase("TEXCOORD_0");
    const model::Mesh mesh = load(builder).mesh;
    EXPECT_EQ(mesh.material_of(0).texture, model::no_texture);
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(255, 188, 0, 128));
}

TEST(GltfMaterials, TexturesOfOneImageAreOneTexture) {
    GltfBuilder builder = tests::make_everything();
    builder.document["images"].push_back(builder.document["images"][0]);
    builder.document["textures"] = {{{"source", 1}}, {{"source", 0}}, {{"source", 1}}};
    for (const int texture : {1, 2}) {
        json material = builder.document["materials"][0];
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = texture;
        builder.document["materials"].push_back(material);
        json primitive = builder.document["meshes"][0]["primitives"][0];
        primitive["material"] = builder.document["materials"].size() - 1;
        builder.document["meshes"][0]["primitives"].push_back(primitive);
    }
    const model::Mesh mesh = load(builder).mesh;
    EXPECT_EQ(mesh.textures.size(), 2u);
    EXPECT_NE(mesh.material_of(0).texture, mesh.material_of(4).texture);
    EXPECT_EQ(mesh.material_of(0).texture, mesh.material_of(8).texture);
}

// --- Nodes and scenes

glm::vec3 first_place(const model::Character& character) {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, positions, normals);
    return positions[0] + glm::vec3(character.mesh.origin);
}

TEST(GltfNodes, ScaleTurnAndMoveInThisOrder) {
    GltfBuilder builder = tests::make_square();
    attributes(builder)["POSITION"] = builder.vec3({1, 2, 3, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    // A quarter turn about x, four times as long as a unit quaternion.
    const double quarter = 4 * std::sqrt(0.5);
    builder.node(0) = {
        {"mesh", 0}, {"translation", {10, 20, 30}}, {"rotation", {quarter, 0, 0, quarter}}, {"scale", {2, 3, 4}}};
    EXPECT_LT(glm::distance(first_place(load(builder)), glm::vec3(10 + 2, 20 - 12, 30 + 6)), 1e-5f);
}

TEST(GltfNodes, AMatrixIsAlsoWhatItsPartsMake) {
    tests::Random random(4);
    for (int i = 0; i < 100; ++i) {
        glm::vec3 scale = random.vector(0.3f, 3.0f);
        for (int axis = 0; axis < 3; ++axis)
            if (random(0, 1) < 0.4f) scale[axis] = -scale[axis];
        const glm::mat4 matrix = tests::matrix_of({random.vector(-5, 5), random.rotation(), scale});
        GltfBuilder builder = tests::make_square();
        builder.node(1)["matrix"] = std::vector<float>(&matrix[0][0], &matrix[0][0] + 16);
        const model::Node node = load(builder).skeleton.nodes[1];
        EXPECT_EQ(node.rest_matrix, matrix);
        const glm::mat4 made = tests::matrix_of(node.rest);
        for (int column = 0; column < 4; ++column)
            EXPECT_LT(glm::distance(made[column], matrix[column]), 1e-5f) << "matrix " << i << " column " << column;
    }
}

TEST(GltfNodes, ChannelsFindTheirNodesWhateverTheOrderOfTheFile) {
    GltfBuilder builder = tests::make_square();
    // The file names children before their parents, and an unrelated root first.
    builder.node(0) = json::object();
    builder.node(1) = {{"mesh", 0}, {"name", "leaf"}};
    builder.node(2) = {{"children", {1}}, {"name", "middle"}, {"translation", {0, 5, 0}}};
    builder.node(3) = {{"children", {2}}, {"name", "root"}};
    builder.document["scenes"][0]["nodes"] = {3};
    builder.document["animations"] = {{{"name", "a"},
                                       {"channels",
                                        {{{"sampler", 1}, {"target", {{"node", 2}, {"path", "translation"}}}},
                                         {{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}}},
                                       {"samplers",
                                        {{{"input", builder.scalars({0})}, {"output", builder.vec3({100, 0, 0})}},
                                         {{"input", builder.scalars({0})}, {"output", builder.vec3({0, 7, 0})}}}}}};
    const model::Character character = load(builder);
    EXPECT_EQ(first_place(character), glm::vec3(0, 5, 0));
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate(character, character.clips[0], 0, pose);
    motion::skin(character.mesh, pose, positions, normals);
    EXPECT_EQ(positions[0] + glm::vec3(character.mesh.origin), glm::vec3(100, 7, 0));
    for (const model::Channel& channel : character.clips[0].channels)
        EXPECT_EQ(character.skeleton.nodes[static_cast<std::size_t>(channel.node)].name,
                  channel.values[0] > 0 ? "root" : "middle");
}

TEST(GltfNodes, TheSceneAskedForIsShownWithAllBelowItsRoots) {
    GltfBuilder builder = tests::make_square();
    builder.node(0) = {{"mesh", 0}, {"translation", {1, 0, 0}}};
    builder.node(1) = {{"children", {2}}, {"translation", {2, 0, 0}}};
    builder.node(2) = {{"children", {3}}};
    builder.node(3) = {{"mesh", 0}};
    builder.document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    const auto shown_at = [&] { return first_place(load(builder)).x; };
    builder.document["scene"] = 1;
    EXPECT_EQ(shown_at(), 2);
    EXPECT_EQ(load(builder).mesh.triangle_count(), 2u);
    builder.document["scene"] = 0;
    EXPECT_EQ(shown_at(), 1);
    builder.document.erase("scene");  // then the first
    EXPECT_EQ(shown_at(), 1);
    builder.document.erase("scenes");  // then all
    EXPECT_EQ(load(builder).mesh.triangle_count(), 4u);
}

TEST(GltfNodes, JointsOfTwoSkinsKeepTheirOwnBinds) {
    for (const std::size_t element : {0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14}) {
        GltfBuilder builder = tests::make_everything();
        std::vector<float> binds(32, 0.0f);
        for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) binds[i] = 1;
        binds[16 + element] += 3;  // of the second joint
        builder.document["skins"].push_back(
            {{"joints", {1, 2}}, {"inverseBindMatrices", builder.add("MAT4", tests::f32, 16, binds)}});
        builder.node(3) = {{"mesh", 0}, {"skin", 1}};
        builder.document["scenes"][0]["nodes"] = {0, 1, 3};
        const model::Character character = load(builder);
        // The root's bind is the same in both, the tip's is not.
        ASSERT_EQ(character.skeleton.palette.size(), 3u) << element;
        const model::Mesh& mesh = character.mesh;
        const auto bind = [&](std::size_t vertex) {
            return character.skeleton.palette[mesh.joints[vertex].x].inverse_bind;
        };
        glm::mat4 expected(1.0f);
        EXPECT_EQ(bind(1), expected);
        expected[static_cast<int>(element / 4)][static_cast<int>(element % 4)] += 3;
        EXPECT_EQ(bind(4 + 1), expected);
    }
}

// --- Clips

// A square with clips whose samplers and channels are given.
GltfBuilder with_clips(const std::vector<std::pair<json, json>>& channels_and_samplers, GltfBuilder builder) {
    for (const auto& [channels, samplers] : channels_and_samplers)
        builder.document["animations"].push_back({{"channels", channels}, {"samplers", samplers}});
    return builder;
}

json to_node(int sampler, const char* path) {
    return {{"sampler", sampler}, {"target", {{"node", 0}, {"path", path}}}};
}

TEST(GltfClips, PathsAndInterpolationsAreWhatTheyAreCalled) {
    GltfBuilder builder = tests::make_square();
    const int times = builder.scalars({0, 1}), vectors = builder.vec3({1, 2, 3, 4, 5, 6}),
              turns = builder.vec4({0, 0, 0, 1, 1, 0, 0, 0}),
              splines = builder.vec3({1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5, 6, 6, 6});
    const json channels = {to_node(0, "translation"), to_node(1, "scale"), to_node(2, "rotation"),
                           to_node(3, "translation"), to_node(0, "pointer")};
    const json samplers = {{{"input", times}, {"output", vectors}},
                           {{"input", times}, {"output", vectors}, {"interpolation", "STEP"}},
                           {{"input", times}, {"output", turns}, {"interpolation", "LINEAR"}},
                           {{"input", times}, {"output", splines}, {"interpolation", "CUBICSPLINE"}}};
    const model::Clip clip = load(with_clips({{channels, samplers}}, builder)).clips[0];
    ASSERT_EQ(clip.channels.size(), 4u);  // what moves no surface is left out
    using model::Interpolation;
    using model::Path;
    const Path paths[] = {Path::translation, Path::scale, Path::rotation, Path::translation};
    const Interpolation kinds[] = {Interpolation::linear, Interpolation::step, Interpolation::linear,
                                   Interpolation::cubic_spline};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(clip.channels[i].path, paths[i]) << i;
        EXPECT_EQ(clip.channels[i].interpolation, kinds[i]) << i;
        EXPECT_EQ(clip.channels[i].times, (std::vector<float>{0, 1}));
    }
    EXPECT_EQ(clip.channels[1].values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(clip.channels[2].values, (std::vector<float>{0, 0, 0, 1, 1, 0, 0, 0}));
    EXPECT_EQ(clip.channels[3].values.size(), 18u);
}

TEST(GltfClips, HaveNamesThatTellThemApart) {
    GltfBuilder builder = tests::make_square();
    const int times = builder.scalars({0, 1}), places = builder.vec3({1, 2, 3, 4, 5, 6});
    const json channels = json::array({to_node(0, "translation")});
    const json samplers = json::array({{{"input", times}, {"output", places}}});
    builder = with_clips({6, {channels, samplers}}, builder);
    const std::vector<std::string> names{"", "Walk", "Walk (2)", "Walk", "Walk", ""};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!names[i].empty()) builder.document["animations"][i]["name"] = names[i];
    std::vector<std::string> found;
    for (const model::Clip& clip : load(builder).clips) found.push_back(clip.name);
    EXPECT_EQ(found, (std::vector<std::string>{"clip 0", "Walk", "Walk (2)", "Walk (3)", "Walk (4)", "clip 5"}));
}

TEST(GltfClips, AreListedInAShortLine) {
    const std::vector<model::Clip> clips(1000, {"a clip with a name as long as exporters make them", 0, {}});
    EXPECT_LT(model::list_of(clips).size(), 100u);
    EXPECT_EQ(model::list_of(std::span(clips).first(0)), "");
    EXPECT_EQ(model::list_of(std::vector<model::Clip>{{"Walk", 0, {}}, {"Run", 0, {}}}), "'Walk', 'Run'");
}

TEST(GltfClips, LastAsLongAsTheirLongestChannel) {
    GltfBuilder builder = tests::make_square();
    const int early = builder.scalars({0, 0.5f}), late = builder.scalars({1, 3}),
              vectors = builder.vec3({0, 0, 0, 1, 1, 1});
    const json samplers = {{{"input", early}, {"output", vectors}}, {{"input", late}, {"output", vectors}}};
    const json late_first = {to_node(1, "translation"), to_node(0, "scale")},
               late_last = {to_node(0, "translation"), to_node(1, "scale")},
               short_one = json::array({to_node(0, "scale")});
    const std::vector<model::Clip> clips =
        load(with_clips({{late_first, samplers}, {short_one, samplers}, {late_last, samplers}}, builder)).clips;
    ASSERT_EQ(clips.size(), 3u);
    EXPECT_EQ(clips[0].duration, 3);
    EXPECT_EQ(clips[1].duration, 0.5);
    EXPECT_EQ(clips[2].duration, 3);
}

TEST(GltfClips, KeysInNormalisedIntegersAreFractions) {
    GltfBuilder builder = tests::make_square();
    const int turns = builder.add<std::int16_t>("VEC4", tests::i16, 4, {0, 0, 0, 32767, 32767, 0, 0, 0});
    builder.document["accessors"].back()["normalized"] = true;
    const json sampler = {{"input", builder.scalars({0, 1})}, {"output", turns}};
    const json channels = json::array({to_node(0, "rotation")}), samplers = json::array({sampler});
    const model::Clip clip = load(with_clips({{channels, samplers}}, builder)).clips[0];
    EXPECT_EQ(clip.channels[0].values, (std::vector<float>{0, 0, 0, 1, 1, 0, 0, 0}));
}

}  // namespace
