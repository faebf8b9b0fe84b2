// The pointsample program as its users call it: arguments, exit codes, files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "pointsample/points_file.h"
#include "tests/model/gltf_builder.h"

#if defined(__SANITIZE_ADDRESS__)
#define GRANDSTAND_SANITIZED 1
#else
#define GRANDSTAND_SANITIZED 0
#endif

namespace {

using tests::json;
namespace fs = std::filesystem;

std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class Program : public testing::Test {
protected:
    // Runs it in the folder; returns the exit code.
    int run(const std::string& arguments) {
        const std::string command =
            "cd " + (folder_ / "").string() + " && " GRANDSTAND_BIN "/pointsample " + arguments + " >stdout 2>stderr";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    // One line that says what was found and what was expected, and no new file.
    void expect_refusal(const std::string& arguments, int code) {
        EXPECT_EQ(run(arguments), code) << arguments;
        const std::string said = read(folder_ / "stderr");
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        EXPECT_EQ(said.rfind("pointsample: ", 0), 0u) << said;
        EXPECT_FALSE(fs::exists(folder_ / "out.ply")) << arguments;
        EXPECT_FALSE(fs::exists(folder_ / "stats.json")) << arguments;
    }

    void SetUp() override {
        folder_.write("square.glb", tests::make_square().glb());
        folder_.write("everything.glb", tests::make_everything().glb());
        folder_.write("damaged.glb", tests::make_square().glb().substr(0, 300));
    }

    tests::TemporaryFolder folder_;
};

TEST_F(Program, WritesThePointsAskedFor) {
    ASSERT_EQ(run("square.glb --points 1000 --out out.ply --stats stats.json --visible-only"), 0)
        << read(folder_ / "stderr");
    const std::string ply = read(folder_ / "out.ply");
    const std::string header = ply.substr(0, ply.find("end_header\n") + 11);
    EXPECT_EQ(header.rfind("ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\n", 0), 0u);
    constexpr std::size_t record = 6 * 4 + 3;
    ASSERT_EQ(ply.size(), header.size() + 1000 * record);
    for (std::size_t i = 0; i < 1000; ++i) {
        float values[6];
        std::memcpy(values, ply.data() + header.size() + i * record, sizeof values);
        for (int axis = 0; axis < 2; ++axis) {
            ASSERT_GE(values[axis], 0.0f);
            ASSERT_LE(values[axis], 1.0f);
        }
        ASSERT_EQ(values[2], 0.0f);
        ASSERT_EQ(values[5], 1.0f);
    }
    const json stats = json::parse(read(folder_ / "stats.json"));
    EXPECT_EQ(stats["triangles"], 2);
    EXPECT_EQ(stats["vertices"], 4);
    EXPECT_EQ(stats["area"], 1.0);
    EXPECT_EQ(stats["bounds_min"], json({0.0, 0.0, 0.0}));
    EXPECT_EQ(stats["bounds_max"], json({1.0, 1.0, 0.0}));
    EXPECT_EQ(stats["points"], 1000);
    EXPECT_EQ(stats["hidden_removed"], 0);
    EXPECT_GT(stats["seconds"], 0.0);
    EXPECT_GT(stats["peak_mb"], 1.0);
}

TEST_F(Program, IndependentPointsTakeMemoryForThemselvesAlone) {
    ASSERT_EQ(run("square.glb --points 3000000 --out - --uniform --stats stats.json"), 0) << read(folder_ / "stderr");
    constexpr double bytes_each = 70, programs_own_mb = GRANDSTAND_SANITIZED ? 2000 : 64;
    EXPECT_LT(json::parse(read(folder_ / "stats.json")).at("peak_mb"), 3 * bytes_each + programs_own_mb);
}

TEST_F(Program, TheSameArgumentsGiveTheSameBytes) {
    ASSERT_EQ(run("everything.glb --points 500 --out a.ply --visible-only"), 0);
    ASSERT_EQ(run("everything.glb --points 500 --out b.ply --visible-only"), 0);
    ASSERT_EQ(run("everything.glb --points 500 --out c.ply --visible-only --seed 2"), 0);
    EXPECT_EQ(read(folder_ / "a.ply"), read(folder_ / "b.ply"));
    EXPECT_NE(read(folder_ / "a.ply"), read(folder_ / "c.ply"));
    ASSERT_EQ(run("everything.glb --points 500 --out - --visible-only"), 0);
    EXPECT_EQ(read(folder_ / "a.ply"), read(folder_ / "stdout"));
}

TEST_F(Program, PosesAreTakenByNameOrIndex) {
    for (const char* clip : {"wag", "0"}) {
        ASSERT_EQ(run("everything.glb --points 5 --out out.ply --stats - --pose " + std::string(clip) + "@0.5"), 0);
        const json stats = json::parse(read(folder_ / "stdout"));
        EXPECT_EQ(stats["bounds_max"][1], 4.0);  // vertex 3 at 1 hangs on the tip, which is three up
        EXPECT_EQ(stats["bounds_max"][2], 4.0);  // the whole morph target
    }
}

TEST_F(Program, RefusesWrongUsageWithTwo) {
    for (const char* arguments : {"",
                                  "square.glb",
                                  "square.glb --points 5",
                                  "square.glb --out out.ply",
                                  "square.glb --points 0 --out out.ply",
                                  "square.glb --points -1 --out out.ply",
                                  "square.glb --points 1e3 --out out.ply",
                                  "square.glb --points 100000001 --out out.ply",
                                  "square.glb --points x --out out.ply",
                                  "square.glb --points 5 --out out.ply --nonsense",
                                  "square.glb --points 5 --out out.ply --pose wag",
                                  "square.glb --points 5 --out out.ply --pose wag@",
                                  "square.glb --points 5 --out out.ply --pose ''",
                                  "square.glb --points 5 --out out.ply --pose wag@nan",
                                  "square.glb --points 5 --out out.ply --pose wag@1x",
                                  "square.glb --points 5 --out - --stats -",
                                  "square.glb --points 5 --out out.ply --seed -3",
                                  "square.glb --points 5 --out out.xyz",
                                  "square.glb --points 5 --out out.pts --ascii",
                                  "square.glb --points 5 --out out.ply --even --uniform",
                                  "square.glb --points 10000001 --out out.ply",
                                  "everything.glb --points 5 --out out.ply --all-clips --pose 0@0"})
        expect_refusal(arguments, 2);
}

TEST_F(Program, RefusesBadFilesWithOne) {
    expect_refusal("missing.glb --points 5 --out out.ply --stats stats.json", 1);
    expect_refusal("damaged.glb --points 5 --out out.ply --stats stats.json", 1);
    expect_refusal("square.glb --points 5 --out out.ply --stats nowhere/stats.json", 1);
    expect_refusal("square.glb --points 5 --out nowhere/out.ply --stats stats.json", 1);
    expect_refusal("square.glb --points 5 --out out.ply --pose wag@1", 1);
    expect_refusal("everything.glb --points 5 --out out.ply --pose 7@1", 1);
    folder_.write("huge.obj", "v 0 0 0\nv 1e20 0 0\nv 0 1e20 0\nf 1 2 3\n");
    expect_refusal("huge.obj --points 5 --out out.ply --stats stats.json", 1);
}

TEST_F(Program, NamesTheFileThatHasNothingToSample) {
    folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    EXPECT_EQ(run("flat.obj --points 10 --out out.ply"), 1);
    EXPECT_EQ(read(folder_ / "stderr"),
              "pointsample: flat.obj: found no triangle with an area; expected a surface to sample\n");
}

TEST_F(Program, RefusesToOverwriteItsInputOrItsOtherOutput) {
    const std::string square = read(folder_ / "square.glb");
    fs::create_symlink("square.glb", folder_ / "link.glb");
    expect_refusal("square.glb --points 5 --out square.glb", 2);
    expect_refusal("square.glb --points 5 --out ./square.glb", 2);
    expect_refusal("square.glb --points 5 --out link.glb", 2);
    expect_refusal("link.glb --points 5 --out out.ply --stats square.glb", 2);
    expect_refusal("square.glb --points 5 --out out.ply --stats ./out.ply", 2);
    EXPECT_EQ(read(folder_ / "square.glb"), square);
}

TEST_F(Program, SaysWhatItFoundInPlaceOfACharacter) {
    const std::pair<std::string, std::string> cases[] = {{".", "a directory"},
                                                         {"/dev/null", "a device"},
                                                         {"/dev/zero", "a device"},
                                                         {"\"\"", "an empty name"},
                                                         {"missing.glb", "no such file"}};
    for (const auto& [input, found] : cases) {
        expect_refusal(input + " --points 5 --out out.ply", 1);
        EXPECT_NE(read(folder_ / "stderr").find("found " + found), std::string::npos) << read(folder_ / "stderr");
    }
}

// Lines after the header.
std::size_t lines_of_text(const std::string& ply) {
    const std::size_t begin = ply.find("end_header\n") + 11;
    return static_cast<std::size_t>(std::count(ply.begin() + static_cast<std::ptrdiff_t>(begin), ply.end(), '\n'));
}

TEST_F(Program, WritesTextAndPackedFilesToo) {
    ASSERT_EQ(run("everything.glb --points 300 --out out.ply --ascii"), 0) << read(folder_ / "stderr");
    EXPECT_EQ(read(folder_ / "out.ply").rfind("ply\nformat ascii 1.0\nelement vertex 300\n", 0), 0u);
    EXPECT_EQ(lines_of_text(read(folder_ / "out.ply")), 300u);
    ASSERT_EQ(run("everything.glb --points 300 --out out.pts --all-clips --visible-only"), 0);
    const pointsample::PointsFile file(folder_ / "out.pts");
    EXPECT_EQ(file.points().size(), 300u);
    EXPECT_EQ(file.key().size(), 32u);
    EXPECT_FALSE(file.unpack().coverage.empty());
}

TEST_F(Program, EveryOrderGivesTheExactCountAndPointsOfItsOwn) {
    std::vector<std::string> files;
    for (const std::string order : {"", "--even", "--uniform"}) {
        ASSERT_EQ(run("square.glb --points 777 --out out.ply --ascii " + order), 0) << read(folder_ / "stderr");
        files.push_back(read(folder_ / "out.ply"));
        EXPECT_EQ(lines_of_text(files.back()), 777u);
    }
    EXPECT_NE(files[0], files[1]);
    EXPECT_NE(files[0], files[2]);
}

TEST_F(Program, TakesMeshesOfOtherFormats) {
    std::ofstream(folder_ / "square.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    std::ofstream(folder_ / "square.ply")
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 "
           "3\n";
    for (const std::string input : {"square.obj", "square.ply"}) {
        ASSERT_EQ(run(input + " --points 50 --out out.ply --stats stats.json"), 0) << read(folder_ / "stderr");
        const json stats = json::parse(read(folder_ / "stats.json"));
        EXPECT_EQ(stats["triangles"], 2) << input;
        EXPECT_EQ(stats["area"], 1.0) << input;
        EXPECT_EQ(stats["points"], 50) << input;
    }
}

// A roof of a country's coordinates: floats there are half a metre apart.
TEST_F(Program, PointsFarFromTheOriginAreOnTheSurface) {
    folder_.write("far.obj",
                  "v 500000.3 5800000.6 100\nv 500000.4 5800000.6 100.02\nv 500000.4 5800000.7 100.04\n"
                  "v 500000.3 5800000.7 100.02\nf 1 2 3 4\n");
    ASSERT_EQ(run("far.obj --points 200 --out out.ply --ascii --stats stats.json"), 0) << read(folder_ / "stderr");
    const std::string ply = read(folder_ / "out.ply");
    EXPECT_NE(ply.find("property double x\nproperty double y\nproperty double z\nproperty float nx\n"),
              std::string::npos);
    std::istringstream points(ply.substr(ply.find("end_header\n") + 11));
    double x = 0, y = 0, z = 0, rest = 0;
    int count = 0;
    for (; points >> x >> y >> z; ++count) {
        for (int i = 0; i < 6; ++i) points >> rest;
        EXPECT_NEAR(z, 100 + 0.2 * (x - 500000.3) + 0.2 * (y - 5800000.6), 2e-8);
        EXPECT_GT(x, 500000.3 - 1e-8);
        EXPECT_LT(y, 5800000.7 + 1e-8);
    }
    EXPECT_EQ(count, 200);
    const json stats = json::parse(read(folder_ / "stats.json"));
    EXPECT_NEAR(stats["bounds_min"][0], 500000.3, 1e-8);
    EXPECT_NEAR(stats["bounds_max"][1], 5800000.7, 1e-8);
    EXPECT_NEAR(stats["area"], 0.01 * std::sqrt(1.08), 1e-9);
    ASSERT_EQ(run("far.obj --points 200 --out binary.ply"), 0);
    const std::string binary = read(folder_ / "binary.ply");
    const std::size_t begin = binary.find("end_header\n") + 11;
    ASSERT_EQ(binary.size() - begin, 200u * (3 * 8 + 3 * 4 + 3));
    std::memcpy(&y, binary.data() + begin + 8, sizeof y);
    EXPECT_NEAR(y, 5800000.65, 0.05);
    ASSERT_EQ(run("far.obj --points 200 --out out.pts"), 0);
    const pointsample::PointsFile file(folder_ / "out.pts");
    EXPECT_NEAR(file.origin().y + file.box().min.y, 5800000.6, 0.05);
}

TEST_F(Program, StatsSayHowWellPrefixesCover) {
    ASSERT_EQ(run("everything.glb --points 500 --out out.ply --stats stats.json"), 0);
    const json coverage = json::parse(read(folder_ / "stats.json")).at("coverage");
    ASSERT_GT(coverage.size(), 4u);
    EXPECT_EQ(coverage.back().at("points"), 500);
    for (std::size_t i = 1; i < coverage.size(); ++i) {
        EXPECT_GT(coverage[i].at("points"), coverage[i - 1].at("points"));
        EXPECT_LE(coverage[i].at("radius"), coverage[i - 1].at("radius"));
    }
}

TEST_F(Program, ExplainsItself) {
    ASSERT_EQ(run("--help"), 0);
    EXPECT_NE(read(folder_ / "stdout").find("Examples:"), std::string::npos);
    ASSERT_EQ(run("--version"), 0);
    EXPECT_EQ(read(folder_ / "stdout").rfind("pointsample ", 0), 0u);
}

}  // namespace
