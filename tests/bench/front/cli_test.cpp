// The comparison as a user meets it: exit codes, messages, what is kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "tests/command.h"

namespace {

namespace fs = std::filesystem;
using tests::Outcome;

// The shortest run that there is.
const std::string one_row = "--people 300 --views close --only \"native triangles\" --out ";

std::string row_lines(const std::string& csv) {
    return csv.substr(csv.find("\n300,"));
}

class FrontProgram : public testing::Test {
protected:
    Outcome front(const std::string& arguments) const { return tests::run("front", arguments); }
    void make_file(const std::string& name, const std::string& text = "") const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    void refuses(const std::string& arguments, const std::string& reason, int code = 1) const {
        const Outcome outcome = front(arguments);
        EXPECT_EQ(outcome.code, code) << arguments;
        EXPECT_TRUE(tests::one_line(outcome.err)) << arguments << ": " << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("front: ")) << outcome.err;
        EXPECT_NE(outcome.err.find(reason), std::string::npos) << arguments << ": " << outcome.err;
    }

    tests::Directory folder_;
};

TEST_F(FrontProgram, RefusesOptionsThatSayNothingTogether) {
    refuses("--quick --people 300", "--people excludes --quick", 2);
    refuses("--quick --views close", "--views excludes --quick", 2);
    refuses("--quick --only laws", "--only excludes --quick", 2);
    refuses("--quick --committed a --write b", "--committed excludes --write", 2);
    refuses("--views stil", "found 'stil', expected one of", 2);
}

// An empty front would take the place of what was measured.
TEST_F(FrontProgram, RefusesToMeasureNothing) {
    make_file("front.csv", "precious");
    refuses("--people 300 --only laws --out " + (folder_ / ""), "found nothing that");
    refuses("--people 1000 --views roam-4s --only laws --out " + (folder_ / ""), "found nothing that");
    EXPECT_EQ(tests::read_file(folder_ / "front.csv"), "precious");
}

TEST_F(FrontProgram, RefusesWhatIsNoFrontToCompareWith) {
    make_file("garbled.csv", "garbage\n");
    refuses("--quick --committed " + (folder_ / "none.csv"), "none.csv: found no such file");
    refuses("--quick --committed " + (folder_ / ""), "found a directory, expected a file");
    refuses("--quick --committed " + (folder_ / "garbled.csv"), "garbled.csv:1: found 'garbage'");
}

// Before anything is measured, and nothing is left behind.
TEST_F(FrontProgram, RefusesPlacesThatItCannotWriteTo) {
    make_file("file");
    refuses(one_row + (folder_ / "file"), "cannot make the folder");
    refuses("--quick --write " + (folder_ / ""), "found a directory, expected a file");
    for (const char* name : {"front.csv", "front.html", "front.unfinished.csv"}) {
        const fs::path out = folder_ / (std::string("in-") + name);
        fs::create_directories(out / name);
        refuses(one_row + out.string(), "found a directory, expected a file");
        EXPECT_EQ(std::distance(fs::directory_iterator(out), {}), 1) << name;
    }
}

TEST_F(FrontProgram, SaysSoWhereThereIsNoDriver) {
    ASSERT_EQ(setenv("__EGL_VENDOR_LIBRARY_DIRS", (folder_ / "").c_str(), 1), 0);
    const Outcome without = front(one_row + (folder_ / "without"));
    refuses("--people 300 --views close --only \"OpenGL points\" --out " + (folder_ / "none"),
            "needs no OpenGL driver");
    unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
    EXPECT_EQ(without.code, 0);
    EXPECT_TRUE(tests::one_line(without.err)) << without.err;
    EXPECT_TRUE(without.err.starts_with("front: nothing is measured of OpenGL: ")) << without.err;
    EXPECT_FALSE(fs::exists(folder_ / "none"));
}

// Killed within its work, it goes on; what was measured before stays as it was, to the last digit of its times, until
// all of it is kept elsewhere.
TEST_F(FrontProgram, GoesOnAfterItWasKilled) {
    const std::string out = folder_ / "out", unfinished = out + "/front.unfinished.csv";
    {
        const tests::Process killed({GRANDSTAND_BIN "/front", "--people", "300", "--views", "close,remote", "--only",
                                     "native points", "--out", out});
        ASSERT_TRUE(killed.until([&] { return tests::read_file(unfinished).find("\n300,") != std::string::npos; }));
    }
    std::string known = row_lines(tests::read_file(unfinished));
    known.resize(known.rfind('\n') + 1);

    const std::string rest = "--people 300 --views close,remote --only \"native points\" --out " + out;
    const fs::path crop = out + "/crops/300-close-native-points-S-0.5.jpg";
    ASSERT_TRUE(fs::exists(crop));
    std::ofstream(crop) << "no picture";
    refuses(rest, "found 10 bytes of something else, expected a PNG or JPEG");
    EXPECT_EQ(row_lines(tests::read_file(unfinished)), row_lines(tests::read_file(out + "/front.csv")));

    fs::remove(crop);
    EXPECT_EQ(front(rest).code, 0);
    const std::string rows = row_lines(tests::read_file(out + "/front.csv"));
    EXPECT_TRUE(rows.starts_with(known));
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 2 * 9);
    EXPECT_FALSE(fs::exists(unfinished));
    EXPECT_TRUE(fs::exists(out + "/front.html"));
}

}  // namespace
