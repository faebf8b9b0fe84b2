// STL and OFF, and all text formats packed by gzip.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "model/io/mesh_file.h"
#include "tests/model/folder.h"
#include "tests/model/gzip.h"
#include "tests/model/mesh_text.h"

namespace {

const std::string facet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 1 0\n    endloop\n  "
    "endfacet\n";

// One facet a colour, beside each other.
std::string binary_stl(std::string header, const std::vector<std::uint16_t>& spares) {
    header.resize(80, ' ');
    const auto count = static_cast<std::uint32_t>(spares.size());
    header.append(reinterpret_cast<const char*>(&count), 4);
    for (std::size_t i = 0; i < spares.size(); ++i) {
        const float x = static_cast<float>(i);
        const float numbers[12] = {0, 0, 0, x, 0, 0, x + 1, 0, 0, x, 1, 0};
        header.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
        header.append(reinterpret_cast<const char*>(&spares[i]), 2);
    }
    return header;
}

class StlOff : public testing::Test {
protected:
    model::Mesh load(const std::string& name, const std::string& bytes) {
        return model::load_mesh(folder_.write(name, bytes)).mesh;
    }
    std::string refusal(const std::string& name, const std::string& bytes) {
        try {
            load(name, bytes);
            return "";
        } catch (const std::runtime_error& error) {
            const std::string said = error.what(), start = (folder_ / name).string() + ": ";
            EXPECT_EQ(said.find(start), 0u) << said;
            return said.substr(start.size());
        }
    }

    tests::TemporaryFolder folder_;
};

TEST_F(StlOff, TextStlIsRead) {
    for (const std::string& text :
         std::vector<std::string>{"solid a\n" + facet + facet + "endsolid a\n",
                                  "SOLID\r\n" + facet + "endsolid\nsolid b\n" + facet + "endsolid"}) {
        const model::Mesh mesh = load("a.stl", text);
        EXPECT_EQ(mesh.triangle_count(), 2u);
        for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    }
    EXPECT_EQ(refusal("a.stl", "solid a\nvertex 0 0 0\nvertex 1 x 0\n"), "line 3: found 'x'; expected a number");
    EXPECT_EQ(refusal("a.stl", "solid a\nvertex 0 0 0\nvertex 1 nan 0\nvertex 1 1 1\nendloop\n"),
              "line 5: found vertex 1 of a face at no finite place; expected finite numbers");
    EXPECT_EQ(refusal("a.stl", "solid a\nendsolid\n"),
              "found no triangles; expected at least one face of three corners");
    EXPECT_EQ(refusal("a.stl", "solid a\nvertex 0 0 0\n"),
              "found the end of the file within a facet; expected endloop");
}

TEST_F(StlOff, BinaryStlIsRead) {
    for (const char* header : {"made by a test", "solid but binary", ""}) {
        const model::Mesh mesh = load("a.STL", binary_stl(header, {0, 0}));
        EXPECT_EQ(mesh.triangle_count(), 2u) << header;
        EXPECT_DOUBLE_EQ(tests::area_of(mesh), 1) << header;
        EXPECT_EQ(mesh.colors[0], glm::u8vec4(255)) << header;
    }
    const std::string whole = binary_stl("", {0, 0});
    EXPECT_EQ(refusal("a.stl", whole.substr(0, whole.size() - 1)),
              "found 2 facets in 99 bytes; expected as many as it holds");
    EXPECT_EQ(refusal("a.stl", "short"), "found no STL file; expected text from 'solid' on, or a header of 84 bytes");
}

TEST_F(StlOff, StlHasColorsInTheirTwoWays) {
    const model::Mesh from_blue = load("a.stl", binary_stl("", {0x8000 | 31 << 10, 31 << 10, 0x8000 | 31}));
    EXPECT_EQ(from_blue.colors[0], glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(from_blue.colors[3], glm::u8vec4(255));
    EXPECT_EQ(from_blue.colors[6], glm::u8vec4(0, 0, 255, 255));
    const model::Mesh magics = load("a.stl", binary_stl("COLOR=\x0a\x14\x1e\xff", {31, 0x8000}));
    EXPECT_EQ(magics.colors[0], glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(magics.colors[3], glm::u8vec4(10, 20, 30, 255));
}

TEST_F(StlOff, OffIsReadInItsKinds) {
    const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    for (const std::string& text :
         {"OFF\n4 1 0\n" + corners + "4 0 1 2 3\n", "OFF 4 1 0\n# a comment\n\n" + corners + "4 0 1 2 3",
          "4 1 4\n" + corners + "4 0 1 2 3 # all\n"})
        EXPECT_DOUBLE_EQ(tests::area_of(load("a.off", text)), 1) << text;
    EXPECT_DOUBLE_EQ(
        tests::area_of(load("a.off", "OFF\n6 1 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 0\n6 0 1 2 3 4 5\n")), 3);
    const std::string bytes = "0 0 0 255 0 128 255\n1 0 0 255 0 128 255\n1 1 0 255 0 128 255\n",
                      parts = "0 0 0 1 0 0.5 1\n1 0 0 1 0 0.5 1\n1 1 0 1 0 0.5 1\n";
    for (const std::string& text :
         {"COFF\n3 1 0\n" + bytes + "3 0 1 2\n", "COFF\n3 1 0\n" + parts + "3 0 1 2\n",
          "OFF\n3 1 0\n" + bytes + "3 0 1 2\n", std::string("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2 255 0 128\n")})
        EXPECT_EQ(load("a.off", text).colors[1], glm::u8vec4(255, 0, 128, 255)) << text;
    EXPECT_EQ(load("a.off", "NOFF\n3 1 0\n0 0 0 0 0.6 0.8\n1 0 0 0 0.6 0.8\n1 1 0 0 0.6 0.8\n3 0 1 2\n").normals[1],
              glm::vec3(0, 0.6f, 0.8f));
    EXPECT_EQ(
        load("a.off",
             "STCNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 1 0.5 0.5\n1 0 0 0 0 1 9 9 9 1 0 0\n1 1 0 0 0 1 9 9 9 1 1 1\n3 0 1 2\n")
            .triangle_count(),
        1u);
    EXPECT_EQ(refusal("a.off", "OFF BINARY\n"), "line 1: found a binary OFF file; expected a text");
    EXPECT_EQ(refusal("a.off", "4OFF\n1 1 0\n"),
              "line 1: found '4OFF'; expected OFF of three dimensions: OFF, COFF, NOFF, STOFF");
    EXPECT_EQ(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"), "line 4: found the end of the file; expected more data");
    EXPECT_EQ(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n"),
              "line 6: found vertex 3; expected 0 to below 3");
}

TEST_F(StlOff, PackedFilesAreReadAsWhatIsInThem) {
    const std::string obj = tests::obj_of(tests::make_cube());
    for (const char* name : {"a.obj.gz", "a.OBJ.GZ", "a.obj"})
        EXPECT_DOUBLE_EQ(tests::area_of(load(name, tests::gzip(obj))), 24) << name;
    EXPECT_EQ(model::load_mesh(folder_.write("a b.obj.gz", tests::gzip(obj))).name, "a b");
    for (const char* format : tests::ply_formats)
        EXPECT_DOUBLE_EQ(tests::area_of(load("a.ply.gz", tests::gzip(tests::ply_of(tests::make_cube(), format)))), 24)
            << format;
    EXPECT_DOUBLE_EQ(tests::area_of(load("a.stl.gz", tests::gzip(binary_stl("", {0, 0})))), 1);
    EXPECT_DOUBLE_EQ(tests::area_of(load("a.obj.gz", tests::gzip(obj.substr(0, 100)) + tests::gzip(obj.substr(100)))),
                     24);  // members
    EXPECT_DOUBLE_EQ(tests::area_of(load("a.obj.gz", tests::gzip(std::string(3'000'000, '\n') + obj))), 24);
    EXPECT_DOUBLE_EQ(tests::area_of(load("a.obj.gz", obj)), 24);  // not packed after all
    const std::string packed = tests::gzip(obj);
    EXPECT_NE(refusal("a.obj.gz", packed.substr(0, packed.size() - 9)).find("found a gzip file that ends too early"),
              std::string::npos);
    std::string damaged = packed;
    damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
    EXPECT_NE(refusal("a.obj.gz", damaged), "");
    EXPECT_NE(refusal("a.obj.gz", tests::gzip(std::string(100'000'000, '\n') + obj))
                  .find("found more than a hundred bytes a byte in a gzip file"),
              std::string::npos);
}

}  // namespace
