// Files of parts that differ in all that a part can say: each comes out as it does alone, whatever lies beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "model/io/gltf.h"
#include "motion/pose.h"
#include "tests/model/gltf_builder.h"

namespace {

using tests::GltfBuilder;
using tests::json;
using tests::load;

constexpr double halfway = 0.35;  // [s] between the clip's keys, off their middle

GltfBuilder empty_file() {
    GltfBuilder builder;
    for (const char* list : {"materials", "textures", "images", "skins"}) builder.document[list] = json::array();
    builder.document["scenes"][0]["nodes"] = json::array();
    builder.document["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
    return builder;
}

int push(GltfBuilder& builder, const char* list, const json& value) {
    builder.document[list].push_back(value);
    return static_cast<int>(builder.document[list].size()) - 1;
}

int add_root(GltfBuilder& builder, const json& node) {
    const int index = push(builder, "nodes", node);
    builder.document["scenes"][0]["nodes"].push_back(index);
    return index;
}

void animate(GltfBuilder& builder, int node, const char* path, const char* interpolation, int times, int values) {
    json& animation = builder.document["animations"][0];
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back({{"input", times}, {"output", values}, {"interpolation", interpolation}});
}

// The second of two images; the file's textures count the other way.
int add_texture(GltfBuilder& builder, const std::string& texels) {
    const auto image = [&](const std::string& rgb) {
        return push(builder, "images",
                    {{"mimeType", "image/png"}, {"bufferView", builder.add_view(tests::make_png(2, 1, rgb))}});
    };
    const int other = image("123456"), wanted = image(texels);
    const int texture = push(builder, "textures", {{"source", wanted}});
    push(builder, "textures", {{"source", other}});
    return texture;
}

json corners(GltfBuilder& builder, float side) {
    return {{"POSITION", builder.vec3({0, 0, 0, side, 0, 0, side, side, 0.5f, 0, side, 0})},
            {"NORMAL", builder.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})}};
}

// --- The parts

void add_plain(GltfBuilder& builder) {
    json& primitive = builder.add_mesh(corners(builder, 1));
    primitive["indices"] = builder.indices({0, 1, 2, 0, 2, 3});
    add_root(builder, {{"mesh", builder.document["meshes"].size() - 1}, {"translation", {7, 8, 9}}});
}

// Mirrored, seen from both sides, a texture on its second set of coordinates, normals that are not the faces', turning.
void add_painted(GltfBuilder& builder) {
    json attributes = corners(builder, 2);
    attributes["NORMAL"] = builder.vec3({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.6f, 0.8f});
    attributes["TEXCOORD_0"] = builder.vec2({9, 9, 9, 9, 9, 9, 9, 9});
    attributes["TEXCOORD_1"] = builder.vec2({0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f});
    json& primitive = builder.add_mesh(attributes);
    primitive["indices"] = builder.indices({0, 1, 2, 1, 2, 3});
    primitive["material"] =
        push(builder, "materials",
             {{"doubleSided", true},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", {0.2, 0.5, 1.0, 0.25}},
                {"baseColorTexture", {{"index", add_texture(builder, "abcdef")}, {"texCoord", 1}}}}}});
    const int node = add_root(builder, {{"mesh", builder.document["meshes"].size() - 1}, {"scale", {-1, 2, 0.5}}});
    animate(builder, node, "rotation", "LINEAR", builder.scalars({0, 1}), builder.vec4({0, 0, 0, 1, 0, 0.8f, 0, 0.6f}));
}

// Colours of its vertices in bytes, a strip, below a node of its own that is scaled in steps.
void add_colored(GltfBuilder& builder) {
    json attributes = corners(builder, 3);
    attributes["COLOR_0"] =
        builder.add<std::uint8_t>("VEC4", tests::u8, 4, {255, 0, 51, 9, 0, 255, 102, 99, 1, 2, 3, 4, 50, 60, 70, 80});
    builder.document["accessors"].back()["normalized"] = true;
    json& primitive = builder.add_mesh(attributes);
    primitive["mode"] = 5;
    primitive["indices"] = builder.indices({0, 1, 3, 2});
    primitive["material"] =
        push(builder, "materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}}}});
    const int child =
        push(builder, "nodes", {{"mesh", builder.document["meshes"].size() - 1}, {"rotation", {0, 0, 0.6, 0.8}}});
    const int parent = add_root(builder, {{"children", {child}}, {"translation", {0, -3, 0}}});
    animate(builder, parent, "scale", "STEP", builder.scalars({0.25f, 0.5f}), builder.vec3({1, 2, 3, 4, 5, 6}));
}

// On two joints whose binds differ; one of them moves along a spline. Its texture is moved and turned.
void add_skinned(GltfBuilder& builder) {
    json attributes = corners(builder, 4);
    attributes["TEXCOORD_0"] = builder.vec2({0, 0, 1, 0, 1, 1, 0, 1});
    attributes["JOINTS_0"] =
        builder.add<std::uint8_t>("VEC4", tests::u8, 4, {0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
    attributes["WEIGHTS_0"] = builder.vec4({1, 3, 0, 0, 1, 0, 0, 0, 2, 2, 0, 0, 1, 0, 0, 0});
    json& primitive = builder.add_mesh(attributes);
    primitive["indices"] = builder.indices({0, 1, 2, 0, 2, 3});
    primitive["material"] =
        push(builder, "materials",
             {{"pbrMetallicRoughness",
               {{"baseColorTexture",
                 {{"index", add_texture(builder, "uvwxyz")},
                  {"extensions",
                   {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 0.5}}}}}}}}}});
    const int tip = push(builder, "nodes", {{"translation", {0, 2, 0}}});
    const int root = add_root(builder, {{"children", {tip}}, {"rotation", {0.6, 0, 0, 0.8}}});
    std::vector<float> binds(32, 0.0f);
    for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) binds[i] = 1;
    binds[12] = 5, binds[16] = 2;  // one is moved, the other stretched
    const int skin =
        push(builder, "skins",
             {{"joints", {tip, root}}, {"inverseBindMatrices", builder.add("MAT4", tests::f32, 16, binds)}});
    add_root(builder, {{"mesh", builder.document["meshes"].size() - 1}, {"skin", skin}});
    animate(builder, tip, "translation", "CUBICSPLINE", builder.scalars({0, 2}),
            builder.vec3({0, 0, 0, 0, 2, 0, 1, 2, 3, 4, 5, 6, 1, 4, 1, 0, 0, 0}));
}

// Two targets, the second with normals; rest weights of the mesh.
void add_morphed(GltfBuilder& builder) {
    json& primitive = builder.add_mesh(corners(builder, 5));
    primitive["indices"] = builder.indices({0, 1, 2, 0, 2, 3});
    primitive["targets"] = {{{"POSITION", builder.vec3({0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4})}},
                            {{"POSITION", builder.vec3({1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0})},
                             {"NORMAL", builder.vec3({1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0})}}};
    builder.document["meshes"].back()["weights"] = {0.25, 0.5};
    const int node = add_root(builder, {{"mesh", builder.document["meshes"].size() - 1}});
    animate(builder, node, "weights", "LINEAR", builder.scalars({0, 1}), builder.scalars({0, 1, 1, 3}));
}

// One target; the node's own rest weight overrides the mesh's.
void add_other_morphed(GltfBuilder& builder) {
    json& primitive = builder.add_mesh(corners(builder, 6));
    primitive["indices"] = builder.indices({0, 1, 2, 0, 2, 3});
    primitive["targets"] = {{{"POSITION", builder.vec3({0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0})}}};
    builder.document["meshes"].back()["weights"] = {9};
    const int node = add_root(builder, {{"mesh", builder.document["meshes"].size() - 1}, {"weights", {0.75}}});
    animate(builder, node, "weights", "STEP", builder.scalars({0, 0.3f}), builder.scalars({-1, -2}));
}

// Two primitives of one mesh: one of both sides, red and with a texture, one of neither.
void add_two_primitives(GltfBuilder& builder) {
    json attributes = corners(builder, 7);
    attributes["TEXCOORD_0"] = builder.vec2({0, 0.5f, 1, 0, 1, 1, 0, 1});
    json& primitive = builder.add_mesh(attributes);
    primitive["indices"] = builder.indices({0, 1, 2});
    primitive["material"] = push(
        builder, "materials",
        {{"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 0, 0, 1}}, {"baseColorTexture", {{"index", add_texture(builder, "ABCDEF")}}}}}});
    const int plain = push(builder, "materials", {{"doubleSided", false}});
    const json second = {{"attributes", attributes}, {"indices", builder.indices({3, 2, 0})}, {"material", plain}};
    builder.document["meshes"].back()["primitives"].push_back(second);
    add_root(builder, {{"mesh", builder.document["meshes"].size() - 1}, {"translation", {0, 0, 30}}});
}

struct Part {
    const char* name;
    void (*add)(GltfBuilder&);
    bool double_sided;
};
constexpr std::array parts{Part{"plain", add_plain, false},
                           Part{"painted", add_painted, true},
                           Part{"colored", add_colored, false},
                           Part{"skinned", add_skinned, false},
                           Part{"morphed", add_morphed, false},
                           Part{"other morphed", add_other_morphed, false},
                           Part{"two primitives", add_two_primitives, true}};

// --- What is seen of a triangle

void append(std::vector<float>& values, const glm::vec3& v) {
    values.insert(values.end(), {v.x, v.y, v.z});
}

using Corner = std::vector<float>;

// Its places and normals at rest and in the clip, its colour, its coordinates and all of its texture.
Corner corner_of(const model::Character& character, std::uint32_t vertex,
                 const std::array<std::vector<glm::vec3>, 4>& posed) {
    const model::Mesh& mesh = character.mesh;
    Corner values;
    for (const std::vector<glm::vec3>& vectors : posed) append(values, vectors[vertex]);
    for (int i = 0; i < 4; ++i) values.push_back(mesh.colors[vertex][i]);
    const std::uint8_t texture = mesh.material_of(vertex).texture;
    values.push_back(texture != model::no_texture);
    if (texture == model::no_texture) return values;
    values.insert(values.end(), {mesh.uvs[vertex].x, mesh.uvs[vertex].y});
    for (const glm::u8vec4& texel : mesh.textures[texture].texels) append(values, glm::vec3(texel));
    return values;
}

using Triangle = std::array<Corner, 3>;

std::vector<Triangle> triangles_of(const model::Character& character) {
    std::array<std::vector<glm::vec3>, 4> posed;
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, posed[0], posed[1]);
    motion::evaluate(character, character.clips[0], halfway, pose);
    motion::skin(character.mesh, pose, posed[2], posed[3]);
    for (const std::size_t positions : {0, 2})
        for (glm::vec3& position : posed[positions]) position += glm::vec3(character.mesh.origin);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < character.mesh.indices.size(); i += 3) {
        Triangle& triangle = triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = corner_of(character, character.mesh.indices[i + k], posed);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

model::Character load_parts(const std::vector<std::size_t>& which) {
    GltfBuilder builder = empty_file();
    for (const std::size_t part : which) parts[part].add(builder);
    return load(builder);
}

std::vector<Triangle> together(std::vector<Triangle> a, const std::vector<Triangle>& b) {
    a.insert(a.end(), b.begin(), b.end());
    std::sort(a.begin(), a.end());
    return a;
}

TEST(GltfParts, EachIsTheSameBesideAnyOther) {
    for (std::size_t first = 0; first < parts.size(); ++first) {
        for (std::size_t second = 0; second < parts.size(); ++second) {
            SCOPED_TRACE(std::string(parts[first].name) + " before " + parts[second].name);
            const model::Character both = load_parts({first, second});
            EXPECT_EQ(triangles_of(both),
                      together(triangles_of(load_parts({first})), triangles_of(load_parts({second}))));
            EXPECT_EQ(both.mesh.double_sided(), parts[first].double_sided || parts[second].double_sided);
        }
    }
}

TEST(GltfParts, AllTogetherAreWhatTheyAreAlone) {
    std::vector<Triangle> expected;
    std::vector<std::size_t> all;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        expected = together(expected, triangles_of(load_parts({part})));
        all.push_back(part);
    }
    EXPECT_EQ(triangles_of(load_parts(all)), expected);
    std::reverse(all.begin(), all.end());
    EXPECT_EQ(triangles_of(load_parts(all)), expected);
}

// --- What each is alone

glm::vec3 vertex(const std::vector<glm::vec3>& of, const model::Mesh& mesh, std::size_t corner) {
    return of[mesh.indices[corner]];
}

struct Surface {
    std::vector<glm::vec3> positions, normals;
};

Surface at_rest(const model::Character& character) {
    motion::Pose pose;
    Surface surface;
    motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, surface.positions, surface.normals);
    return surface;
}

Surface in_clip(const model::Character& character, double time) {
    motion::Pose pose;
    Surface surface;
    motion::evaluate(character, character.clips[0], time, pose);
    motion::skin(character.mesh, pose, surface.positions, surface.normals);
    return surface;
}

constexpr float rounding = 1e-5f;  // of a few products of numbers below 100

void expect_near(const glm::vec3& got, const glm::vec3& expected) {
    EXPECT_LT(glm::distance(got, expected), rounding) << got.x << ' ' << got.y << ' ' << got.z;
}

TEST(GltfParts, APaintedMirrorKeepsItsNormalsOutwardAndItsSecondCoordinates) {
    const model::Character painted = load_parts({1});
    const model::Mesh& mesh = painted.mesh;
    const Surface rest = at_rest(painted);
    ASSERT_EQ(mesh.vertex_count(), 4u);
    expect_near(rest.positions[2], {-2, 4, 0.25f});
    // Through the inverse of the scale: y is halved and z doubled before it is unit again.
    expect_near(rest.normals[3], glm::normalize(glm::vec3(0, 0.3f, 1.6f)));
    expect_near(rest.normals[0], {-1, 0, 0});
    EXPECT_EQ(mesh.uvs[2], glm::vec2(0.5f, 0.6f));
    EXPECT_EQ(mesh.textures[mesh.material_of(0).texture].texels[1], glm::u8vec4('d', 'e', 'f', 255));
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(124, 188, 255, 64));  // sRGB's codes of a fifth, a half and all of the light
    const glm::vec3 a = vertex(rest.positions, mesh, 0), b = vertex(rest.positions, mesh, 1),
                    c = vertex(rest.positions, mesh, 2);
    const glm::vec3 unmirrored = glm::cross(glm::vec3(2, 0, 0), glm::vec3(2, 2, 0.5f));  // of the file's corners
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), unmirrored * glm::vec3(-1, 1, 1)), 0.0f);
    // A third of the way round y: from no turn to 2 atan(0.8 / 0.6), at the arc's even speed.
    const double angle = 2 * std::atan2(0.8, 0.6) * halfway;
    const glm::vec3 turned(-2 * std::cos(angle) + 0.25 * std::sin(angle), 4,
                           2 * std::sin(angle) + 0.25 * std::cos(angle));
    expect_near(in_clip(painted, halfway).positions[2], turned);
}

TEST(GltfParts, VertexColorsMultiplyTheFactorInLight) {
    const model::Mesh mesh = load_parts({2}).mesh;
    // Half, none and a fifth of the light; 0.04 of alpha. Vertices keep the file's order.
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(188, 0, 124, 9));
    EXPECT_EQ(mesh.colors[1], glm::u8vec4(0, 137, 170, 99));
    EXPECT_EQ(mesh.material_of(0).texture, model::no_texture);
}

TEST(GltfParts, StepsAreHeldBelowTheirNode) {
    const model::Character colored = load_parts({2});
    // Turned by the child about z (0.6, 0.8: by 2 atan(3/4), whose cosine is 0.28), then scaled and moved.
    const glm::vec3 turned(3 * 0.28f, 3 * 0.96f, 0);
    const std::uint32_t second = 1;
    expect_near(at_rest(colored).positions[second], turned + glm::vec3(0, -3, 0));
    for (const double time : {0.0, 0.25, 0.49})
        expect_near(in_clip(colored, time).positions[second], turned * glm::vec3(1, 2, 3) + glm::vec3(0, -3, 0));
    for (const double time : {0.5, 2.0})
        expect_near(in_clip(colored, time).positions[second], turned * glm::vec3(4, 5, 6) + glm::vec3(0, -3, 0));
}

TEST(GltfParts, JointsTakeTheirOwnBinds) {
    const model::Character skinned = load_parts({3});
    // The root turns y to 0.28 y + 0.96 z; the tip is two along that. Its bind moves by five along x, the root's
    // doubles x.
    const auto by_root = [](const glm::vec3& p) {
        return glm::vec3(p.x, 0.28f * p.y - 0.96f * p.z, 0.96f * p.y + 0.28f * p.z);
    };
    const auto on_tip = [&](const glm::vec3& p) { return by_root(p + glm::vec3(5, 2, 0)); };
    const auto on_root = [&](const glm::vec3& p) { return by_root(p * glm::vec3(2, 1, 1)); };
    const std::vector<glm::vec3> rest = at_rest(skinned).positions;
    const glm::vec3 second(4, 0, 0), third(4, 4, 0.5f);
    expect_near(rest[0], 0.25f * on_tip(glm::vec3(0)) + 0.75f * on_root(glm::vec3(0)));
    expect_near(rest[1], on_root(second));
    expect_near(rest[2], 0.5f * on_tip(third) + 0.5f * on_root(third));
}

TEST(GltfParts, SplinesLeaveAndArriveByTheirOwnTangents) {
    const model::Character skinned = load_parts({3});
    const model::Channel& channel = skinned.clips[0].channels[0];
    EXPECT_EQ(channel.interpolation, model::Interpolation::cubic_spline);
    motion::Pose pose;
    const auto tip = static_cast<std::size_t>(channel.node);
    const auto along = [&](double time) {
        motion::evaluate(skinned, skinned.clips[0], time, pose);
        const glm::mat4 local =
            glm::inverse(pose.world[static_cast<std::size_t>(skinned.skeleton.nodes[tip].parent)]) * pose.world[tip];
        return glm::vec3(local[3]);
    };
    constexpr double step = 1.0 / 1024;
    constexpr float slope_error = 0.02f;  // of a difference over a step, whose curvature is below 20
    expect_near(along(0), {0, 2, 0});
    expect_near(along(2), {1, 4, 1});
    EXPECT_LT(glm::distance((along(step) - along(0)) / float(step), glm::vec3(1, 2, 3)), slope_error);
    EXPECT_LT(glm::distance((along(2) - along(2 - step)) / float(step), glm::vec3(4, 5, 6)), slope_error);
}

TEST(GltfParts, EveryMorphHasTheWeightOfItsNodeAndSlot) {
    const model::Character both = load_parts({4, 5});
    ASSERT_EQ(both.mesh.morphs.size(), 3u);
    const std::vector<glm::vec3> rest = at_rest(both).positions, posed = in_clip(both, 0.5).positions;
    for (std::size_t i = 0; i < 4; ++i) {
        const float n = static_cast<float>(i + 1);
        expect_near(rest[i], both.mesh.positions[i] + glm::vec3(0.5f * n, 0, 0.25f * n));
        expect_near(rest[4 + i], both.mesh.positions[4 + i] + glm::vec3(0, 0.75f * n, 0));
        expect_near(posed[i], both.mesh.positions[i] + glm::vec3(2 * n, 0, 0.5f * n));
        expect_near(posed[4 + i], both.mesh.positions[4 + i] + glm::vec3(0, -2 * n, 0));
    }
    EXPECT_TRUE(both.mesh.morphs[0].normal_offsets.empty());
    EXPECT_EQ(both.mesh.morphs[1].normal_offsets[2], glm::vec3(-1, 0, 0));
    EXPECT_NE(in_clip(both, 0.5).normals[0], in_clip(both, 0).normals[0]);
}

TEST(GltfParts, PrimitivesOfOneMeshHaveTheirOwnMaterials) {
    const model::Mesh mesh = load_parts({6}).mesh;
    ASSERT_EQ(mesh.triangle_count(), 2u);
    for (std::size_t corner = 0; corner < 3; ++corner) {
        EXPECT_EQ(mesh.colors[mesh.indices[corner]], glm::u8vec4(255, 0, 0, 255));
        EXPECT_EQ(mesh.material_of(mesh.indices[corner]).texture, 0);
        EXPECT_EQ(mesh.colors[mesh.indices[3 + corner]], glm::u8vec4(255));
        EXPECT_EQ(mesh.material_of(mesh.indices[3 + corner]).texture, model::no_texture);
    }
}

}  // namespace
