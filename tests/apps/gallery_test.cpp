// The contact sheet as a user gets it.
#include <gtest/gtest.h>
#include <stb_image.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "tests/command.h"

namespace {

// What an OBJ file says behind each vertex and before the faces.
struct Looks {
    std::string vertex, faces;
};

// A cuboid of `size` [m] in an OBJ file.
std::string cuboid(const tests::Directory& directory, const std::string& name, std::array<double, 3> size,
                   const Looks& looks) {
    const std::string path = directory / name;
    std::ofstream file(path);
    for (int corner = 0; corner < 8; ++corner)
        file << "v " << size[0] * ((corner & 1) - 0.5) << ' ' << size[1] * (corner >> 1 & 1) << ' '
             << size[2] * ((corner >> 2) - 0.5) << looks.vertex << '\n';
    file << looks.faces;
    for (const auto& [a, b, c, d] :
         {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5}, {3, 7, 8, 4}})
        file << "f " << a << ' ' << b << ' ' << c << ' ' << d << '\n';
    return path;
}

std::string statue(const tests::Directory& directory, const std::string& name) {
    return cuboid(directory, name, {0.5, 1.75, 0.3}, {});
}

constexpr int picture_width = 100, picture_height = 150;  // [px]

struct Sheet {
    int width = 0, height = 0;
    std::vector<unsigned char> pixels;

    explicit Sheet(const std::string& path) {
        int channels = 0;
        unsigned char* read = stbi_load(path.c_str(), &width, &height, &channels, 3);
        if (read) pixels.assign(read, read + std::size_t{3} * width * height);
        stbi_image_free(read);
    }

    bool operator==(const Sheet&) const = default;

    // Of the rows of pixels from `top` on, those that are not paper.
    std::size_t inked(int top, int bottom) const {
        std::size_t count = 0;
        for (std::size_t i = std::size_t{3} * width * top; i < std::size_t{3} * width * bottom; i += 3)
            count += pixels[i] != pixels[0] || pixels[i + 1] != pixels[1] || pixels[i + 2] != pixels[2];
        return count;
    }

    // Pixels of the first picture, triangles from the front, that the second, points, has otherwise.
    int off_in_points() const {
        constexpr int left = 4, top = 32;  // [px] of the first picture
        int off = 0;
        for (int y = top; y < std::min(top + picture_height, height); ++y) {
            for (int x = left; x < left + picture_width; ++x) {
                const auto at = [&](int from) { return pixels[std::size_t{3} * (y * width + from) + 2]; };
                off += std::abs(at(x) - at(x + picture_width)) > 24;
            }
        }
        return off;
    }
};

tests::Outcome draw(const std::string& files, const std::string& png) {
    return tests::run("stadium", "--gallery " + files + " --png " + png);
}

TEST(Gallery, DrawsEachFileInARowOfItsOwn) {
    const tests::Directory directory;
    const std::string file = statue(directory, "statue.obj");
    ASSERT_EQ(draw(file, directory / "one.png").code, 0);
    ASSERT_EQ(draw(file + " " + file + " " + file, directory / "three.png").code, 0);
    const Sheet one(directory / "one.png"), three(directory / "three.png");
    ASSERT_GT(one.height, 0);
    EXPECT_EQ(three.width, one.width);
    EXPECT_GT(three.height, 2 * one.height);
    const int row = (three.height - one.height) / 2;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(three.inked(i * row, (i + 1) * row), one.inked(0, row)) << i;
}

// Of few triangles too: a row has front as triangles and as points first.
TEST(Gallery, PointsLookLikeTheTriangles) {
    const tests::Directory directory;
    ASSERT_EQ(draw(statue(directory, "statue.obj"), directory / "sheet.png").code, 0);
    const Sheet sheet(directory / "sheet.png");
    ASSERT_GE(sheet.height, picture_height);
    EXPECT_LT(sheet.off_in_points(), picture_width * picture_height / 50);
}

// Dark before the sky, so that holes are seen.
TEST(Gallery, PointsCoverTheNearEndOfALongBody) {
    const tests::Directory directory;
    const std::string file = cuboid(directory, "long.obj", {0.6, 1.75, 2}, {" 0.2 0.1 0.05", "s off\n"});
    ASSERT_EQ(draw(file, directory / "sheet.png").code, 0);
    const Sheet sheet(directory / "sheet.png");
    ASSERT_GE(sheet.height, picture_height);
    EXPECT_LT(sheet.off_in_points(), picture_width * picture_height / 7);
}

TEST(Gallery, IsTheSameEveryTime) {
    const tests::Directory directory;
    const std::string file = statue(directory, "statue.obj");
    for (const std::string name : {"a.png", "b.png"}) ASSERT_EQ(draw(file, directory / name).code, 0);
    EXPECT_EQ(Sheet(directory / "a.png"), Sheet(directory / "b.png"));
}

TEST(Gallery, NamesWhatItCantDrawAndDrawsTheOthers) {
    const tests::Directory directory;
    const std::string whole = statue(directory, "statue.obj"), damaged = directory / "damaged.glb",
                      missing = directory / "missing.ply";
    std::ofstream(damaged) << "glTF, or so it says";
    const tests::Outcome outcome = draw(damaged + " " + whole + " " + missing, directory / "sheet.png");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("damaged.glb"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("missing.ply"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("2 of 3 files"), std::string::npos) << outcome.err;
    ASSERT_EQ(draw(whole, directory / "alone.png").code, 0);
    const Sheet sheet(directory / "sheet.png"), alone(directory / "alone.png");
    ASSERT_GT(sheet.height, alone.height);
    const int row = (sheet.height - alone.height) / 2;
    EXPECT_EQ(sheet.inked(row, 2 * row), alone.inked(0, row)) << "the whole one is drawn as ever";
    const std::size_t named = sheet.inked(0, row);
    EXPECT_GT(named, 0u) << "the damaged one has no name";
    EXPECT_LT(named, alone.inked(0, row) / 10) << "the damaged one has pictures";
}

TEST(Gallery, IsASheetAndNothingElse) {
    const tests::Directory directory;
    const std::string file = statue(directory, "statue.obj");
    for (const std::string& arguments : std::vector<std::string>{
             std::string(), std::string(" --png ") + file, " --png s.png --trace t.csv", " --png s.png --summary -",
             " --png s.png --report r.html", " --png s.png --png-every 2 --png-dir d"}) {
        const tests::Outcome outcome = tests::run("stadium", "--gallery " + file + arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_NE(outcome.err.find("--gallery"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(directory.names(), std::vector<std::string>{"statue.obj"});
}

}  // namespace
