// What people's OBJ and PLY files have that their formats don't tell: each is read as its writer meant it, and what is
// lost is said.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/io/mesh_file.h"
#include "tests/model/gltf_builder.h"
#include "tests/model/mesh_text.h"

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string box = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
const std::string sides = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

std::string with_returns(std::string text) {
    for (char& c : text)
        if (c == '\n') c = '\r';
    return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

// An ascii PLY of these vertices and faces, with what more their properties are.
std::string ply(const std::string& vertex_properties, const std::vector<std::string>& vertices,
                const std::string& face_properties, const std::vector<std::string>& faces,
                const std::string& comments = "") {
    std::string text = "ply\nformat ascii 1.0\n" + comments + "element vertex " + std::to_string(vertices.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n" + vertex_properties +
                       "element face " + std::to_string(faces.size()) + "\nproperty list uchar int vertex_indices\n" +
                       face_properties + "end_header\n";
    for (const std::string& line : vertices) text += line + "\n";
    for (const std::string& line : faces) text += line + "\n";
    return text;
}

class Quirks : public testing::Test {
protected:
    model::Character load(const std::string& name, const std::string& bytes) {
        return model::load_mesh(folder_.write(name, bytes));
    }
    double area(const std::string& name, const std::string& bytes) { return tests::area_of(load(name, bytes).mesh); }

    // Colours that its vertices have: of a texture, that of its first texel.
    static std::set<std::vector<int>> colors(const model::Mesh& mesh) {
        std::set<std::vector<int>> all;
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            const std::uint8_t texture = mesh.material_of(i).texture;
            glm::u8vec4 color = mesh.colors[i];
            if (texture != model::no_texture) color = mesh.textures[texture].texels[0];
            all.insert({color.r, color.g, color.b});
        }
        return all;
    }

    tests::TemporaryFolder folder_;
};

TEST_F(Quirks, ConcavePolygonsHaveTheirArea) {
    EXPECT_DOUBLE_EQ(area("a.obj", "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n"), 3);
    EXPECT_DOUBLE_EQ(area("a.obj", "v -1 0 0\nv 0 .5 0\nv 1 0 0\nv 0 2 0\nf 1 2 3 4\n"), 1.5);
    EXPECT_DOUBLE_EQ(area("a.obj", "v 0 -1 0\nv 0 0 .5\nv 0 1 0\nv 0 0 2\nf 4 3 2 1\n"), 1.5);
    const std::vector<std::string> l{"2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0", "0 0 0"};
    EXPECT_DOUBLE_EQ(area("a.ply", ply("", l, "", {"6 0 1 2 3 4 5"})), 3);
    EXPECT_DOUBLE_EQ(area("a.ply", ply("", l, "", {"6 2 3 4 5 0 1"})), 3);
    // A frame, its hole joined by a bridge.
    EXPECT_DOUBLE_EQ(area("a.obj",
                          "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n"
                          "f 1 2 3 4 1 5 6 7 8 5\n"),
                     12);
    for (const glm::vec3& normal : load("a.ply", ply("", l, "", {"6 0 1 2 3 4 5"})).mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST_F(Quirks, LinesGoOnAfterABackslashAndBlanks) {
    for (const char* face : {"f 1 2 \\ \n3 4\n", "f 1 2 \\\t \r\n3 4\n", "f \\ \n1 2 \\  \n\\ \n3 4"})
        EXPECT_DOUBLE_EQ(area("a.obj", square + face), 1) << face;
    EXPECT_DOUBLE_EQ(area("a.obj", "v 0 0 \\ \n0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"), 0.5);
}

TEST_F(Quirks, CommentsAndNamesDontGoOn) {
    for (const char* line : {"# made in C:\\models\\\n", "#\\\n", "o C:\\models\\\n", "g a \\\n", "usemtl \\\n"})
        EXPECT_DOUBLE_EQ(area("a.obj", line + square + "f 1 2 3 4\n"), 1) << line;
    EXPECT_DOUBLE_EQ(area("a.obj", "v 0 0 0 # C:\\\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 # the end \\"), 1);
}

TEST_F(Quirks, LinesEndInCarriageReturns) {
    EXPECT_DOUBLE_EQ(area("a.obj", with_returns(square + "f 1 2 3 4\n")), 1);
    EXPECT_DOUBLE_EQ(area("a.obj", with_returns(square + "f 1 2 \\\n3 4")), 1);
    EXPECT_DOUBLE_EQ(area("a.obj", with_returns(square) + "f 1 2 3 4\r\n"), 1);
    EXPECT_DOUBLE_EQ(area("a.obj", replaced(square + "f 1 2 3 4\n", "\n", "\r\r\n")), 1);
    folder_.write("a.mtl", "newmtl a\rKd 1 0 0\r");
    EXPECT_EQ(colors(load("a.obj", with_returns("mtllib a.mtl\nusemtl a\n" + square + "f 1 2 3 4\n")).mesh),
              (std::set<std::vector<int>>{{255, 0, 0}}));
    // Longer than a block, with a return at its end.
    for (std::size_t size = 65'500; size < 65'570; ++size) {
        const std::string comment = "#" + std::string(size, 'x') + "\n";
        EXPECT_DOUBLE_EQ(area("a.obj", with_returns(comment + square + "f 1 2 3 4\n")), 1) << size;
        EXPECT_DOUBLE_EQ(area("a.obj", replaced(comment + square + "f 1 2 3 4\n", "\n", "\r\n")), 1) << size;
    }
    for (const std::string format : tests::ply_formats) {
        const std::string text = tests::ply_of(tests::make_cube(), format);
        const std::size_t end = text.find("end_header\n") + 11;
        const std::string head = with_returns(text.substr(0, end)), body = text.substr(end);
        EXPECT_DOUBLE_EQ(area("a.ply", head + (format == "ascii" ? with_returns(body) : body)), 24) << format;
    }
    // The first coordinate begins with a byte that is a line feed.
    tests::PlainMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}};
    const char bytes[] = {10, 0, 0, 0};
    std::memcpy(&triangle.positions[0].x, bytes, 4);
    const std::string text = tests::ply_of(triangle, "binary_little_endian");
    const std::size_t end = text.find("end_header\n") + 11;
    EXPECT_NEAR(area("a.ply", with_returns(text.substr(0, end)) + text.substr(end)), 0.5, 1e-6);
}

TEST_F(Quirks, NumbersThatAreNoneCostOnlyWhatTheyStandFor) {
    const std::pair<std::string, std::string> cases[] = {
        {square + "vn 0 0 1\nvn nan nan nan\nf 1//1 2//1 3//2\nf 1//1 3//1 4//1\n",
         "normal is no number, computed: 'line 6'"},
        {square + "vn 0 0 1\nvn -nan(ind) 0 1\nf 1//1 2//2 3//1 4//1\n", "normal is no number, computed: 'line 6'"},
        {square + "vn 0 0 1\nvn 1.#QNAN -1.#IND 1.#INF\nf 1//1 2//2 3//1 4//1\n",
         "normal is no number, computed: 'line 6'"},
        {square + "vt 0 0\nvt nan nan\nf 1/1 2/1 3/1 4/2\n", "texture coordinate is no number, set to 0: 'line 6'"},
        {square + "vt -inf 0\nvt 0 1e999\nf 1/1 2/1 3/1 4/2\n",
         "texture coordinate is no number, set to 0: 'line 5', and 1 more"},
        {square + "v 1 2 3 nan 0 0\nf 1 2 3 4\n", "vertex colour is no number, left white: 'line 5'"},
        {square + "v nan nan nan\nv inf 0 0\nf 1 2 3 4\n", ""}};
    for (const auto& [text, said] : cases) {
        const model::Character character = load("a.obj", text);
        EXPECT_DOUBLE_EQ(tests::area_of(character.mesh), 1) << text;
        for (const glm::vec3& normal : character.mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << text;
        EXPECT_EQ(tests::texts(character.warnings), said.empty() ? std::vector<std::string>() : std::vector{said});
    }
    const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
    for (const char* bad : {"nan nan nan", "inf 0 1", "-1.#IND 0 1"}) {
        const model::Character character =
            load("a.ply", ply(normals, {"0 0 0 0 0 1", std::string("1 0 0 ") + bad, "1 1 0 0 0 1", "0 1 0 0 0 1"}, "",
                              {"4 0 1 2 3"}));
        for (const glm::vec3& normal : character.mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << bad;
        EXPECT_EQ(tests::texts(character.warnings),
                  std::vector<std::string>{"normal is no number, computed: 'vertex 1'"});
    }
    for (const char* unused : {"nan nan nan", "0 inf 0", "1e400 0 0"}) {
        const model::Character character = load("a.ply", ply("", {"0 0 0", unused, "1 0 0", "1 1 0"}, "", {"3 0 2 3"}));
        EXPECT_EQ(character.mesh.vertex_count(), 3u) << unused;
        EXPECT_TRUE(character.warnings.empty()) << unused;
        EXPECT_THROW(load("a.ply", ply("", {"0 0 0", unused, "1 0 0"}, "", {"3 0 1 2"})), std::runtime_error) << unused;
    }
}

bool is_along_an_axis(const glm::vec3& n) {
    return std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) > 0.999f;
}

TEST_F(Quirks, SmoothingGroupsAreSmoothInThemselvesAlone) {
    for (const char* off : {"s off\n", "s 0\n", "s 1\ns off\n", "s\ns 0\n"}) {
        const model::Mesh mesh = load("a.obj", box + off + sides).mesh;
        EXPECT_EQ(mesh.vertex_count(), 24u) << off;
        for (const glm::vec3& normal : mesh.normals) EXPECT_TRUE(is_along_an_axis(normal)) << off;
    }
    for (const char* on : {"", "s 1\n", "s on\n", "s off\ns 3\n"}) {
        const model::Mesh mesh = load("a.obj", box + on + sides).mesh;
        EXPECT_EQ(mesh.vertex_count(), 8u) << on;
        for (const glm::vec3& normal : mesh.normals) EXPECT_FALSE(is_along_an_axis(normal)) << on;
    }
    // A roof: two sides of one group each, of which one comes back.
    const std::string roof = "v 0 1 0\nv 0 1 1\nv 1 0 0\nv 1 0 1\nv -1 0 0\nv -1 0 1\n";
    const model::Mesh mesh = load("a.obj", roof + "s 1\nf 1 2 4\ns 2\nf 2 1 5\ns 1\nf 1 4 3\ns 2\nf 2 5 6\n").mesh;
    EXPECT_EQ(mesh.vertex_count(), 8u);
    for (const glm::vec3& normal : mesh.normals) EXPECT_NEAR(std::abs(normal.x), std::sqrt(0.5f), 1e-6f);
    // Given normals are what counts.
    EXPECT_EQ(load("a.obj", square + "vn 0 0.6 0.8\ns off\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n").mesh.vertex_count(),
              4u);
}

TEST_F(Quirks, TexturesOfOtherMachinesAreFoundBesideTheFile) {
    folder_.write("mw.png", tests::make_png(1, 1, "\x0a\xc8\x1e"));
    const std::string text =
        "mtllib m.mtl\nusemtl t\n" + square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    for (const char* map :
         {"map_Kd C:\\work\\maps\\mw.png", "map_Kd \"MW.PNG\"", "map_Kd -s 1 1 1 -clamp on /home/a b/Mw.png",
          "map_Kd -bm 0.5 -o 0 0 maps\\mw.png ", "\tmap_Kd .\\mw.png"}) {
        folder_.write("m.mtl", std::string("newmtl t\n") + map + "\n");
        const model::Character character = load("a.obj", text);
        EXPECT_EQ(colors(character.mesh), (std::set<std::vector<int>>{{10, 200, 30}})) << map;
        EXPECT_TRUE(character.warnings.empty()) << map;
    }
}

TEST_F(Quirks, ScansFarFromTheOriginKeepTheirShape) {
    const auto height = [](int x, int y) { return 100 + 0.05 * ((7 * x + 3 * y) % 5); };
    const glm::dvec3 corner(500000.37, 5800000.61, 0);
    std::string obj;
    tests::PlainMesh here;
    std::vector<std::string> lines, faces;
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 9; ++x) {
            char line[100];
            std::snprintf(line, sizeof line, "%.3f %.3f %.3f", corner.x + 0.1 * x, corner.y + 0.1 * y, height(x, y));
            lines.push_back(line);
            obj += std::string("v ") + line + "\n";
            here.positions.emplace_back(0.1 * x, 0.1 * y, height(x, y) - 100);
        }
    }
    for (std::uint32_t i = 0; i < 71; ++i) {
        if (i % 9 == 8) continue;
        for (const auto& [b, c] : {std::pair(i + 1, i + 10), std::pair(i + 10, i + 9)}) {
            here.faces.push_back({i, b, c});
            faces.push_back("3 " + std::to_string(i) + " " + std::to_string(b) + " " + std::to_string(c));
            obj += "f " + std::to_string(i + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
        }
    }
    const double right = area("near.obj", tests::obj_of(here));
    std::string off = "OFF\n" + std::to_string(lines.size()) + " " + std::to_string(faces.size()) + " 0\n";
    for (const auto* list : {&lines, &faces})
        for (const std::string& line : *list) off += line + "\n";
    const std::string in_doubles = replaced(ply("", lines, "", faces), "property float", "property double");
    for (const auto& [name, bytes] :
         {std::pair<const char*, std::string>{"a.obj", obj}, {"a.ply", in_doubles}, {"a.off", off}}) {
        const model::Mesh mesh = load(name, bytes).mesh;
        EXPECT_NEAR(tests::area_of(mesh), right, 1e-6 * right) << name;
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            // Vertices of an OBJ are in the order of its faces.
            const glm::dvec3 world = mesh.origin + glm::dvec3(mesh.positions[i]);
            double nearest = INFINITY;
            for (const glm::vec3& p : here.positions)
                nearest = std::min(nearest, glm::distance(world, corner + glm::dvec3(0, 0, 100) + glm::dvec3(p)));
            EXPECT_LT(nearest, 2e-7) << name;
        }
    }
    EXPECT_EQ(load("near.obj", tests::obj_of(here)).mesh.origin, glm::dvec3(0.0));
}

TEST_F(Quirks, TristripsAreTriangles) {
    const std::string head =
        "property float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int "
        "vertex_indices\nend_header\n";
    const std::string corners = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n3 0 0\n2 1 0\n";
    const std::string start = "ply\nformat ascii 1.0\nelement vertex 7\n";
    for (const auto& [strips, right] : {std::pair<const char*, double>{"9 0 1 2 3 -1 4 5 6 -1", 1.5},
                                        {"4 0 1 2 3", 1},
                                        {"7 -1 -1 4 5 6 -1 0", 0.5},
                                        {"6 0 1 2 3 3 3", 1}}) {
        const model::Mesh mesh = load("a.ply", start + head + corners + strips + "\n").mesh;
        EXPECT_DOUBLE_EQ(tests::area_of(mesh), right) << strips;
        for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << strips;
    }
    EXPECT_THROW(load("a.ply", start + head + corners + "4 0 1 2 -2\n"), std::runtime_error);
}

TEST_F(Quirks, ColorsOfPlyHaveManyNames) {
    const std::set<std::vector<int>> right{{9, 99, 199}};
    const auto rgb = [](const std::string& type, const std::string& before) {
        std::string properties;
        for (const char* name : {"red", "green", "blue"}) properties += "property " + type + " " + before + name + "\n";
        return properties;
    };
    const auto vertices = [](const std::string& color) {
        return std::vector<std::string>{"0 0 0 " + color, "1 0 0 " + color, "1 1 0 " + color};
    };
    EXPECT_EQ(colors(load("a.ply", ply(rgb("uchar", "diffuse_"), vertices("9 99 199"), "", {"3 0 1 2"})).mesh), right);
    EXPECT_EQ(colors(load("a.ply", ply(rgb("uint8", ""), vertices("9 99 199"), "", {"3 0 1 2"})).mesh), right);
    EXPECT_EQ(colors(load("a.ply", ply(rgb("float", "diffuse_"), vertices("0.0353 0.388 0.78"), "", {"3 0 1 2"})).mesh),
              right);
    // On faces: the corners that two share are two vertices, and the surface is smooth across them.
    const std::vector<std::string> roof{"0 1 0", "0 1 1", "1 0 0", "-1 0 1"};
    for (const std::string before : {"", "diffuse_"}) {
        const model::Mesh mesh = load("a.ply", ply("", roof, rgb("uchar", before) + "property uchar alpha\n",
                                                   {"3 0 1 2 255 0 0 255", "3 1 0 3 0 0 255 0"}))
                                     .mesh;
        EXPECT_EQ(colors(mesh), (std::set<std::vector<int>>{{255, 0, 0}, {0, 0, 255}})) << before;
        EXPECT_EQ(mesh.vertex_count(), 6u);
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            const bool ridge = mesh.positions[i].x == 0;
            EXPECT_TRUE(!ridge || std::abs(mesh.normals[i].y) > 0.999f);
        }
    }
    const model::Character bad = load("a.ply", ply(rgb("float", ""), vertices("nan 0 0"), "", {"3 0 1 2"}));
    EXPECT_EQ(tests::texts(bad.warnings),
              std::vector<std::string>{"colour is no number, left white: 'nan', and 2 more"});
}

TEST_F(Quirks, PlyHasTextures) {
    folder_.write("t one.png", tests::make_png(1, 1, "\x0a\xc8\x1e"));
    folder_.write("two.png", tests::make_png(1, 1, "\x1e\xc8\x0a"));
    const std::string one = "comment TextureFile t one.png\n", two = one + "comment TextureFile C:\\two.png\n";
    const std::vector<std::string> vertices{"0 0 0 0 0", "1 0 0 1 0", "1 1 0 1 1"}, plain{"0 0 0", "1 0 0", "1 1 0"};
    for (const auto& [u, v] : {std::pair("texture_u", "texture_v"), {"s", "t"}, {"u", "v"}}) {
        const std::string uv = std::string("property float ") + u + "\nproperty float " + v + "\n";
        const model::Mesh mesh = load("a.ply", ply(uv, vertices, "", {"3 0 1 2"}, one)).mesh;
        EXPECT_EQ(colors(mesh), (std::set<std::vector<int>>{{10, 200, 30}})) << u;
        EXPECT_EQ(mesh.uvs[2], glm::vec2(1, 0)) << u;  // from the top
    }
    const std::string wedges = "property list uchar float texcoord\nproperty int texnumber\n";
    const model::Mesh mesh = load("a.ply", ply("", {"0 0 0", "1 0 0", "1 1 0", "0 1 0"}, wedges,
                                               {"3 0 1 2 6 0 0 1 0 1 1 0", "3 0 2 3 6 0 0 1 1 0 1 1"}, two))
                                 .mesh;
    EXPECT_EQ(mesh.vertex_count(), 6u);
    EXPECT_EQ(colors(mesh), (std::set<std::vector<int>>{{10, 200, 30}, {30, 200, 10}}));
    EXPECT_EQ(mesh.uvs[mesh.indices[2]], glm::vec2(1, 0));
    // What is missing leaves the surface as it is without, and is said.
    const std::string gone = "comment TextureFile gone.png\n";
    const std::string uv = "property float s\nproperty float t\n";
    EXPECT_EQ(tests::texts(load("a.ply", ply(uv, vertices, "", {"3 0 1 2"}, gone)).warnings),
              std::vector<std::string>{"texture not found, left out: 'gone.png'"});
    EXPECT_EQ(tests::texts(load("a.ply", ply("", plain, "", {"3 0 1 2"}, one)).warnings),
              std::vector<std::string>{"texture without coordinates, left out: 't one.png'"});
    EXPECT_EQ(
        tests::texts(
            load("a.ply", ply("", plain, "property list uchar float texcoord\n", {"3 0 1 2 4 0 0 1 1"}, one)).warnings),
        std::vector<std::string>{"texture coordinates not one a corner, left out"});
}

TEST_F(Quirks, FacesOfPlyMayComeBeforeTheirVertices) {
    const std::string text =
        "ply\nformat ascii 1.0\nobj_info a b\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 6\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n6 0 1 2 3 4 5\n2 0 0\n2 1 0\n1 1 0\n1 2 "
        "0\n0 2 0\n0 0 0\n";
    EXPECT_DOUBLE_EQ(area("a.ply", text), 3);
}

}  // namespace
