// The stadium with a display, and with one that is only named.
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/xvfb.h"

namespace {

const std::string small = "--people 200 --size 320x180 --frames 20 ";

tests::Outcome run_on(const std::string& display, const std::string& arguments) {
    setenv("DISPLAY", display.c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    const tests::Outcome outcome = tests::run("stadium", arguments);
    unsetenv("DISPLAY");
    return outcome;
}

TEST(StadiumDisplay, RunsInAWindow) {
    const tests::Xvfb server;
    if (server.display().empty()) GTEST_SKIP() << "NO XVFB, THE WINDOW IS NOT TESTED";
    const tests::Outcome outcome = run_on(server.display(), small + "--trace -");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("\n19,"), std::string::npos) << "the last frame's row";
}

TEST(StadiumDisplay, DoesWithoutAWindowWhereTheDisplayDoesNotAnswer) {
    const tests::Outcome outcome = run_on("garbage", small + "--trace -");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
    EXPECT_NE(outcome.err.find("garbage"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("\n19,"), std::string::npos) << "the last frame's row";
}

}  // namespace
