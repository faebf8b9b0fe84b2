// The stadium with the displays that its environment may name: none, X11, Wayland, and ones that don't answer.
#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/apps/compositor.h"
#include "tests/apps/environment.h"
#include "tests/apps/xvfb.h"

namespace {

using Value = std::optional<std::string>;

const std::string dead_x11 = ":999";  // below the numbers that Xvfb is given
const std::string dead_wayland = "wayland-nowhere";

bool glfw_has_wayland() {
#ifdef GLFW_PLATFORM_WAYLAND
    return glfwPlatformSupported(GLFW_PLATFORM_WAYLAND);
#else
    return false;
#endif
}

class StadiumDisplay : public testing::Test {
protected:
    tests::Outcome run(const Value& display, const Value& wayland_display, const Value& runtime_directory) const {
        const tests::Environment environment({{"DISPLAY", display},
                                              {"WAYLAND_DISPLAY", wayland_display},
                                              {"XDG_RUNTIME_DIR", runtime_directory},
                                              {"XDG_SESSION_TYPE", std::nullopt}});
        return tests::run("stadium", "--people 50 --size 96x54 --frames 3 --trace -");
    }
    tests::Outcome run(const Value& display, const Value& wayland_display) const {
        return run(display, wayland_display, runtime_directory_ / "");
    }

    // Only a window's scene moves by the clock.
    static void expect_window(const tests::Outcome& outcome) {
        EXPECT_NE(outcome.out.find("# step=wall clock\n"), std::string::npos) << "no window";
        EXPECT_EQ(outcome.err, "");
        expect_all_frames(outcome);
    }
    static void expect_no_window(const tests::Outcome& outcome) {
        EXPECT_EQ(outcome.out.find("# step=wall clock\n"), std::string::npos) << "a window";
        expect_all_frames(outcome);
    }
    // The line names these displays and no other.
    static void expect_refusal(const tests::Outcome& outcome, const std::vector<std::string>& named,
                               const std::string& reason = "") {
        expect_no_window(outcome);
        EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("stadium: found no usable display (")) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '='), std::ssize(named)) << outcome.err;
        EXPECT_TRUE(outcome.err.ends_with("); drawing without a window\n")) << outcome.err;
        EXPECT_EQ(outcome.err.find(" )"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
        for (const std::string& name : named) EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
    }

    tests::Directory runtime_directory_;

private:
    static void expect_all_frames(const tests::Outcome& outcome) {
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("\n2,"), std::string::npos) << "the last frame's row";
    }
};

TEST_F(StadiumDisplay, DoesWithoutAWindowAndAWordWhereNoneIsNamed) {
    for (const Value& runtime_directory : {Value(runtime_directory_ / ""), Value()})
        for (const Value& name : {Value(), Value("")}) {
            const tests::Outcome outcome = run(name, name, runtime_directory);
            expect_no_window(outcome);
            EXPECT_EQ(outcome.err, "");
        }
}

TEST_F(StadiumDisplay, NamesTheDisplaysThatDoNotAnswer) {
    const std::string dead_path = runtime_directory_ / "no-socket";
    const std::string wayland_says = glfw_has_wayland() ? "Failed to connect" : "GLFW is built without";
    for (const Value& runtime_directory : {Value(runtime_directory_ / ""), Value()}) {
        expect_refusal(run("garbage", {}, runtime_directory), {"DISPLAY=garbage"});
        expect_refusal(run(dead_x11, {}, runtime_directory), {"DISPLAY=" + dead_x11});
        expect_refusal(run({}, dead_wayland, runtime_directory), {"WAYLAND_DISPLAY=" + dead_wayland}, wayland_says);
        expect_refusal(run({}, dead_path, runtime_directory), {"WAYLAND_DISPLAY=" + dead_path}, wayland_says);
        expect_refusal(run(dead_x11, dead_wayland, runtime_directory),
                       {"DISPLAY=" + dead_x11, "WAYLAND_DISPLAY=" + dead_wayland});
    }
}

TEST_F(StadiumDisplay, TellsWhyAServerRefusesIt) {
    const auto write = [&](const std::string& name, char secret) {
        std::ofstream(runtime_directory_ / name, std::ios::binary) << tests::cookie(secret);
        return runtime_directory_ / name;
    };
    const std::string right = write("right", 'r'), wrong = write("wrong", 'w');
    const tests::Xvfb server({"-auth", right});
    if (server.display().empty()) GTEST_SKIP() << "NO XVFB, ITS REFUSAL IS NOT TESTED";
    const auto run_with = [&](const std::string& cookies) {
        const tests::Environment environment({{"XAUTHORITY", cookies}});
        return run(server.display(), {});
    };
    expect_refusal(run_with(wrong), {"DISPLAY=" + server.display()}, "Invalid MIT-MAGIC-COOKIE-1 key");
    expect_refusal(run_with("/dev/null"), {"DISPLAY=" + server.display()}, "Authorization required");
    expect_window(run_with(right));
}

class StadiumOnX11 : public StadiumDisplay {
protected:
    void SetUp() override {
        if (server_.display().empty()) GTEST_SKIP() << "NO XVFB, THE WINDOW IS NOT TESTED";
    }

    const tests::Xvfb server_;
};

TEST_F(StadiumOnX11, RunsInAWindow) {
    for (const Value& runtime_directory : {Value(runtime_directory_ / ""), Value()})
        for (const Value& wayland_display : {Value(), Value(""), Value(dead_wayland)})
            expect_window(run(server_.display(), wayland_display, runtime_directory));
}

class StadiumOnWayland : public StadiumDisplay {
protected:
    void SetUp() override {
        if (!glfw_has_wayland()) GTEST_SKIP() << "GLFW WITHOUT WAYLAND, ITS WINDOW IS NOT TESTED";
        if (compositor_.display().empty()) GTEST_SKIP() << "NO CAGE, THE WINDOW ON WAYLAND IS NOT TESTED";
    }

    const tests::Compositor compositor_;
};

TEST_F(StadiumOnWayland, RunsInAWindow) {
    for (const Value& display : {Value(), Value(""), Value(dead_x11)})
        expect_window(run(display, compositor_.display(), compositor_.runtime_directory()));
    expect_window(run({}, compositor_.runtime_directory() + compositor_.display(), {}));
}

TEST_F(StadiumOnWayland, TakesNoDisplayThatIsNotNamed) {
    const tests::Outcome outcome = run({}, {}, compositor_.runtime_directory());
    expect_no_window(outcome);
    EXPECT_EQ(outcome.err, "");
    expect_refusal(run(dead_x11, {}, compositor_.runtime_directory()), {"DISPLAY=" + dead_x11});
}

}  // namespace
