// Wavefront OBJ, line by line.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "model/io/mesh_file.h"
#include "tests/model/gltf_builder.h"
#include "tests/model/mesh_text.h"

namespace {

using model::Mesh;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class Obj : public testing::Test {
protected:
    Mesh load(const std::string& text) { return model::load_mesh(folder_.write("mesh.obj", text)).mesh; }

    // The refusal, without the file's name; empty if it loads.
    std::string refusal(const std::string& text) {
        try {
            load(text);
            return "";
        } catch (const std::runtime_error& error) {
            const std::string said = error.what(), name = (folder_ / "mesh.obj").string() + ": ";
            EXPECT_EQ(said.find(name), 0u) << said;
            EXPECT_EQ(said.find('\n'), std::string::npos) << said;
            return said.substr(name.size());
        }
    }

    tests::TemporaryFolder folder_;
};

TEST_F(Obj, FacesOfAnySizeAreFans) {
    const Mesh mesh = load(square + "v 0.5 2 0\nf 1 2 3 5 4\n");
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4}));
    EXPECT_DOUBLE_EQ(tests::area_of(mesh), 1.5);
}

TEST_F(Obj, EveryWayToNameACornerIsRead) {
    for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f -4 -3 -2",
                             "f -4/-3/-1 -3/-2/-1 -2/-1/-1", "f\t+1/ 2/2/ 3//1 ", "f 1 \\\n 2 \\\r\n3"}) {
        const Mesh mesh = load(square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\n" + face + "\n");
        EXPECT_DOUBLE_EQ(tests::area_of(mesh), 0.5) << face;
        for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << face;
    }
}

TEST_F(Obj, CommentsAndAByteOrderMarkAreNoValues) {
    const Mesh mesh = load(
        "\xEF\xBB\xBFv 0 0 0 # the first\nv 1 0 0# 1 0 0\nv 0 1 0 #\nvt 0 0 # a\nvn 0 0 1 # b\nf 1/1/1 2/1/1 3/1/1 # "
        "1\n");
    EXPECT_EQ(mesh.vertex_count(), 3u);
    EXPECT_DOUBLE_EQ(tests::area_of(mesh), 0.5);
    EXPECT_EQ(mesh.colors[1], glm::u8vec4(255));
    EXPECT_EQ(refusal(square + "f 1 2 # 3\n"), "found no triangles; expected at least one face of three corners");
}

TEST_F(Obj, CornersOfOneLookAreOneVertex) {
    EXPECT_EQ(load(square + "f 1 2 3\nf 1 3 4\n").vertex_count(), 4u);
    EXPECT_EQ(load(square + "vt 0 0\nf 1 2 3\nf 1/1 3 4\n").vertex_count(), 5u);
    EXPECT_EQ(
        load(square + "vn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//1\nf 1//1 3//2 4//2\nf 1//1 3//1 4//2\n").vertex_count(), 5u);
}

TEST_F(Obj, TextureCoordinatesCountFromTheTop) {
    const Mesh mesh = load(square + "vt 0.25 0.125 0.5\nvt 0.75\nf 1/1 2/2 3\n");
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0.25f, 0.875f));
    EXPECT_EQ(mesh.uvs[1], glm::vec2(0.75f, 1.0f));
}

TEST_F(Obj, SeamsOfLooksAreNoCreases) {
    // A roof whose two sides differ in their texture coordinates alone.
    const Mesh mesh = load("v 0 0 -1\nv 0 0 1\nv 1 -1 0\nv -1 -1 0\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 2/2 1/2 4/2\n");
    ASSERT_EQ(mesh.vertex_count(), 6u);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        if (mesh.positions[i].x != 0.0f) continue;
        EXPECT_NEAR(mesh.normals[i].y, 1.0f, 1e-6f);
    }
}

TEST_F(Obj, VertexColorsAreRead) {
    const Mesh mesh = load("v 0 0 0 1 0 0.5\nv 1 0 0 7\nv 1 1 0 0.2 2 -1\nf 1 2 3\n");
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(255, 0, 128, 255));
    EXPECT_EQ(mesh.colors[1], glm::u8vec4(255));  // a w is no colour
    EXPECT_EQ(mesh.colors[2], glm::u8vec4(51, 255, 0, 255));
}

TEST_F(Obj, MaterialsColorTheirFaces) {
    folder_.write("my looks.mtl",
                  "newmtl red one\nKd 1 0 0\n\nnewmtl half\n  Kd 0.5\nnewmtl gone\nKd 0 1 0\nmap_Kd none.png\n"
                  "newmtl painted\nKd 0 0 0\nmap_Kd -s 1 1 1 -o 0.5 -clamp on textures\\a b.png\n");
    std::filesystem::create_directory(folder_ / "textures");
    folder_.write("textures/a b.png", tests::make_png(2, 1, "\xff\x20\x10\x01\x02\x03"));
    const Mesh mesh = load("mtllib my looks.mtl\n" + square +
                           "v 0 2 0 0.5 1 1\nvt 0 0\nf 1 2 3\nusemtl red one\nf 1 2 3\nf 5 2 3\nusemtl half\nf 1 2 3\n"
                           "usemtl gone\nf 1/1 2/1 3/1\nusemtl painted\nf 1/1 2/1 3\nusemtl unknown\nf 1 2 3\n");
    const auto color = [&](std::size_t face) { return mesh.colors[mesh.indices[3 * face]]; };
    const auto texture = [&](std::size_t corner) { return mesh.material_of(mesh.indices[corner]).texture; };
    EXPECT_EQ(color(0), glm::u8vec4(255));
    EXPECT_EQ(color(1), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(color(2), glm::u8vec4(128, 0, 0, 255));
    EXPECT_EQ(color(3), glm::u8vec4(128, 128, 128, 255));
    EXPECT_EQ(color(4), glm::u8vec4(0, 255, 0, 255));
    EXPECT_EQ(texture(12), model::no_texture);
    EXPECT_EQ(color(5), glm::u8vec4(255));
    EXPECT_EQ(texture(15), 0);
    EXPECT_EQ(texture(17), model::no_texture);  // a corner without vt
    EXPECT_EQ(color(6), glm::u8vec4(255));
    ASSERT_EQ(mesh.textures.size(), 1u);
    EXPECT_EQ(mesh.textures[0].width, 2);
    EXPECT_EQ(mesh.textures[0].texels[0], glm::u8vec4(255, 32, 16, 255));
}

TEST_F(Obj, ATextureWithoutCoordinatesIsSaid) {
    folder_.write("a.mtl", "newmtl painted\nmap_Kd a.png\n");
    folder_.write("a.png", tests::make_png(1, 1, "abc"));
    const auto warnings_of = [&](const std::string& faces) {
        const std::string text = "mtllib a.mtl\n" + square + "vt 0 0\nusemtl painted\n" + faces;
        std::string lines;
        for (const model::Warning& warning : model::load_mesh(folder_.write("a.obj", text)).warnings)
            lines += model::text_of(warning);
        return lines;
    };
    EXPECT_EQ(warnings_of("f 1/1 2/1 3/1\n"), "");
    EXPECT_EQ(warnings_of("f 1/1 2 3\n"), "texture without coordinates, left out: 'vertex 2', and 1 more");
}

// Two libraries, two textures, two looks by turns: no face has another's.
TEST_F(Obj, FacesKeepTheLookThatIsInUse) {
    folder_.write("a.mtl", "newmtl one\nKd 1 0 0\nmap_Kd one.png\nnewmtl plain\nKd 0 0 1\n");
    folder_.write("b.mtl", "newmtl two\nKd 0 1 0\nmap_Kd two.png\nnewmtl same\nmap_Kd two.png\n");
    folder_.write("one.png", tests::make_png(1, 1, "abc"));
    folder_.write("two.png", tests::make_png(1, 1, "xyz"));
    const std::string corners = "f 1/1/1 2/2/1 3/3/2\n";
    std::string text =
        "mtllib a.mtl b.mtl\n" + square + "vt 0.1 0.9\nvt 0.2 0.8\nvt 0.3 0.7\nvn 0 0 1\nvn 0 1 0\n" + corners;
    const char* looks[] = {"two", "one", "plain", "two", "same", "one"};
    for (const char* look : looks) text += std::string("usemtl ") + look + "\n" + corners;
    const Mesh mesh = load(text);
    ASSERT_EQ(mesh.triangle_count(), 7u);
    EXPECT_EQ(mesh.vertex_count(), 3u * 5);  // looks that come again share their vertices
    EXPECT_EQ(mesh.textures.size(), 2u);
    struct Expected {
        glm::u8vec4 color;
        char texel;  // 0: no texture
    };
    const Expected white{glm::u8vec4(255), 0}, one{{255, 0, 0, 255}, 'a'}, two{{0, 255, 0, 255}, 'x'},
        plain{{0, 0, 255, 255}, 0}, same{glm::u8vec4(255), 'x'};
    const Expected expected[] = {white, two, one, plain, two, same, one};
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const std::uint32_t vertex = mesh.indices[corner];
        const Expected& look = expected[corner / 3];
        EXPECT_EQ(mesh.colors[vertex], look.color) << corner;
        const std::uint8_t texture = mesh.material_of(vertex).texture;
        ASSERT_EQ(texture == model::no_texture, look.texel == 0) << corner;
        if (look.texel != 0) {
            EXPECT_EQ(mesh.textures[texture].texels[0].r, look.texel) << corner;
        }
        const float n = 0.1f * static_cast<float>(corner % 3 + 1);
        EXPECT_LT(glm::distance(mesh.uvs[vertex], glm::vec2(n, n)), 1e-6f) << corner;
        EXPECT_EQ(mesh.normals[vertex], corner % 3 == 2 ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1)) << corner;
    }
}

TEST_F(Obj, AColorMultipliesItsTextureUnlessItIsBlack) {
    folder_.write("a.mtl",
                  "newmtl half\nKd 0.5 1 0\nmap_Kd a.png\nnewmtl black\nKd 0 0 0\nmap_Kd a.png\n"
                  "newmtl dark\nKd 0 0 0\nnewmtl spectral\nKd spectral file.rfl\n");
    folder_.write("a.png", tests::make_png(1, 1, "abc"));
    const Mesh mesh = load("mtllib a.mtl\n" + square +
                           "vt 0 0\nusemtl half\nf 1/1 2/1 3/1\nusemtl black\nf 1/1 2/1 3/1\nusemtl dark\nf 1 2 3\n"
                           "usemtl spectral\nf 1 2 3\n");
    EXPECT_EQ(mesh.colors[mesh.indices[0]], glm::u8vec4(128, 255, 0, 255));
    EXPECT_EQ(mesh.colors[mesh.indices[3]], glm::u8vec4(255));
    EXPECT_EQ(mesh.colors[mesh.indices[6]], glm::u8vec4(0, 0, 0, 255));
    EXPECT_EQ(mesh.colors[mesh.indices[9]], glm::u8vec4(255));
    EXPECT_EQ(mesh.textures.size(), 1u);
}

TEST_F(Obj, MaterialsMultiplyVertexColorsAsLight) {
    folder_.write("a.mtl", "newmtl a\nKd 0.73725 0.5 1\n");  // sRGB's codes 188 (half of the light), 128 and 255
    const Mesh mesh = load("mtllib a.mtl\nv 0 0 0 0.73725 1 0.2\nv 1 0 0\nv 0 1 0 1 0.4 1\nusemtl a\nf 1 2 3\n");
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(138, 128, 51, 255));  // half of half the light
    EXPECT_EQ(mesh.colors[1], glm::u8vec4(188, 128, 255, 255));
    EXPECT_EQ(mesh.colors[2], glm::u8vec4(188, 47, 255, 255));  // 13.3 % times 21.6 % of the light
}

TEST_F(Obj, NegativeIndicesCountFromWhatIsReadSoFar) {
    const Mesh mesh = load(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nvn 1 0 0\nf -3/-1/-1 -2/-1/-1 -1/-1/-1\n"
        "v 5 0 0\nv 6 0 0\nv 5 1 0\nvt 0.25 0.25\nvn 0 1 0\nf -3/-1/-1 -2/-1/-1 -1/-2/-2\n");
    ASSERT_EQ(mesh.triangle_count(), 2u);
    const auto at = [&](std::size_t corner) { return mesh.indices[corner]; };
    EXPECT_EQ(mesh.positions[at(1)], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.positions[at(4)], glm::vec3(6, 0, 0));
    EXPECT_EQ(mesh.uvs[at(0)], glm::vec2(0.5f));
    EXPECT_EQ(mesh.uvs[at(3)], glm::vec2(0.25f, 0.75f));
    EXPECT_EQ(mesh.normals[at(0)], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.normals[at(3)], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.normals[at(5)], glm::vec3(1, 0, 0));
}

TEST_F(Obj, MissingLibrariesAreNoError) {
    for (const char* line : {"mtllib none.mtl", "mtllib none.mtl other.mtl", "mtllib", "mtllib /dev/zero", "mtllib ."})
        EXPECT_EQ(load(line + ("\nusemtl a\n" + square) + "f 1 2 3\n").colors[0], glm::u8vec4(255)) << line;
}

TEST_F(Obj, WhatIsWrongWithMaterialsIsSaid) {
    const std::string text = "mtllib a.mtl\nusemtl a\n" + square + "vt 0 0\nf 1/1 2/1 3/1\n";
    folder_.write("a.png", "no image at all, but bytes enough for one");
    const std::pair<const char*, const char*> cases[] = {
        {"newmtl a\nKd nan nan nan\n", "material colour is no number, left white: 'Kd nan nan nan'"},
        {"newmtl a\nKd 1 -inf 0\n", "material colour is no number, left white: 'Kd 1 -inf 0'"},
        {"newmtl a\nKd 1 red 0\n", "material colour is no number, left white: 'Kd 1 red 0'"},
        {"newmtl a\nmap_Kd a.png\n", "texture is in an unknown format, left out: 'a.png'"},
        {"newmtl a\nmap_Kd none.png\n", "texture not found, left out: 'none.png'"},
        {"newmtl b\nKd 1 0 0\n", "material not found, left white: 'a'"}};
    for (const auto& [library, said] : cases) {
        folder_.write("a.mtl", library);
        const model::Character character = model::load_mesh(folder_.write("mesh.obj", text));
        EXPECT_EQ(character.mesh.colors[0], glm::u8vec4(255)) << library;
        EXPECT_TRUE(character.mesh.textures.empty()) << library;
        EXPECT_EQ(tests::texts(character.warnings), std::vector<std::string>{said});
    }
}

TEST_F(Obj, EverythingElseIsSkipped) {
    EXPECT_EQ(
        load("\xEF\xBB\xBF# with a byte order mark\no a\ng b c\ns off\n\n  \t\nl 1 2\np 1\ncstype bezier\nfoo nan\n" +
             square + "vp 1 2\nf 1 2\nf 3\nf\nf 1 2 3")
            .triangle_count(),
        1u);
}

TEST_F(Obj, DegenerateAndDuplicateFacesAreHarmless) {
    const Mesh mesh = load(square + "v 9 9 9\nf 1 1 1\nf 1 2 2\nf 1 2 3\nf 1 2 3\n");
    EXPECT_EQ(mesh.triangle_count(), 4u);
    EXPECT_EQ(mesh.vertex_count(), 3u);  // what no face uses is gone
}

TEST_F(Obj, BadLinesAreNamed) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"v 1 nan 2\nf 1 2 5", "found vertex 5 of a face at no finite place; expected finite numbers"},
        {"v 1e400 2 3\nf 1 2 5", "found vertex 5 of a face at no finite place; expected finite numbers"},
        {"v 1 2 -1.#IND\nf 1 5 2", "found vertex 5 of a face at no finite place; expected finite numbers"},
        {"v 1 2", "found the end of the line; expected a number"},
        {"v 1,5 2 3", "found '1,5'; expected a number"},
        {"v 0x10 2 3", "found '0x10'; expected a number"},
        {"v +-1 2 3", "found '+-1'; expected a number"},
        {"f 1 2 9", "found vertex 9; expected 1 to 4"},
        {"f 1 2 0", "found vertex 0; expected 1 to 4"},
        {"f 1 2 -5", "found vertex -5; expected 1 to 4"},
        {"f 1 2 9223372036854775807", "found vertex 9223372036854775807; expected 1 to 4"},
        {"f 1 2 -9223372036854775808", "found vertex -9223372036854775808; expected 1 to 4"},
        {"f 1 2 99999999999999999999", "found '99999999999999999999'; expected a whole number"},
        {"f 1 2 1.5", "found '1.5'; expected a whole number"},
        {"f 1 2 a", "found 'a'; expected a whole number"},
        {"f 1/1 2 3", "found texture coordinate 1; expected one that is defined before"},
        {"f 1//1 2 3", "found normal 1; expected one that is defined before"},
        {"f 1/2/3/4 2 3", "found texture coordinate 2; expected one that is defined before"},
        {"v 1 2 " + std::string(100, 'x'), "found '" + std::string(40, 'x') + "...'; expected a number"}};
    for (const auto& [line, said] : cases) {
        const std::string number = line.find('\n') == std::string::npos ? "5" : "6";
        EXPECT_EQ(refusal(square + line + "\nf 1 2 3\n"), "line " + number + ": " + said);
    }
    EXPECT_EQ(refusal(square + "f 1 \\\n2 \\\n9\n"), "line 5: found vertex 9; expected 1 to 4");
}

TEST_F(Obj, TinyNumbersAreZero) {
    const std::string zeros(60, '0');
    const Mesh mesh = load("v 1e-400 1E-60 0." + zeros + "1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(mesh.positions[0], glm::vec3(0.0f));
}

TEST_F(Obj, FilesWithoutTrianglesAreRefused) {
    for (const std::string& text : {std::string(), std::string("\n"), square, square + "f 1 2\n", std::string("glTF")})
        EXPECT_EQ(refusal(text), "found no triangles; expected at least one face of three corners");
}

TEST_F(Obj, LinesWithoutEndAreRefused) {
    EXPECT_EQ(refusal(square + "f 1 2 3\n# " + std::string(std::size_t{17} << 20, 'x')),
              "line 5: found a line over 16 MiB; expected shorter ones");
    std::string continued = square + "f 1 2 3 \\\n";
    for (int i = 0; i < 20; ++i) continued += std::string(std::size_t{1} << 20, ' ') + "\\\n";
    EXPECT_EQ(refusal(continued), "line 5: found a line over 16 MiB; expected shorter ones");
}

// All corners are of one position, each of a look of its own: quadratic time would take minutes.
TEST_F(Obj, ManyLooksOfOnePositionTakeLinearTime) {
    std::string text = square;
    for (int i = 0; i < 200000; ++i) text += "vt 0 0\nf 1/-1 2 3\n";
    EXPECT_EQ(load(text).triangle_count(), 200000u);
}

}  // namespace
