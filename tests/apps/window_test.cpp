// What a window makes of its user's keys.
#include "render/window.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/apps/xvfb.h"

// Last: they define None and True.
// clang-format off
#include <X11/Xlib.h>
#include <X11/keysym.h>
// clang-format on

namespace {

using render::Command;

class WindowKeys : public testing::Test {
protected:
    void SetUp() override {
        if (server_.display().empty()) GTEST_SKIP() << "NO XVFB, THE WINDOW'S KEYS ARE NOT TESTED";
        setenv("DISPLAY", server_.display().c_str(), 1);
        unsetenv("WAYLAND_DISPLAY");
        window_.emplace("keys", 64, 64);
        display_ = XOpenDisplay(nullptr);
        ASSERT_NE(display_, nullptr);
        x_window_ = newest_window();
        window_->poll();
    }
    void TearDown() override {
        if (display_) XCloseDisplay(display_);
        window_.reset();
        unsetenv("DISPLAY");
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
        while (commands.empty() || commands.back() != Command::preset_1) {
            const std::vector<Command> more = window_->poll().commands;
            commands.insert(commands.end(), more.begin(), more.end());
        }
        commands.pop_back();
        return commands;
    }

    std::optional<render::Window> window_;

private:
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

    // Without a window manager it is a child of the root; what was made last is on top.
    ::Window newest_window() {
        ::Window root = 0, parent = 0, *children = nullptr, newest = 0;
        unsigned int count = 0;
        XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count);
        if (count > 0) newest = children[count - 1];
        if (children) XFree(children);
        return newest;
    }

    tests::Xvfb server_;
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

TEST_F(WindowKeys, EscapeClosesIt) {
    EXPECT_FALSE(window_->closed());
    hold(XK_Escape, 0, 1);
    commands();
    EXPECT_TRUE(window_->closed());
}

}  // namespace
