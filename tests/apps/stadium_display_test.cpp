// The stadium with a display, and with one that is only named.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/command.h"

namespace {

const std::string small = "--people 200 --size 320x180 --frames 20 ";

// An X server without a screen, ended with the object.
class Xvfb {
public:
    Xvfb() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) return;
        server_ = std::make_unique<tests::Process>(
            std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "640x480x24"},
            ends[1]);
        close(ends[1]);
        char byte = 0;  // the display's number and a line's end, once it takes clients; nothing if there is no Xvfb
        while (read(ends[0], &byte, 1) == 1 && byte != '\n') number_ += byte;
        close(ends[0]);
    }

    // Empty: there is none.
    std::string display() const { return number_.empty() ? "" : ":" + number_; }

private:
    std::unique_ptr<tests::Process> server_;
    std::string number_;
};

tests::Outcome run_on(const std::string& display, const std::string& arguments) {
    setenv("DISPLAY", display.c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    const tests::Outcome outcome = tests::run("stadium", arguments);
    unsetenv("DISPLAY");
    return outcome;
}

TEST(StadiumDisplay, RunsInAWindow) {
    const Xvfb server;
    if (server.display().empty()) GTEST_SKIP() << "NO XVFB, THE WINDOW IS NOT TESTED";
    const tests::Outcome outcome = run_on(server.display(), small + "--trace -");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("\n19,"), std::string::npos) << "the last frame's row";
}

TEST(StadiumDisplay, DoesWithoutAWindowWhereTheDisplayDoesNotAnswer) {
    const tests::Outcome outcome = run_on("garbage", small + "--trace -");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\n19,"), std::string::npos) << "the last frame's row";
}

}  // namespace
