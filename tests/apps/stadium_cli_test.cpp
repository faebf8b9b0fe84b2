// The stadium as a user runs it: its contract, its determinism and its answers to bad input. Small crowds and pictures:
// what is counted and compared does not depend on their size.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "tests/apps/trace_text.h"
#include "tests/command.h"
#include "tests/model/gltf_builder.h"

namespace {

using tests::column;
using tests::lines_of;
using tests::table_of;

const std::string small = "--headless --people 400 --size 192x108 ";

void expect_usage_error(const std::string& arguments, const std::string& named) {
    const tests::Outcome outcome = tests::run("stadium", arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
}

TEST(StadiumProgram, TraceHasARowAFrameWithTheColumnsOfTheContract) {
    const tests::Outcome outcome = tests::run("stadium", small + "--frames 7 --trace -");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto table = table_of(outcome.out);
    ASSERT_EQ(table.size(), 8u);
    for (const char* name : {"frame", "target_ms", "frame_ms", "cpu_ms", "gpu_ms", "state", "motion_distance_m",
                             "splat_px", "visible", "triangles", "points", "motion_updates"})
        EXPECT_EQ(column(outcome.out, name).size(), 7u) << name;
    EXPECT_EQ(column(outcome.out, "frame"), (std::vector<std::string>{"0", "1", "2", "3", "4", "5", "6"}));
    EXPECT_TRUE(outcome.out.starts_with("#"));
}

TEST(StadiumProgram, SummaryHasTheFieldsOfTheContract) {
    const tests::Outcome outcome = tests::run("stadium", small + "--frames 3 --summary -");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* name : {"people", "frames", "law", "seed", "device", "target_ms", "mean_ms", "p50_ms", "p99_ms",
                             "control_rate", "within_5pct", "within_10pct", "over_5pct", "state_frames"})
        EXPECT_NE(outcome.out.find("\"" + std::string(name) + "\":"), std::string::npos) << name;
}

TEST(StadiumProgram, LeavesAReportOfTheRun) {
    const tests::Directory directory;
    const std::string report = directory / "run.html";
    const tests::Outcome outcome = tests::run("stadium", small + "--draw native --frames 3 --report " + report);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(tests::read_file(report).starts_with("<!DOCTYPE html>"));
    EXPECT_NE(tests::read_file(report).find("the processor"), std::string::npos) << "says what it ran on";
    EXPECT_TRUE(tests::run("stadium", small + "--frames 1 --report -").out.starts_with("<!DOCTYPE html>"));
    expect_usage_error("--report - --trace -", "stdout");
    EXPECT_EQ(directory.names(), std::vector<std::string>{"run.html"});
}

TEST(StadiumProgram, PeoplePourIn) {
    const tests::Outcome outcome = tests::run("stadium", small + "--pour-in 0.1 --frames 9 --trace -");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<std::string> visible = column(outcome.out, "visible");
    ASSERT_EQ(visible.size(), 9u);
    EXPECT_EQ(visible.front(), "0");
    for (std::size_t i = 1; i < visible.size(); ++i) EXPECT_GE(std::stoi(visible[i]), std::stoi(visible[i - 1]));
    EXPECT_GT(std::stoi(visible.back()), 0);
    expect_usage_error("--pour-in -1", "--pour-in");
    expect_usage_error("--pour-in nan", "--pour-in");
}

TEST(StadiumProgram, SameSeedAndStateGiveTheSameBytes) {
    const tests::Directory directory;
    for (const std::string state : {"0", "1", "2"}) {
        for (const std::string name : {"a", "b"})
            ASSERT_EQ(
                tests::run("stadium", small + "--frames 3 --state " + state + " --png " + (directory / name)).code, 0);
        const std::string picture = tests::read_file(directory / "a");
        EXPECT_TRUE(picture.starts_with("\x89PNG"));
        EXPECT_EQ(picture, tests::read_file(directory / "b")) << "state " << state;
    }
}

TEST(StadiumProgram, AnotherSeedGivesAnotherPicture) {
    const tests::Directory directory;
    tests::run("stadium", small + "--frames 1 --state 0 --seed 1 --png " + (directory / "a"));
    tests::run("stadium", small + "--frames 1 --state 0 --seed 2 --png " + (directory / "b"));
    EXPECT_NE(tests::read_file(directory / "a"), tests::read_file(directory / "b"));
}

TEST(StadiumProgram, StatesDrawWhatTheyAreDefinedAs) {
    const auto counts = [](const std::string& state, const std::string& what) {
        const auto cells =
            column(tests::run("stadium", small + "--camera still --frames 2 --trace - --state " + state).out, what);
        return std::stoll(cells.at(1));
    };
    EXPECT_EQ(counts("0", "points"), 0);
    EXPECT_EQ(counts("1", "points"), 0);
    EXPECT_GT(counts("2", "points"), 0);
    EXPECT_EQ(counts("0", "triangles"), counts("1", "triangles"));
    EXPECT_LT(counts("2", "triangles"), counts("0", "triangles"));
    EXPECT_EQ(counts("0", "motion_updates"), counts("0", "visible"));
}

TEST(StadiumProgram, TargetChangesAtItsFrame) {
    const tests::Outcome outcome = tests::run("stadium", small + "--frames 5 --target-ms 1000,300@2,95@4 --trace -");
    EXPECT_EQ(column(outcome.out, "target_ms"), (std::vector<std::string>{"1000", "1000", "300", "300", "95"}));
}

TEST(StadiumProgram, DecisionsOfARunAreReproducedFromItsTrace) {
    const tests::Directory directory;
    const std::string trace = directory / "t.csv";
    ASSERT_EQ(tests::run("stadium", small + "--frames 40 --target-ms 1000,2@10 --trace " + trace).code, 0);
    const tests::Outcome outcome = tests::run("replay", trace + " --verify");
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

TEST(StadiumProgram, EveryKthPictureIsKept) {
    const tests::Directory directory;
    const std::string pictures = directory / "new/pictures";
    ASSERT_EQ(tests::run("stadium", small + "--frames 5 --png-every 2 --png-dir " + pictures).code, 0);
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(pictures)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"frame000000.png", "frame000002.png", "frame000004.png"}));
}

TEST(StadiumProgram, SaysWhatIsWrongWithItsArguments) {
    expect_usage_error("--people 0", "--people");
    expect_usage_error("--people 10000001", "--people");
    expect_usage_error("--people -5", "--people");
    expect_usage_error("--people many", "--people");
    expect_usage_error("--target-ms nan", "--target-ms");
    expect_usage_error("--target-ms 0", "--target-ms");
    expect_usage_error("--target-ms 10,20@0", "--target-ms");
    expect_usage_error("--law none", "none");
    expect_usage_error("--state 3", "--state");
    expect_usage_error("--camera nowhere", "--camera");
    expect_usage_error("--size 0x100", "--size");
    expect_usage_error("--size 100", "--size");
    expect_usage_error("--size 100000x100000", "--size");
    expect_usage_error("--frames 0", "--frames");
    expect_usage_error("--seed -1", "--seed");
    expect_usage_error("--png-every 2", "--png-dir");
    expect_usage_error("--splat-px 3", "--state");
    expect_usage_error("--no-such-option", "--no-such-option");
    expect_usage_error("surplus", "surplus");
    expect_usage_error("--trace - --summary -", "stdout");
}

TEST(StadiumProgram, NamesTheLawsThereAre) {
    expect_usage_error("--law foo", "--law: found 'foo', expected one of: ");
}

TEST(StadiumProgram, DoesNotTakeAnOptionForAValue) {
    const tests::Directory directory;
    const std::string picture = directory / "x.png";
    expect_usage_error("--character --png " + picture, "--character: found the option --png");
    expect_usage_error("--trace --png " + picture, "--trace: found the option --png");
    expect_usage_error("--people --png " + picture, "--people: found");
    EXPECT_TRUE(directory.names().empty());
}

TEST(StadiumProgram, RefusesMoreCharactersThanItCanHold) {
    std::string arguments;
    for (int i = 0; i < 65; ++i) arguments += "--character a.glb ";
    expect_usage_error(arguments, "--character: found 65 files, expected at most 64");
}

TEST(StadiumProgram, RefusesToWriteTwoOutputsToOneFile) {
    const tests::Directory directory;
    const std::string file = directory / "a", link = directory / "link";
    std::filesystem::create_symlink("a", link);
    expect_usage_error("--trace " + file + " --png " + (directory / "./a"), "--trace and --png");
    expect_usage_error("--trace " + file + " --summary " + link, "--trace and --summary");
    EXPECT_EQ(directory.names(), std::vector<std::string>{"link"});
}

TEST(StadiumProgram, RefusesToOverwriteItsInputs) {
    const tests::Directory directory;
    const std::string camera = directory / "camera.json", character = directory / "a.glb";
    std::ofstream(camera) << "keys";
    std::ofstream(character) << "mesh";
    expect_usage_error("--camera " + camera + " --summary " + camera, "--camera and --summary");
    expect_usage_error("--character " + character + " --png " + (directory / "./a.glb"), "--character and --png");
    EXPECT_EQ(tests::read_file(camera), "keys");
    EXPECT_EQ(tests::read_file(character), "mesh");
}

TEST(StadiumProgram, FailsWhenWhatItPrintsIsLost) {
    for (const std::string lost : {">/dev/full", ">&-"}) {
        for (const std::string& arguments : {small + "--frames 1 ", small + "--frames 1 --trace - ",
                                             std::string("--help "), std::string("--version ")}) {
            const tests::Outcome outcome = tests::run("stadium", arguments + lost);
            EXPECT_EQ(outcome.code, 1) << arguments << lost;
            EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
            EXPECT_NE(outcome.err.find("cannot write standard output"), std::string::npos) << outcome.err;
        }
    }
}

TEST(StadiumProgram, AClosedStdoutIsNotTakenForAFile) {
    const tests::Directory directory;
    const std::string trace = directory / "t.csv";
    EXPECT_EQ(tests::run("stadium", small + "--frames 1 --trace " + trace + " >&-").code, 1);
    EXPECT_EQ(tests::read_file(trace).find("frame time"), std::string::npos) << "the summary was to go to stdout";
}

TEST(StadiumProgram, MakesItsPictureDirectoryOnlyForAPicture) {
    const tests::Directory directory;
    const std::string pictures = " --png-every 1 --png-dir " + (directory / "new/pictures");
    EXPECT_EQ(tests::run("stadium", small + "--character no_such.glb" + pictures).code, 1);
    EXPECT_TRUE(directory.names().empty());
    expect_usage_error("--png-every 1 --png-dir -", "--png-dir");
    std::ofstream(directory / "file") << "";
    const tests::Outcome below = tests::run("stadium", small + "--png-every 1 --png-dir " + (directory / "file/below"));
    EXPECT_EQ(below.code, 1);
    EXPECT_NE(below.err.find("expected a directory"), std::string::npos) << below.err;
}

TEST(StadiumProgram, SaysWhichFileItCannotReadOrWrite) {
    const tests::Directory directory;
    const std::string damaged = directory / "damaged.glb";
    std::ofstream(damaged) << "glTF, or so it says";
    const std::string trace = directory / "t.csv";
    for (const std::string& arguments :
         {"--character " + (directory / "missing.glb"), "--character " + damaged,
          "--camera " + (directory / "missing.json"), "--trace " + (directory / "no/such/place.csv"),
          "--png " + (directory / "no/such/place.png")}) {
        const tests::Outcome outcome = tests::run("stadium", small + "--frames 1 " + arguments);
        EXPECT_EQ(outcome.code, 1) << arguments;
        EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
        EXPECT_NE(outcome.err.find(arguments.substr(arguments.rfind('/') + 1)), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(tests::run("stadium", small + "--frames 1 --character " + damaged + " --trace " + trace).code, 1);
    EXPECT_FALSE(std::filesystem::exists(trace)) << "a failed run leaves no trace file";
}

// Mesa's software rasteriser can be taken away from a test, other drivers can't.
bool has_llvmpipe_alone() {
    return tests::run("stadium", small + "--draw gl --frames 1 --summary -").out.find("llvmpipe") != std::string::npos;
}

TEST(StadiumProgram, SaysWhichOpenGlIsTooOld) {
    if (!has_llvmpipe_alone()) GTEST_SKIP() << "needs Mesa's llvmpipe as the only driver";
    for (const std::string version : {"2.1", "3.3", "4.4"}) {
        setenv("MESA_GL_VERSION_OVERRIDE", version.c_str(), 1);
        const tests::Outcome outcome = tests::run("stadium", small + "--draw gl --frames 1");
        unsetenv("MESA_GL_VERSION_OVERRIDE");
        EXPECT_EQ(outcome.code, 1);
        EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
        EXPECT_NE(outcome.err.find("found OpenGL " + version + " "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("on llvmpipe"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("OpenGL 4.5 core"), std::string::npos) << outcome.err;
    }
}

TEST(StadiumProgram, DrawsNativelyWhereOpenGlIsSoftwareOrMissing) {
    if (!has_llvmpipe_alone()) GTEST_SKIP() << "needs Mesa's llvmpipe as the only driver";
    const auto draws_natively = [](const std::string& arguments) {
        const tests::Outcome outcome = tests::run("stadium", small + arguments + " --frames 1 --summary -");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("the processor"), std::string::npos) << outcome.out;
    };
    draws_natively("");
    draws_natively("--draw native");
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    draws_natively("--draw auto");
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere", 1);
    draws_natively("--draw auto");
    draws_natively("--draw native");
    unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
    expect_usage_error("--draw vulkan", "auto, gl or native");
}

// [MB] As the summary says it, of a run that takes less than a gigabyte.
double peak_of(const std::string& arguments) {
    const tests::Outcome outcome = tests::run("stadium", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::size_t line = outcome.out.find("memory        ");
    return line == outcome.out.npos ? 0 : std::stod(outcome.out.substr(line + 14));
}

// After 100 frames all is there; more of them add a row each, in a list that doubles.
TEST(StadiumProgram, MemoryIsLevelHoweverManyFrames) {
    constexpr int soon = 100, late = 1000;
    constexpr double row = 0.002, noise = 3;  // [MB]
    for (const std::string way : {"native", "gl"}) {
        const std::string run = "--headless --draw " + way + " --people 600 --size 64x36 --camera roam --frames ";
        if (way == "gl" && tests::run("stadium", run + "1").code != 0) continue;
        const double at_first = peak_of(run + std::to_string(soon));
        EXPECT_GT(at_first, 20);
        EXPECT_LT(peak_of(run + std::to_string(late)), at_first + row * late + noise) << way;
    }
}

TEST(StadiumProgram, RefusesACrowdThatMemoryDoesNotHold) {
    rlimit before{};
    getrlimit(RLIMIT_AS, &before);
    rlimit small_limit = before;
    small_limit.rlim_cur = 1'500'000'000;
    ASSERT_EQ(setrlimit(RLIMIT_AS, &small_limit), 0);
    const tests::Outcome refused = tests::run("stadium", "--headless --draw native --people 10000000 --frames 1");
    const tests::Outcome taken = tests::run("stadium", small + "--draw native --frames 1");
    setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(refused.code, 1);
    EXPECT_TRUE(tests::one_line(refused.err)) << refused.err;
    EXPECT_NE(refused.err.find("memory: found 1."), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("10000000 people"), std::string::npos) << refused.err;
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(taken.code, 0) << taken.err;
}

TEST(StadiumProgram, HelpShowsExamples) {
    for (const std::string program : {"stadium", "replay", "pointsample"}) {
        const tests::Outcome help = tests::run(program, "--help");
        EXPECT_EQ(help.code, 0);
        EXPECT_NE(help.out.find("Examples:"), std::string::npos) << program;
        const tests::Outcome version = tests::run(program, "--version");
        EXPECT_EQ(version.code, 0);
        EXPECT_TRUE(version.out.starts_with(program + " 0.")) << version.out;
    }
}

// A file whose one clip, "Run", moves its square by a metre.
void write_runner(const std::string& path) {
    tests::GltfBuilder builder = tests::make_square();
    const int times = builder.scalars({0, 1}), way = builder.vec3({0, 0, 0, 0, 0, 1});
    builder.document["animations"] = {
        {{"name", "Run"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", way}}}}}};
    std::ofstream(path, std::ios::binary) << builder.glb();
}

TEST(StadiumProgram, TellsWhoDoesWhatAndRepeatsWhatWasWanted) {
    const tests::Directory directory;
    const std::string a = directory / "a.glb", b = directory / "b.glb";
    for (const std::string& file : {a, b}) write_runner(file);
    const std::string wanted = a + ":3 --turn 90 --act walk=Run --character " + b;
    const tests::Outcome outcome =
        tests::run("stadium", small + "--frames 1 --verbose --trace - --character " + wanted);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("# character=" + wanted + "\n"), std::string::npos) << outcome.out.substr(0, 900);
    EXPECT_NE(outcome.err.find("a.glb: spectator 'Run, its mean pose'"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("walker 'Run' at 1.75 m/s"), std::string::npos) << outcome.err;
    EXPECT_EQ(tests::run("stadium", small + "--frames 1 --trace - --strict --character " + a).code, 1)
        << "nobody has a clip to stand in";
    const tests::Outcome unknown = tests::run("stadium", small + "--frames 1 --character " + a + " --act sit=Lounge");
    EXPECT_EQ(unknown.code, 1);
    EXPECT_TRUE(tests::one_line(unknown.err)) << unknown.err;
    for (const char* part : {"a.glb", "'Lounge'", "'Run'"})
        EXPECT_NE(unknown.err.find(part), std::string::npos) << unknown.err;
    expect_usage_error(small + "--character " + a + " --act fly=Run", "stand, walk, run, sit, cheer, clap, wave");
}

}  // namespace
