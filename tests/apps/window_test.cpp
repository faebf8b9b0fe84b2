// Which display a window is on, and what it makes of its user's keys.
#include "render/gl/window.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/renderer.h"
#include "tests/apps/compositor.h"
#include "tests/apps/environment.h"
#include "tests/apps/xvfb.h"

// Last: they define None and True.
// clang-format off
#include <X11/Xlib.h>
#include <X11/keysym.h>
// clang-format on

namespace {

using render::Command;

const std::string dead_x11 = ":999";  // below the numbers that Xvfb is given
const std::string dead_wayland = "wayland-nowhere";

// Without a window manager they are children of the root; what was made last is on top. 0: there is none.
::Window newest_window(Display* display) {
    ::Window root = 0, parent = 0, *children = nullptr, newest = 0;
    unsigned int count = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
    if (count > 0) newest = children[count - 1];
    if (children) XFree(children);
    return newest;
}

std::string refusal_of_a_window() {
    try {
        const render::gl::Window window("none", 64, 64, render::gl::Window::Use::draw);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

std::ptrdiff_t open_descriptors() {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return std::distance(begin(all), end(all));
}

TEST(WindowDisplay, SaysWhichNamedOnesDoNotAnswer) {
    const tests::Environment environment({{"DISPLAY", dead_x11}, {"WAYLAND_DISPLAY", dead_wayland}});
    std::string obstacle;
    EXPECT_FALSE(render::gl::Window::display_available(&obstacle));
    EXPECT_FALSE(render::gl::Window::display_available());
    for (const std::string& text : {obstacle, refusal_of_a_window()}) {
        EXPECT_NE(text.find("(DISPLAY=" + dead_x11 + ": "), std::string::npos) << text;
        EXPECT_NE(text.find("; WAYLAND_DISPLAY=" + dead_wayland + ": "), std::string::npos) << text;
    }
}

TEST(WindowDisplay, HasNoObstacleWhereNoneIsNamed) {
    const tests::Environment environment({{"DISPLAY", std::nullopt}, {"WAYLAND_DISPLAY", ""}});
    std::string obstacle = "as it was";
    EXPECT_FALSE(render::gl::Window::display_available(&obstacle));
    EXPECT_EQ(obstacle, "as it was");
    EXPECT_NE(refusal_of_a_window().find("none is named"), std::string::npos);
}

TEST(WindowDisplay, IsLeftAgainOnceItIsKnownToAnswer) {
    const tests::Xvfb server;
    if (server.display().empty()) GTEST_SKIP() << "NO XVFB, ITS DISPLAY IS NOT LOOKED FOR";
    const tests::Environment environment({{"DISPLAY", server.display()}, {"WAYLAND_DISPLAY", dead_wayland}});
    std::string obstacle = "as it was";
    const auto before = open_descriptors();
    EXPECT_TRUE(render::gl::Window::display_available(&obstacle));
    EXPECT_EQ(open_descriptors(), before);
    EXPECT_EQ(obstacle, "as it was");
}

TEST(WindowDisplay, IsX11WhereWaylandAnswersToo) {
    const tests::Xvfb server;
    const tests::Compositor compositor;
    if (server.display().empty() || compositor.display().empty())
        GTEST_SKIP() << "NO XVFB OR NO CAGE, THE CHOICE BETWEEN BOTH IS NOT TESTED";
    const tests::Environment environment({{"DISPLAY", server.display()},
                                          {"WAYLAND_DISPLAY", compositor.display()},
                                          {"XDG_RUNTIME_DIR", compositor.runtime_directory()},
                                          {"XDG_SESSION_TYPE", "wayland"}});
    const render::gl::Window window("on X11", 64, 64, render::gl::Window::Use::draw);
    Display* display = XOpenDisplay(nullptr);
    ASSERT_NE(display, nullptr);
    EXPECT_NE(newest_window(display), 0u);
    XCloseDisplay(display);
}

// What libraries print is taken away only while they look for a display.
TEST(WindowDisplay, GivesStderrBack) {
    const tests::Environment environment({{"DISPLAY", dead_x11}, {"WAYLAND_DISPLAY", dead_wayland}});
    testing::internal::CaptureStderr();
    const auto before = open_descriptors();
    render::gl::Window::display_available();
    EXPECT_EQ(open_descriptors(), before);
    std::fputs("still here", stderr);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "still here");
}

class WindowKeys : public testing::Test {
protected:
    void SetUp() override {
        if (server_.display().empty()) GTEST_SKIP() << "NO XVFB, THE WINDOW'S KEYS ARE NOT TESTED";
        environment_.emplace(std::map<std::string, std::optional<std::string>>{{"DISPLAY", server_.display()},
                                                                               {"WAYLAND_DISPLAY", std::nullopt}});
        window_.emplace("keys", 64, 64, render::gl::Window::Use::draw);
        display_ = XOpenDisplay(nullptr);
        ASSERT_NE(display_, nullptr);
        x_window_ = newest_window(display_);
        window_->poll();
    }
    void TearDown() override {
        if (display_) XCloseDisplay(display_);
        window_.reset();
        environment_.reset();
    }

    // `times` presses without a release between them, as a key that is held gives, then the release.
    void hold(KeySym key, unsigned int modifiers, int times) {
        for (int i = 0; i < times; ++i) send(KeyPress, key, modifiers);
        send(KeyRelease, key, modifiers);
        XSync(display_, False);
    }

    // What came before a last press of 1, which is waited for: the server passes keys on when it likes.
    std::vector<Command> commands() {
        hold(XK_1, 0, 1);
        std::vector<Command> commands;
        const bool came = poll_until([&](const render::Input& input) {
            commands.insert(commands.end(), input.commands.begin(), input.commands.end());
            return !commands.empty() && commands.back() == Command::preset_1;
        });
        EXPECT_TRUE(came) << "the window has not passed on that 1 was pressed";
        if (came) commands.pop_back();
        return commands;
    }

    // Polls until `done` says so of what came; false: it never did.
    template <typename Done>
    bool poll_until(Done done) {
        constexpr int most_turns = 100'000;  // each waits for the server's answer
        for (int turn = 0; turn < most_turns; ++turn) {
            if (done(window_->poll())) return true;
            XSync(display_, False);
        }
        return false;
    }

    void sync() const { XSync(display_, False); }
    void press(KeySym key) { send(KeyPress, key, 0); }
    void release(KeySym key) { send(KeyRelease, key, 0); }
    void press_button(unsigned int button) { send_button(ButtonPress, button); }
    void release_button(unsigned int button) { send_button(ButtonRelease, button); }
    void move_pointer(int x, int y) {
        XWarpPointer(display_, 0, x_window_, 0, 0, 0, 0, x, y);
        XSync(display_, False);
    }

    std::optional<render::gl::Window> window_;

private:
    void send_button(int type, unsigned int button) {
        XEvent event{};
        event.xbutton.type = type;
        event.xbutton.display = display_;
        event.xbutton.window = x_window_;
        event.xbutton.root = DefaultRootWindow(display_);
        event.xbutton.same_screen = True;
        event.xbutton.button = button;
        event.xbutton.time = ++now_;
        XSendEvent(display_, x_window_, True, ButtonPressMask | ButtonReleaseMask, &event);
        XSync(display_, False);
    }

    void send(int type, KeySym key, unsigned int modifiers) {
        XEvent event{};
        event.xkey.type = type;
        event.xkey.display = display_;
        event.xkey.window = x_window_;
        event.xkey.root = DefaultRootWindow(display_);
        event.xkey.same_screen = True;
        event.xkey.keycode = XKeysymToKeycode(display_, key);
        event.xkey.state = modifiers;
        event.xkey.time = ++now_;  // [ms] GLFW takes two events of one time for one
        XSendEvent(display_, x_window_, True, KeyPressMask | KeyReleaseMask, &event);
    }

    tests::Xvfb server_;
    std::optional<tests::Environment> environment_;
    Display* display_ = nullptr;
    ::Window x_window_ = 0;
    Time now_ = 0;
};

TEST_F(WindowKeys, AHeldKeyCountsOnce) {
    hold(XK_F12, 0, 5);
    EXPECT_EQ(commands(), std::vector<Command>{Command::screenshot});
    hold(XK_p, 0, 5);
    EXPECT_EQ(commands(), std::vector<Command>{Command::pause});
    hold(XK_3, 0, 5);
    EXPECT_EQ(commands(), std::vector<Command>{Command::preset_3});
}

TEST_F(WindowKeys, PlusAndMinusRepeatAndAreWhatIsTyped) {
    hold(XK_plus, ShiftMask, 3);
    EXPECT_EQ(commands(), std::vector<Command>(3, Command::raise_target));
    hold(XK_equal, 0, 2);  // the same key without shift
    EXPECT_EQ(commands(), std::vector<Command>(2, Command::raise_target));
    hold(XK_minus, 0, 3);
    EXPECT_EQ(commands(), std::vector<Command>(3, Command::lower_target));
}

TEST_F(WindowKeys, HeldKeysSteerUntilTheyAreLetGo) {
    struct {
        KeySym key;
        float render::Input::*axis;
        float value;
    } const keys[] = {{XK_w, &render::Input::forward, 1}, {XK_s, &render::Input::forward, -1},
                      {XK_d, &render::Input::right, 1},   {XK_a, &render::Input::right, -1},
                      {XK_e, &render::Input::up, 1},      {XK_q, &render::Input::up, -1}};
    for (const auto& [key, axis, value] : keys) {
        press(key);
        EXPECT_TRUE(poll_until([&](const render::Input& input) { return input.*axis == value; }))
            << XKeysymToString(key);
        const render::Input held = window_->poll();
        EXPECT_EQ(std::abs(held.forward) + std::abs(held.right) + std::abs(held.up), 1) << XKeysymToString(key);
        EXPECT_FALSE(held.hurry);
        release(key);
        EXPECT_TRUE(poll_until([&](const render::Input& input) { return input.*axis == 0; })) << XKeysymToString(key);
    }
    for (const KeySym shift : {XK_Shift_L, XK_Shift_R}) {
        press(shift);
        EXPECT_TRUE(poll_until([](const render::Input& input) { return input.hurry; }));
        release(shift);
        EXPECT_TRUE(poll_until([](const render::Input& input) { return !input.hurry; }));
    }
}

TEST_F(WindowKeys, DraggingTellsHowFarAndMovingAloneDoesNot) {
    for (const unsigned int button : {Button1, Button3}) {
        move_pointer(10, 30);
        window_->poll();
        move_pointer(20, 20);
        const render::Input moved = window_->poll();
        EXPECT_EQ(moved.look_x, 0);
        EXPECT_EQ(moved.look_y, 0);
        press_button(button);
        double x = 0, y = 0;
        // The first poll that sees the button held begins the drag, wherever the pointer is.
        const auto add = [&](const render::Input& input) {
            x += input.look_x;
            y += input.look_y;
            return x != 0 || y != 0;
        };
        for (int turn = 0; turn < 100; ++turn) {
            add(window_->poll());
            sync();
        }
        EXPECT_EQ(x, 0);
        move_pointer(35, 14);
        EXPECT_TRUE(poll_until(add));
        EXPECT_EQ(x, 15);
        EXPECT_EQ(y, -6);
        release_button(button);
        window_->poll();
        x = y = 0;
    }
}

TEST_F(WindowKeys, EscapeClosesIt) {
    EXPECT_FALSE(window_->closed());
    hold(XK_Escape, 0, 1);
    commands();
    EXPECT_TRUE(window_->closed());
}

// The renderer's target reaches the window the right way up and, in a window of its size, pixel by pixel.
TEST_F(WindowKeys, ShowsWhatWasDrawn) {
    const scene::StaticMesh nothing{{{}, {}, {}}, {0, 0, 0}, {}};
    render::gl::Renderer renderer(nothing, {}, {}, {}, window_->width(), window_->height());
    // The sun's glow is in the upper left.
    const render::View view = render::make_view({{0, 0, 0}, {0.2, 0.1, 1.0}, 1.2}, window_->width(), window_->height());
    render::Frame nobody;
    nobody.view = view;
    renderer.draw(nobody);
    const render::Image drawn = renderer.read_image();
    renderer.present(window_->width(), window_->height());
    std::vector<std::uint8_t> shown(drawn.pixels.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, drawn.width, drawn.height, GL_RGB, GL_UNSIGNED_BYTE, shown.data());
    const auto stride = static_cast<std::size_t>(3 * drawn.width);
    int wrong = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const std::size_t row = static_cast<std::size_t>(drawn.height) - 1 - i / stride;  // GL's come from the bottom
        wrong += std::abs(shown[i] - drawn.pixels[row * stride + i % stride]) > 1;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_NE(drawn.pixels.front(), drawn.pixels.back()) << "a picture of one colour shows nothing";
}

}  // namespace
