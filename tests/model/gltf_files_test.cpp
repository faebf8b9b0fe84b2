// Files that other programs read or write although they are not as plain as glTF 2.0's examples, and ones to be
// refused.
#include <gtest/gtest.h>

#include <stdexcept>

#include "model/io/mesh_file.h"
#include "tests/model/gltf_builder.h"

namespace {

using tests::GltfBuilder;
using tests::json;

std::string base64(const std::string& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return out;
}

// A square whose buffer lies at this URI.
std::string square_at(const std::string& uri) {
    GltfBuilder builder = tests::make_square();
    builder.document["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", uri}}};
    return builder.document.dump();
}

model::Character load(const std::string& name, const std::string& bytes) {
    const tests::TemporaryFolder folder;
    return model::load_mesh(folder.write(name, bytes));
}

std::string complaint(const std::string& bytes) {
    try {
        load("odd.glb", bytes);
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        EXPECT_LT(text.substr(text.find("odd.glb")).size(), 200u) << text;
        EXPECT_NE(text.find("expected"), std::string::npos) << text;
        return text;
    }
    ADD_FAILURE() << "loaded";
    return {};
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string warnings_of(const model::Character& character) {
    std::string lines;
    for (const model::Warning& warning : character.warnings) lines += model::text_of(warning) + '\n';
    return lines;
}

TEST(GltfFiles, BuffersAreReadFromEveryKindOfDataUri) {
    const std::string data = base64(tests::make_square().binary);
    for (const char* head :
         {"data:;base64,", "data:application/octet-stream;charset=utf-8;base64,", "data:base64;base64,",
          "DATA:application/gltf-buffer;BASE64,", "data:text/plain;charset=US-ASCII;base64,"})
        EXPECT_EQ(load("square.gltf", square_at(head + data)).mesh.triangle_count(), 2u) << head;
    std::string escaped;
    for (const char c : tests::make_square().binary) {
        static constexpr char digits[] = "0123456789abcdef";
        escaped += {'%', digits[static_cast<unsigned char>(c) >> 4], digits[c & 15]};
    }
    EXPECT_EQ(load("square.gltf", square_at("data:," + escaped)).mesh.triangle_count(), 2u);
}

TEST(GltfFiles, DamagedDataUrisAreRefused) {
    const std::string data = base64(tests::make_square().binary);
    EXPECT_TRUE(contains(complaint(square_at("data:;base64" + data)), "comma"));
    EXPECT_TRUE(contains(complaint(square_at("data:;base64,*" + data)), "'*'"));
    EXPECT_TRUE(contains(complaint(square_at("data:;base64," + data.substr(8))), "buffer 0"));
}

TEST(GltfFiles, BuffersMayBeLongerThanTheySay) {
    const std::string binary = tests::make_square().binary;
    for (const std::size_t more : {std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
        const tests::TemporaryFolder folder;
        folder.write("long.bin", binary + std::string(more, 'x'));
        EXPECT_EQ(model::load_mesh(folder.write("a.gltf", square_at("long.bin"))).mesh.triangle_count(), 2u);
        const std::string uri = "data:;base64," + base64(binary + std::string(more, 'x'));
        EXPECT_EQ(load("a.gltf", square_at(uri)).mesh.triangle_count(), 2u);
    }
}

TEST(GltfFiles, BuffersAreFoundByOtherSpellings) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "data");
    folder.write("data/my square.bin", tests::make_square().binary);
    for (const char* uri : {"data/my%20square.bin", "data\\my square.bin", "Data/My%20Square.BIN"})
        EXPECT_EQ(model::load_mesh(folder.write("a.gltf", square_at(uri))).mesh.triangle_count(), 2u) << uri;
}

std::string chunk(const std::string& type, const std::string& bytes) {
    return tests::bytes_of_u32(static_cast<std::uint32_t>(bytes.size())) + type + bytes;
}

std::string glb_of(const std::string& chunks) {
    return "glTF" + tests::bytes_of_u32(2) + tests::bytes_of_u32(static_cast<std::uint32_t>(12 + chunks.size())) +
           chunks;
}

TEST(GltfFiles, ChunksOfOthersMeanNothing) {
    const std::string binary = tests::make_square().binary, bin("BIN\0", 4);
    const std::string inside = square_at("data:;base64," + base64(binary));
    GltfBuilder builder = tests::make_square();
    builder.glb();
    const std::string beside = builder.document.dump();
    for (const std::string& chunks :
         {chunk("JSON", inside), chunk("JSON", inside) + chunk("XTRA", "1234"),
          chunk("JSON", beside) + chunk("XTRA", "1234") + chunk(bin, binary),
          chunk("JSON", beside) + chunk(bin, binary) + chunk("XTRA", "") + chunk("MORE", "12345678")})
        EXPECT_EQ(load("a.glb", glb_of(chunks)).mesh.triangle_count(), 2u);
    EXPECT_EQ(load("a.vrm", glb_of(chunk("JSON", inside))).mesh.triangle_count(), 2u);
}

TEST(GltfFiles, JsonEndsAtItsFirstZero) {
    const std::string zero(1, '\0'), square = square_at("data:;base64," + base64(tests::make_square().binary));
    EXPECT_EQ(load("a.gltf", square + zero + zero).mesh.triangle_count(), 2u);
    EXPECT_EQ(load("a.glb", glb_of(chunk("JSON", square + zero + "\"open"))).mesh.triangle_count(), 2u);
    for (const std::string& text : {"4" + zero + "{\"open", "4" + zero + "{x:1}", "null" + zero + ":"})
        EXPECT_TRUE(contains(complaint(text), "no object")) << text;
}

TEST(GltfFiles, ChunksLongerThanTheFileAreRefused) {
    GltfBuilder builder = tests::make_square();
    builder.glb();
    const std::string text = chunk("JSON", builder.document.dump()), bin("BIN\0", 4);
    for (const std::uint32_t over : {1u, 8u, 0x7fffffffu}) {
        const auto length = static_cast<std::uint32_t>(builder.binary.size()) + over;
        const std::string chunks = text + tests::bytes_of_u32(length) + bin + builder.binary;
        EXPECT_TRUE(contains(complaint(glb_of(chunks)), "longer than its file")) << over;
    }
}

TEST(GltfFiles, VersionOneIsRefusedByName) {
    EXPECT_TRUE(contains(complaint(R"({"asset": {"version": "1.0"}, "accessors": {}})"), "glTF 1.0"));
    EXPECT_TRUE(contains(complaint(R"({"accessors": {}, "meshes": {}})"), "glTF 1.0"));
    EXPECT_TRUE(contains(complaint("glTF" + tests::bytes_of_u32(1) + std::string(32, '\0')), "glTF 1.0"));
}

TEST(GltfFiles, ClipsThatLackAPartAreLeftOutAlone) {
    const auto without = [](const char* place) {
        GltfBuilder builder = tests::make_everything();
        json& clips = builder.document["animations"];
        clips.push_back(clips[0]);
        clips[0]["name"] = "bad";
        const json::json_pointer pointer(place);
        clips[0][pointer.parent_pointer()].erase(pointer.back());
        return load("a.glb", builder.glb());
    };
    for (const char* place : {"/samplers/0/input", "/samplers/0/output"}) {
        const model::Character character = without(place);
        ASSERT_EQ(character.clips.size(), 1u) << place;
        EXPECT_EQ(character.clips[0].name, "wag");
        EXPECT_EQ(warnings_of(character), "clip that lacks a part, left out: 'bad'\n") << place;
    }
}

// The members that are read apart are found whatever stands around them.
TEST(GltfFiles, NamesWithBracesQuotesAndEscapesAreNoStructure) {
    GltfBuilder builder = tests::make_everything();
    const model::Character expected = tests::load(builder);
    builder.document["asset"]["generator"] = "\"}]\\,{[\" \u00fc \\";
    builder.document["asset"]["extras"] = {{"buffers", {1, 2}}, {"images", {{"meshes", "\\\""}}}};
    builder.document["aa"] = "\\";
    std::string text = (builder.glb(), builder.document.dump());
    text.replace(text.find("\"buffers\":[{"), 9, "\"\\u0062uffers\"");
    const model::Character character = load("a.glb", tests::make_glb(text, builder.binary));
    EXPECT_EQ(character.mesh.positions, expected.mesh.positions);
    EXPECT_EQ(character.mesh.textures.size(), 1u);
    EXPECT_EQ(character.clips.size(), expected.clips.size());
}

TEST(GltfFiles, RequiredExtensionsOfLooksAndLightsAreAccepted) {
    for (const char* name : {"KHR_lights_punctual", "KHR_materials_unlit", "KHR_materials_clearcoat",
                             "KHR_materials_variants", "EXT_texture_webp", "KHR_animation_pointer"}) {
        GltfBuilder builder = tests::make_square();
        builder.document["extensionsUsed"] = builder.document["extensionsRequired"] = {name};
        EXPECT_EQ(load("a.glb", builder.glb()).mesh.triangle_count(), 2u) << name;
    }
    for (const char* name : {"KHR_texture_basisu", "EXT_mesh_gpu_instancing", "XYZ_shape"}) {
        GltfBuilder builder = tests::make_square();
        builder.document["extensionsRequired"] = {name};
        EXPECT_TRUE(contains(complaint(builder.glb()), name));
    }
}

TEST(GltfFiles, MessagesStayShort) {
    const std::string longest(400'000, 'A');
    complaint(square_at(longest + ".bin"));
    complaint(square_at("data:" + longest));
    complaint(square_at("data:;base64,!" + longest));
    GltfBuilder builder = tests::make_square();
    builder.document["extensionsRequired"] = {longest};
    complaint(builder.glb());
}

TEST(GltfFiles, ClipsThatCantBePlayedAreLeftOut) {
    const std::string said = "clip with keys that can't be played, left out: 'wag'\n";
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const std::vector<float>& times : {std::vector<float>{-0.5f, 0.5f, 2},
                                            {0, 2, 0.5f},
                                            {0, nan, 2},
                                            {0, 1, std::numeric_limits<float>::infinity()}}) {
        GltfBuilder builder = tests::make_everything();
        for (json& sampler : builder.document["animations"][0]["samplers"]) sampler["input"] = builder.scalars(times);
        const model::Character character = load("a.glb", builder.glb());
        EXPECT_TRUE(character.clips.empty());
        EXPECT_EQ(warnings_of(character), said);
    }
    GltfBuilder builder = tests::make_everything();
    builder.document["animations"].push_back(builder.document["animations"][0]);
    builder.document["animations"][0]["samplers"][0]["interpolation"] = "BOUNCE";
    const model::Character character = load("a.glb", builder.glb());
    EXPECT_EQ(character.clips.size(), 1u);  // the other one
    EXPECT_EQ(warnings_of(character), said);
}

TEST(GltfFiles, ExtendedAnimationsKeepTheirPlainPart) {
    GltfBuilder extended = tests::make_everything();
    extended.document["animations"][0]["extensions"] = {{"XYZ_events", {{"x", 1}}}};
    const model::Character character = load("a.glb", extended.glb());
    ASSERT_EQ(character.clips.size(), 1u);
    EXPECT_EQ(character.clips[0].channels.size(), 2u);
    EXPECT_EQ(warnings_of(character), "extension of a clip, left out: 'wag'\n");

    GltfBuilder pointer = tests::make_everything();
    json& target = pointer.document["animations"][0]["channels"][1]["target"];
    target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/x"}}}}}};
    const model::Character other = load("a.glb", pointer.glb());
    ASSERT_EQ(other.clips.size(), 1u);
    EXPECT_EQ(other.clips[0].channels.size(), 1u);
    EXPECT_EQ(warnings_of(other), "channel of a clip that moves no bone or morph, left out: 'wag'\n");
}

}  // namespace
