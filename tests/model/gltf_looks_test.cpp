// What a file's materials come to, and what of them is said to be lost.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "model/texture_sample.h"
#include "tests/model/gltf_builder.h"
#include "tests/model/webp.h"

namespace {

using tests::GltfBuilder;
using tests::json;

std::string warnings_of(const model::Character& character) {
    std::string lines;
    for (const model::Warning& warning : character.warnings) lines += model::text_of(warning) + '\n';
    return lines;
}

const model::Material& material_of(const model::Character& character) {
    return character.mesh.material_of(0);
}

// make_everything()'s material, changed.
GltfBuilder with_material(const json& changes) {
    GltfBuilder builder = tests::make_everything();
    builder.document["materials"][0].merge_patch(changes);
    return builder;
}

TEST(GltfLooks, SamplersWrapAndFilter) {
    const auto sampled = [](const json& sampler) {
        GltfBuilder builder = tests::make_everything();
        builder.document["samplers"] = {sampler};
        builder.document["textures"][0]["sampler"] = 0;
        return material_of(load(builder)).sampler;
    };
    using model::Sampler, model::Wrap;
    EXPECT_EQ(material_of(load(tests::make_everything())).sampler, Sampler());
    EXPECT_EQ(sampled(json::object()), Sampler());
    EXPECT_EQ(sampled({{"wrapS", 33071}}), (Sampler{Wrap::clamp, Wrap::repeat, false}));
    EXPECT_EQ(sampled({{"wrapS", 33648}, {"wrapT", 33071}}), (Sampler{Wrap::mirror, Wrap::clamp, false}));
    EXPECT_EQ(sampled({{"magFilter", 9728}}), (Sampler{Wrap::repeat, Wrap::repeat, true}));
    EXPECT_EQ(sampled({{"magFilter", 9729}, {"minFilter", 9728}}), Sampler());
}

TEST(GltfLooks, MasksCutAndBlendsAreMasks) {
    EXPECT_EQ(material_of(load(tests::make_everything())).alpha_cutoff, 0.0f);
    EXPECT_EQ(material_of(load(with_material({{"alphaMode", "MASK"}}))).alpha_cutoff, 0.5f);
    EXPECT_EQ(material_of(load(with_material({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}}))).alpha_cutoff, 0.25f);
    const model::Character blended = load(with_material({{"alphaMode", "BLEND"}, {"name", "glass"}}));
    EXPECT_EQ(material_of(blended).alpha_cutoff, 0.5f);
    EXPECT_EQ(warnings_of(blended), "blended material, cut out at one half: 'glass'\n");
}

TEST(GltfLooks, EachMaterialSaysWhetherItHasTwoSides) {
    GltfBuilder builder = tests::make_everything();
    json& primitives = builder.document["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[1].erase("material");
    const model::Mesh mesh = load(builder).mesh;
    EXPECT_TRUE(mesh.material_of(0).double_sided);
    EXPECT_FALSE(mesh.material_of(mesh.vertex_count() - 1).double_sided);
}

TEST(GltfLooks, LightOfItsOwnIsItsFactorByItsStrength) {
    const json strength = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}};
    const model::Character strong = load(with_material({{"emissiveFactor", {0.5, 0.25, 1}}, {"extensions", strength}}));
    EXPECT_EQ(material_of(strong).emissive, glm::vec3(2, 1, 4));
    const model::Character textured =
        load(with_material({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}}));
    EXPECT_EQ(material_of(textured).emissive_texture, material_of(textured).texture);
    EXPECT_EQ(warnings_of(textured), "");
    const model::Character elsewhere = load(with_material(
        {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}, {"name", "m"}}));
    EXPECT_EQ(material_of(elsewhere).emissive_texture, model::no_texture);
    EXPECT_EQ(material_of(elsewhere).emissive, glm::vec3(0));
    EXPECT_EQ(warnings_of(elsewhere), "emissive texture read unlike the base colour's, left out: 'm'\n");
}

TEST(GltfLooks, OneWithoutBaseTextureGlowsWhereItsOwnTextureSays) {
    GltfBuilder builder = with_material({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}});
    builder.document["materials"][0]["pbrMetallicRoughness"].erase("baseColorTexture");
    const model::Character character = load(builder);
    EXPECT_EQ(material_of(character).texture, model::no_texture);
    EXPECT_EQ(material_of(character).emissive_texture, 0);
    EXPECT_EQ(warnings_of(character), "");
}

// make_everything() with four texels that glow, read as `glow` says at these coordinates.
model::Character glowing(const json& glow, const std::vector<float>& uvs) {
    GltfBuilder builder = tests::make_everything();
    const std::string texels = "\xff\x01\x01\x01\xff\x01\x01\x01\xff\xff\xff\xff";
    builder.document["images"].push_back(
        {{"mimeType", "image/png"}, {"bufferView", builder.add_view(tests::make_png(2, 2, texels))}});
    builder.document["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33071}}};
    builder.document["textures"].push_back({{"source", 1}, {"sampler", 0}});
    json& material = builder.document["materials"][0];
    material["name"] = "lamp";
    material["emissiveFactor"] = {1, 1, 1};
    material["emissiveTexture"] = {{"index", 1}};
    material["emissiveTexture"].merge_patch(glow);
    if (!uvs.empty()) builder.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = builder.vec2(uvs);
    return load(builder);
}

// Linear, at the corner `vertex` and a quarter of the way to the one that is opposite.
glm::vec3 glow_near(const model::Mesh& mesh, std::size_t vertex) {
    const model::Material& material = mesh.material_of(0);
    if (material.emissive_texture == model::no_texture) return glm::vec3(0);
    const glm::vec2 uv = glm::mix(mesh.uvs[vertex], mesh.uvs[(vertex + 2) % 4], 0.25f);
    return glm::vec3(texture_at(mesh.textures[material.emissive_texture], material.sampler, uv));
}

TEST(GltfLooks, AGlowIsReadByItsOwnCoordinates) {
    const struct {
        const char* what;
        json glow;
        std::vector<float> uvs;
        std::array<int, 4> texel;  // that corners show
    } cases[] = {{"the same", json::object(), {}, {0, 1, 3, 2}},
                 {"as copies", {{"texCoord", 1}}, {0, 0, 1, 0, 1, 1, 0, 1}, {0, 1, 3, 2}},
                 {"turned", {{"texCoord", 1}}, {1, 0, 1, 1, 0, 1, 0, 0}, {1, 3, 2, 0}},
                 {"moved by a transform",
                  {{"extensions", {{"KHR_texture_transform", {{"scale", {0.5, 1}}, {"offset", {0.5, 0}}}}}}},
                  {},
                  {1, 1, 3, 3}}};
    constexpr std::array colors{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1)};
    for (const auto& [what, glow, uvs, texel] : cases) {
        const model::Character character = glowing(glow, uvs);
        EXPECT_EQ(warnings_of(character), "") << what;
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_LT(glm::distance(glow_near(character.mesh, i), colors[static_cast<std::size_t>(texel[i])]), 0.01f)
                << what << " " << i;
    }
}

TEST(GltfLooks, ColoursOfOnePlaceFollowAGlowThatHasMore) {
    GltfBuilder builder = tests::make_everything();
    builder.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = builder.vec2({0, 0, 1, 0, 1, 1, 0, 1});
    builder.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        builder.vec2(std::vector<float>(8, 0.25f));
    builder.document["materials"][0]["emissiveFactor"] = {1, 1, 1};
    builder.document["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    const model::Character character = load(builder);
    EXPECT_EQ(warnings_of(character), "");
    EXPECT_EQ(character.mesh.uvs[2], glm::vec2(1, 1));
    const model::Material& material = material_of(character);
    EXPECT_EQ(character.mesh.textures[material.emissive_texture].texels[1], glm::u8vec4(1, 2, 3, 255));
    for (const glm::u8vec4& texel : character.mesh.textures[material.texture].texels)
        EXPECT_EQ(texel, glm::u8vec4(255, 32, 16, 255));
}

TEST(GltfLooks, AGlowThatNoMapGivesIsSaidToBeLost) {
    const model::Character character = glowing({{"texCoord", 1}}, {0, 0, 1, 0, 0.2f, 1, 0, 1});
    EXPECT_EQ(warnings_of(character), "emissive texture read unlike the base colour's, left out: 'lamp'\n");
    EXPECT_EQ(material_of(character).emissive, glm::vec3(0));
}

TEST(GltfLooks, WhatIsNoNumberAndWhatLacksCoordinatesIsSaid) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto changed = [](const char* name, auto add) {
        GltfBuilder builder = tests::make_everything();
        json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
        attributes[name] = add(builder);
        if (attributes[name].is_null()) attributes.erase(name);
        builder.document["materials"][0]["name"] = "skin";
        return load(builder);
    };
    const model::Character normals = changed("NORMAL", [&](GltfBuilder& b) {
        return json(b.vec3({0, 0, 1, nan, 0, 1, 0, nan, 1, 0, 0, 1}));
    });
    EXPECT_EQ(warnings_of(normals), "normal is no number, computed: 'vertex 1', and 1 more\n");
    EXPECT_EQ(normals.mesh.normals[1], glm::vec3(0, 0, 1));
    const model::Character uvs = changed("TEXCOORD_0", [&](GltfBuilder& b) {
        return json(b.vec2({0, 0, 1, 0, nan, 1, 0, 1}));
    });
    EXPECT_EQ(warnings_of(uvs), "texture coordinate is no number, set to 0: 'vertex 2'\n");
    const model::Character colors = changed("COLOR_0", [&](GltfBuilder& b) {
        return json(b.vec3({nan, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
    });
    EXPECT_EQ(warnings_of(colors), "colour is no number, left out: 'vertex 0'\n");
    EXPECT_EQ(colors.mesh.colors[0], colors.mesh.colors[1]);
    const model::Character bare = changed("TEXCOORD_0", [](GltfBuilder&) { return json(); });
    EXPECT_EQ(warnings_of(bare), "texture without coordinates, left out: 'skin'\n");
}

TEST(GltfLooks, UnlitStaysSo) {
    EXPECT_FALSE(material_of(load(tests::make_everything())).unlit);
    EXPECT_TRUE(material_of(load(with_material({{"extensions", {{"KHR_materials_unlit", json::object()}}}}))).unlit);
}

TEST(GltfLooks, SpecularGlossinessGivesItsDiffuseColourAndTexture) {
    const auto glossy = [](const json& value) {
        return load(with_material({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", value}}}}));
    };
    const model::Character red = glossy({{"diffuseFactor", {1, 0, 0, 1}}});
    EXPECT_EQ(red.mesh.colors[0], glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(material_of(red).texture, model::no_texture);
    const model::Character textured = glossy({{"diffuseTexture", {{"index", 0}}}});
    EXPECT_EQ(textured.mesh.colors[0], glm::u8vec4(255));
    EXPECT_EQ(material_of(textured).texture, 0);
    const json transform = {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}};
    const model::Character moved = glossy({{"diffuseTexture", {{"index", 0}, {"extensions", transform}}}});
    EXPECT_EQ(moved.mesh.uvs[0], glm::vec2(0.5f, 0));
}

// A box of 8 vertices.
GltfBuilder box() {
    GltfBuilder builder;
    std::vector<float> corners;
    for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis) corners.push_back(static_cast<float>(i >> axis & 1));
    builder.add_mesh({{"POSITION", builder.vec3(corners)}})["indices"] = builder.indices(
        {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5});
    builder.node(0)["mesh"] = 0;
    return builder;
}

TEST(GltfLooks, WithoutNormalsTrianglesAreFlat) {
    const model::Mesh mesh = load(box()).mesh;
    EXPECT_EQ(mesh.vertex_count(), 24u);
    ASSERT_EQ(mesh.triangle_count(), 12u);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t corner) { return mesh.positions[mesh.indices[i + corner]]; };
        const glm::vec3 normal = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
        for (std::size_t corner = 0; corner < 3; ++corner) EXPECT_EQ(mesh.normals[mesh.indices[i + corner]], normal);
    }
}

TEST(GltfLooks, VerticesThatPartKeepAllElseTheyHave) {
    GltfBuilder builder = box();
    std::vector<float> colors;
    for (int i = 0; i < 8; ++i)
        colors.insert(colors.end(), {i & 1 ? 1.0f : 0.0f, i & 2 ? 1.0f : 0.0f, i & 4 ? 1.0f : 0.0f});
    builder.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = builder.vec3(colors);
    builder.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", builder.vec3(colors)}}};
    const model::Mesh mesh = load(builder).mesh;
    ASSERT_EQ(mesh.morphs[0].position_offsets.size(), 24u);
    for (std::size_t i = 0; i < 24; ++i) {
        EXPECT_EQ(glm::vec3(mesh.colors[i]) / 255.0f, mesh.positions[i]);
        EXPECT_EQ(mesh.morphs[0].position_offsets[i], mesh.positions[i]);
    }
}

// The image of make_everything()'s texture, changed.
model::Character with_image(const json& image) {
    GltfBuilder builder = tests::make_everything();
    builder.document["images"][0] = image;
    return load(builder);
}

TEST(GltfLooks, TexturesThatCantBeHadAreLeftOutAndSaid) {
    const auto expect_lost = [](const model::Character& character, const std::string& said) {
        EXPECT_EQ(material_of(character).texture, model::no_texture);
        EXPECT_EQ(character.mesh.triangle_count(), 2u);
        EXPECT_EQ(warnings_of(character), said);
    };
    expect_lost(with_image({{"uri", "gone.png"}}), "texture not found, left out: 'gone.png'\n");
    expect_lost(with_image({{"uri", "data:image/png;base64,AAAAAAAA"}}),
                "texture is in an unknown format, left out: 'image 0'\n");
    expect_lost(with_image({{"uri", "data:image/png"}}),
                "texture whose bytes aren't in the file, left out: 'image 0'\n");
    expect_lost(with_image({{"bufferView", 99}, {"name", "skin"}}),
                "texture whose bytes aren't in the file, left out: 'skin'\n");
    GltfBuilder basis = tests::make_everything();
    basis.document["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    expect_lost(load(basis), "texture of an unknown format or without an image, left out: 'KHR_texture_basisu'\n");
}

TEST(GltfLooks, ImagesAreReadWhateverTheirTypeIsCalled) {
    const std::string png = tests::make_png(1, 1, "abc");
    std::string escaped;
    for (const char c : png) {
        static constexpr char digits[] = "0123456789ABCDEF";
        escaped += {'%', digits[static_cast<unsigned char>(c) >> 4], digits[c & 15]};
    }
    for (const char* head : {"data:image/jpg,", "data:,", "data:image/png;charset=utf-8,"}) {
        const model::Character character = with_image({{"uri", head + escaped}});
        ASSERT_EQ(character.mesh.textures.size(), 1u) << head;
        EXPECT_EQ(character.mesh.textures[0].texels[0], glm::u8vec4('a', 'b', 'c', 255));
    }
}

TEST(GltfLooks, ImageFilesAreFoundByOtherSpellings) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "textures");
    folder.write("textures/my skin.png", tests::make_png(1, 1, "abc"));
    for (const char* uri : {"textures\\my skin.png", "textures/my%20skin.png", "Textures/My%20Skin.PNG",
                            "C:\\work\\textures\\my skin.png"}) {
        GltfBuilder builder = tests::make_everything();
        builder.document["images"][0] = {{"uri", uri}};
        EXPECT_EQ(model::load_gltf(folder.write("a.glb", builder.glb())).mesh.textures.size(), 1u) << uri;
    }
}

TEST(GltfLooks, WebPIsReadAsAnExtensionOrPlainSource) {
    const std::string webp = tests::make_webp(2, 1, {10, 200, 30, 255, 10, 200, 30, 255});
    for (const bool plain : {false, true}) {
        GltfBuilder builder = tests::make_everything();
        builder.document["images"].push_back({{"bufferView", builder.add_view(webp)}});
        builder.document["textures"][0] = {{"source", 1}};
        if (!plain)
            builder.document["textures"][0] = {{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}};
        EXPECT_EQ(load(builder).mesh.textures[0].texels[0], glm::u8vec4(10, 200, 30, 255)) << plain;
    }
}

}  // namespace
