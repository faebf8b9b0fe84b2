// PLY meshes: what headers may say, and what they must not.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "model/io/mesh_file.h"
#include "pointsample/points_file.h"
#include "tests/model/folder.h"
#include "tests/model/mesh_text.h"
#include "tests/pointsample/models.h"

namespace {

using model::Mesh;

class Ply : public testing::Test {
protected:
    Mesh load(const std::string& bytes) { return model::load_mesh(folder_.write("mesh.ply", bytes)).mesh; }

    // The refusal, without the file's name; empty if it loads.
    std::string refusal(const std::string& bytes) {
        try {
            load(bytes);
            return "";
        } catch (const std::runtime_error& error) {
            const std::string said = error.what(), name = (folder_ / "mesh.ply").string() + ": ";
            EXPECT_EQ(said.find(name), 0u) << said;
            EXPECT_EQ(said.find('\n'), std::string::npos) << said;
            return said.substr(name.size());
        }
    }

    tests::TemporaryFolder folder_;
};

// Everything out of order, of other types, and between what we know what we don't.
std::string odd_file(const std::string& format, const std::string& line_end = "\n") {
    std::ostringstream header;
    for (const std::string& line : {std::string("ply"),
                                    "format " + format + " 1.0",
                                    std::string("obj_info x"),
                                    std::string("element camera 1"),
                                    std::string("property double view"),
                                    std::string("property list uint8 short names"),
                                    std::string("element face 2"),
                                    std::string("property uchar flags"),
                                    std::string("property list uint ushort vertex_index"),
                                    std::string("property list char float texcoord"),
                                    std::string("element vertex 5"),
                                    std::string("property float quality"),
                                    std::string("property double z"),
                                    std::string("property float green"),
                                    std::string("property float red"),
                                    std::string("property float blue"),
                                    std::string("property list int8 double more"),
                                    std::string("property float32 x"),
                                    std::string("property short y"),
                                    std::string("element edge 1"),
                                    std::string("property int vertex1"),
                                    std::string("end_header")})
        header << line << line_end;
    tests::PlyValues values(format);
    values.put(2.5);
    values.put(std::uint8_t{2});
    values.put(std::int16_t{-7});
    values.put(std::int16_t{8});
    values.end_record();
    for (const std::vector<std::uint16_t>& face : {std::vector<std::uint16_t>{0, 1, 2, 3}, {3, 2}}) {
        values.put(std::uint8_t{9});
        values.put(static_cast<std::uint32_t>(face.size()));
        for (const std::uint16_t corner : face) values.put(corner);
        values.put(std::int8_t{1});
        values.put(0.5f);
        values.end_record();
    }
    const std::vector<std::pair<int, int>> places{{0, 0}, {2, 0}, {2, 3}, {0, 3}, {50, 50}};
    for (const auto& [x, y] : places) {
        values.put(0.25f);
        values.put(-1.5);
        for (const float channel : {0.5f, 1.0f, 0.0f}) values.put(channel);
        values.put(static_cast<std::int8_t>(x % 3));
        for (int i = 0; i < x % 3; ++i) values.put(0.125);
        values.put(static_cast<float>(x));
        values.put(static_cast<std::int16_t>(y));
        values.end_record();
    }
    values.put(std::int32_t{1});
    values.end_record();
    return header.str() + values.str();
}

TEST_F(Ply, AnyOrderAnyTypesAndAnythingElseAreRead) {
    for (const char* format : tests::ply_formats)
        for (const char* line_end : {"\n", "\r\n"}) {
            SCOPED_TRACE(format);
            const Mesh mesh = load(odd_file(format, line_end));
            EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
            EXPECT_EQ(mesh.vertex_count(), 4u);  // the fifth is of no face
            EXPECT_EQ(mesh.positions[2], glm::vec3(2, 3, -1.5f));
            EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
            EXPECT_EQ(mesh.colors[0], glm::u8vec4(255, 128, 0, 255));
        }
}

TEST_F(Ply, SixteenBitColorsAreScaled) {
    const Mesh mesh = load(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
        "ushort "
        "red\nproperty ushort green\nproperty ushort blue\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0 65535 257 0\n1 0 0 32896 514 65278\n0 1 0 0 0 0\n3 0 1 2");
    EXPECT_EQ(mesh.colors[0], glm::u8vec4(255, 1, 0, 255));
    EXPECT_EQ(mesh.colors[1], glm::u8vec4(128, 2, 254, 255));
}

// Coordinates, corners and the lengths of lists in a type of either name.
template <typename Number>
std::string file_of_type(const std::string& format, const std::string& type, bool whole) {
    const std::string index = whole ? type : "int", length = whole ? type : "uchar";
    tests::PlyValues values(format);
    for (const std::array<Number, 3>& place : {std::array<Number, 3>{0, 0, 0},
                                               {std::numeric_limits<Number>::max(), 1, 2},
                                               {std::numeric_limits<Number>::lowest(), 3, 5},
                                               {7, 11, 13}}) {
        for (const Number number : place) values.put(number);
        values.end_record();
    }
    if (whole) {
        for (const int number : {3, 3, 1, 0}) values.put(static_cast<Number>(number));
    } else {
        values.put(std::uint8_t{3});
        for (const std::int32_t number : {3, 1, 0}) values.put(number);
    }
    values.end_record();
    return "ply\nformat " + format + " 1.0\nelement vertex 4\nproperty " + type + " x\nproperty " + type +
           " y\nproperty " + type + " z\nelement face 1\nproperty list " + length + " " + index +
           " vertex_indices\nend_header\n" + values.str();
}

template <typename Number>
void expect_type(const char* short_name, const char* long_name, auto load) {
    for (const std::string format : tests::ply_formats) {
        for (const std::string type : {short_name, long_name}) {
            SCOPED_TRACE(format + " " + type);
            const Mesh mesh = load(file_of_type<Number>(format, type, std::numeric_limits<Number>::is_integer));
            ASSERT_EQ(mesh.vertex_count(), 3u);  // the third is of no face
            ASSERT_EQ(mesh.indices, (std::vector<std::uint32_t>{2, 1, 0}));
            EXPECT_EQ(mesh.positions[1].x, static_cast<float>(std::numeric_limits<Number>::max()));
            EXPECT_EQ(mesh.positions[2], glm::vec3(7, 11, 13));
        }
    }
}

TEST_F(Ply, EveryTypeIsReadInEveryFormat) {
    const auto load = [this](const std::string& bytes) { return this->load(bytes); };
    expect_type<std::int8_t>("char", "int8", load);
    expect_type<std::uint8_t>("uchar", "uint8", load);
    expect_type<std::int16_t>("short", "int16", load);
    expect_type<std::uint16_t>("ushort", "uint16", load);
    expect_type<std::int32_t>("int", "int32", load);
    expect_type<std::uint32_t>("uint", "uint32", load);
    expect_type<float>("float", "float32", load);
}

TEST_F(Ply, DoublesAndNegativeNumbersAreRead) {
    for (const std::string format : tests::ply_formats) {
        tests::PlyValues values(format);
        for (const int i : {-1, 2, -3}) {
            values.put(i * 0.125);
            values.put(static_cast<std::int8_t>(10 * i));
            values.put(static_cast<std::int16_t>(-1000 * i * i));
            values.end_record();
        }
        values.put(std::uint8_t{3});
        for (const std::int32_t corner : {0, 1, 2}) values.put(corner);
        values.end_record();
        const Mesh mesh = load("ply\nformat " + format +
                               " 1.0\nelement vertex 3\nproperty double x\nproperty char y\nproperty short z\n"
                               "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                               values.str());
        const glm::vec3 expected[] = {{-0.125f, -10, -1000}, {0.25f, 20, -4000}, {-0.375f, -30, -9000}};
        ASSERT_EQ(mesh.vertex_count(), 3u);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(mesh.origin + glm::dvec3(mesh.positions[i]), glm::dvec3(expected[i]));
    }
}

TEST_F(Ply, NormalsAndColorsStayWithTheirVerticesWhenOthersAreDropped) {
    tests::PlainMesh mesh;
    for (std::uint32_t i = 0; i < 6; ++i) {
        const float n = static_cast<float>(i);
        mesh.positions.emplace_back(n, n * n, 0);
        mesh.normals.push_back(glm::normalize(glm::vec3(n, 1, 0)));
        mesh.colors.emplace_back(10 * i, 20 * i, 30 * i);
    }
    mesh.faces = {{5, 1, 3}};
    for (const char* format : tests::ply_formats) {
        const Mesh got = load(tests::ply_of(mesh, format));
        ASSERT_EQ(got.indices, (std::vector<std::uint32_t>{2, 0, 1}));
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(got.origin + glm::dvec3(got.positions[i]), glm::dvec3(mesh.positions[2 * i + 1]));
            EXPECT_LT(glm::distance(got.normals[i], mesh.normals[2 * i + 1]), 1e-6f);
            EXPECT_EQ(got.colors[i], glm::u8vec4(mesh.colors[2 * i + 1], 255));
        }
    }
}

TEST_F(Ply, NormalsThatAreGivenStayAndOthersAreComputed) {
    tests::PlainMesh cube = tests::make_cube();
    cube.normals.assign(8, glm::vec3(0, 3, 0));
    cube.normals[0] = glm::vec3(0.0f);
    for (const char* format : tests::ply_formats) {
        const Mesh mesh = load(tests::ply_of(cube, format));
        EXPECT_EQ(mesh.normals[1], glm::vec3(0, 1, 0));
        EXPECT_LT(mesh.normals[0].x, -0.3f);
    }
}

const std::string head = "ply\nformat ascii 1.0\n";
const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";

TEST_F(Ply, BadHeadersAreRefusedWithTheLine) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", "line 1: found a file that does not begin with 'ply'; expected a PLY file"},
        {"plywood\n", "line 1: found a file that does not begin with 'ply'; expected a PLY file"},
        {"ply\n", "line 1: found a header without end; expected a line end_header"},
        {"ply\nformat binary 1.0\n",
         "line 2: found format 'binary'; expected ascii, binary_little_endian or "
         "binary_big_endian"},
        {"ply\nformat ascii 2.0\n", "line 2: found version '2.0'; expected 1.0"},
        {"ply\nend_header\n", "line 2: found no format; expected a line format ascii 1.0 or the like"},
        {head + "property float x\n", "line 3: found a property of no element; expected an element before it"},
        {head + "element vertex -3\n", "line 3: found a count of -3; expected 0 or more"},
        {head + "element vertex 1e3\n", "line 3: found '1e3'; expected a whole number"},
        {head + "element vertex 18446744073709551616\n",
         "line 3: found '18446744073709551616'; expected a whole number"},
        {head + "element vertex\n", "line 3: found the end of the line; expected a whole number"},
        {head + "element vertex 3\nproperty half x\n",
         "line 4: found type 'half'; expected one of PLY's, from char to double"},
        {head + "element vertex 3\nproperty float\n",
         "line 4: found a property without a name; expected property TYPE NAME"},
        {head + "element vertex 3\nelement vertex 3\n", "line 4: found a second element 'vertex'; expected one"},
        {head + "element face 3\nproperty list uchar float vertex_indices\n",
         "line 4: found vertex indices that are no whole numbers; expected an integer type"},
        {head + "hello\n", "line 3: found 'hello'; expected a line of a PLY header"},
        {head + "end_header\n", "found no vertices with x, y and z; expected an element vertex with them"},
        {head + vertices + "end_header\n" + corners,
         "found no faces; expected an element face or tristrips with a list vertex_indices"}};
    for (const auto& [bytes, said] : cases) EXPECT_EQ(refusal(bytes), said);
}

TEST_F(Ply, CountsBeyondTheFileAreRefusedBeforeAnythingIsReserved) {
    for (const std::string format : tests::ply_formats)
        for (const char* count : {"100", "4294967296", "9223372036854775807"}) {
            const std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + count +
                                     "\nproperty float x\nproperty float y\nproperty float z\n" + faces +
                                     "end_header\n" + corners + "3 0 1 2\n";
            const std::string said = refusal(text);
            const bool many = std::string(count) != "100";
            EXPECT_NE(said.find(many ? "found more than 2^31 vertices" : "found 100 of element 'vertex' in 26 bytes"),
                      std::string::npos)
                << said;
        }
    EXPECT_NE(refusal(head + vertices +
                      "element face 4611686018427387905\nproperty list uchar int vertex_indices\n"
                      "end_header\n" +
                      corners)
                  .find("found 4611686018427387905 of element 'face'"),
              std::string::npos);
    // Without properties nothing is in the file: no loop either.
    EXPECT_EQ(refusal(head + "element nothing 9223372036854775807\n" + vertices + faces + "end_header\n" + corners +
                      "3 0 1 2\n"),
              "");
}

TEST_F(Ply, BadRecordsAreRefusedWithTheElement) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n",
         "face 0: found vertex 1 of a face at no finite place; expected finite numbers"},
        {"0 0 0\n1 0 1e400\n0 1 0\n3 0 1 2\n",
         "face 0: found vertex 1 of a face at no finite place; expected finite numbers"},
        {"0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "vertex 1: found the end of line 11; expected another value"},
        {"0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n", "vertex 1: found more values in line 11; expected the header's"},
        {corners + "3 0 1 3\n", "face 0: found vertex 3; expected 0 to below 3"},
        {corners + "3 0 -1 2\n", "face 0: found vertex -1; expected 0 to below 3"},
        {corners + "-3 0 1 2\n", "face 0: found a list of -3; expected a whole number below 2^32"},
        {corners + "4294967295 0 1 2\n", "face 0: found the end of line 13; expected another value"},
        {corners + "3 0 1 2 0\n", "face 0: found more values in line 13; expected the header's"},
        {corners + "2 0 1\n", "found no triangles; expected at least one face of three corners"}};
    for (const auto& [body, said] : cases) EXPECT_EQ(refusal(head + vertices + faces + "end_header\n" + body), said);
}

TEST_F(Ply, BinaryListsBeyondTheFileAreRefused) {
    for (const std::string list : {"uint int vertex_indices", "uint double other"}) {
        const std::string header = "ply\nformat binary_little_endian 1.0\n" + vertices +
                                   "element face 1\nproperty list uchar int vertex_indices\nproperty list " + list +
                                   "\nend_header\n";
        std::string body(36, '\0');
        body += '\3' + std::string("\0\0\0\0\1\0\0\0\2\0\0\0", 12) + std::string(4, '\xff') + std::string(8, '\0');
        EXPECT_EQ(refusal(header + body).find("face 0: found "), 0u) << refusal(header + body);
    }
}

TEST_F(Ply, EveryTruncationIsRefused) {
    for (const char* format : tests::ply_formats) {
        const std::string whole = odd_file(format);
        EXPECT_EQ(refusal(whole), "");
        const bool text = std::string(format) == "ascii";  // whose last digit and line end don't count
        for (std::size_t length = 0; length + (text ? 1 : 0) < whole.size(); ++length)
            ASSERT_NE(refusal(whole.substr(0, length)), "") << format << " " << length;
    }
}

// --- Points as PLY

// A reader of its own: x y z nx ny nz red green blue and nothing else.
struct ReadPoint {
    float values[6];
    unsigned color[3];
};

std::vector<ReadPoint> read_points(const std::string& bytes, const std::string& format) {
    std::istringstream in(bytes);
    std::string line, wanted = "ply\nformat " + format + " 1.0\nelement vertex ", got;
    std::getline(in, line);
    got = line + "\n";
    std::getline(in, line);
    got += line + "\n";
    std::size_t count = 0;
    std::string word, name;
    in >> word >> name >> count >> std::ws;
    EXPECT_EQ(got + word + " " + name + " ", wanted);
    for (const char* property : {"float x", "float y", "float z", "float nx", "float ny", "float nz", "uchar red",
                                 "uchar green", "uchar blue"}) {
        std::getline(in, line);
        EXPECT_EQ(line, std::string("property ") + property);
    }
    std::getline(in, line);
    EXPECT_EQ(line, "end_header");
    std::vector<ReadPoint> points(count);
    for (ReadPoint& point : points) {
        if (format == "ascii") {
            for (float& value : point.values) {
                in >> word;
                value = std::stof(word);
            }
            for (unsigned& value : point.color) in >> value;
        } else {
            in.read(reinterpret_cast<char*>(point.values), sizeof point.values);
            for (unsigned& value : point.color) value = static_cast<unsigned>(in.get());
        }
    }
    EXPECT_TRUE(in.good());
    if (format == "ascii") in >> std::ws;
    EXPECT_EQ(in.peek(), EOF);
    return points;
}

TEST(PlyPoints, OtherReadersFindThePointsExactly) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{5000}}) {
        const pointsample::PointModel model = tests::random_model(count, 1);
        for (const auto& [format, name] :
             {std::pair{pointsample::PlyFormat::ascii, "ascii"},
              std::pair{pointsample::PlyFormat::binary_little_endian, "binary_little_endian"}}) {
            std::ostringstream out;
            pointsample::write_ply(out, model, format);
            const std::vector<ReadPoint> points = read_points(out.str(), name);
            ASSERT_EQ(points.size(), count);
            for (std::size_t i = 0; i < count; ++i)
                for (int k = 0; k < 3; ++k) {
                    ASSERT_EQ(points[i].values[k], model.positions[i][k]);
                    ASSERT_EQ(points[i].values[3 + k], model.normals[i][k]);
                    ASSERT_EQ(points[i].color[k], model.colors[i][k]);
                }
        }
    }
}

TEST(PlyPoints, NoPointsAreAHeader) {
    std::ostringstream out;
    pointsample::write_ply(out, {}, pointsample::PlyFormat::ascii);
    EXPECT_NE(out.str().find("element vertex 0\n"), std::string::npos);
    EXPECT_TRUE(out.str().ends_with("end_header\n"));
}

}  // namespace
