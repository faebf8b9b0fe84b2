#include "render/gl/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "render/gl/device.h"

namespace render::gl {

namespace {

std::string glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

std::optional<Command> command_of(int key) {
    switch (key) {
        case GLFW_KEY_1:
            return Command::preset_1;
        case GLFW_KEY_2:
            return Command::preset_2;
        case GLFW_KEY_3:
            return Command::preset_3;
        case GLFW_KEY_4:
            return Command::preset_4;
        case GLFW_KEY_5:
            return Command::preset_5;
        case GLFW_KEY_P:
            return Command::pause;
        case GLFW_KEY_F12:
            return Command::screenshot;
        default:
            return std::nullopt;
    }
}

// By what is typed, as + has another key on every layout. = shares its key where + needs shift.
std::optional<Command> command_of_character(unsigned int character) {
    switch (character) {
        case '+':
        case '=':
            return Command::raise_target;
        case '-':
            return Command::lower_target;
        default:
            return std::nullopt;
    }
}

// Keeps what is printed on stderr while it lives: Xlib and Wayland's library print why a display refuses them.
class PrintedErrors {
public:
    PrintedErrors() {
        if (printed_) dup2(fileno(printed_), STDERR_FILENO);
    }
    ~PrintedErrors() {
        dup2(stderr_, STDERR_FILENO);
        close(stderr_);
        if (printed_) std::fclose(printed_);
    }
    PrintedErrors(const PrintedErrors&) = delete;
    PrintedErrors& operator=(const PrintedErrors&) = delete;

    // On one line.
    std::string text() const {
        if (!printed_) return "";
        std::rewind(printed_);
        std::string text;
        for (int c = 0; (c = std::fgetc(printed_)) != EOF;) text += c == '\n' ? ' ' : static_cast<char>(c);
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    }

private:
    int stderr_ = dup(STDERR_FILENO);
    std::FILE* printed_ = stderr_ >= 0 ? std::tmpfile() : nullptr;
};

enum class Platform { x11, wayland };

// Makes the next glfwInit try this platform alone. False: GLFW is built without it.
bool choose(Platform platform) {
#ifdef GLFW_PLATFORM
    const int id = platform == Platform::x11 ? GLFW_PLATFORM_X11 : GLFW_PLATFORM_WAYLAND;
    glfwInitHint(GLFW_PLATFORM, id);
    return glfwPlatformSupported(id);
#else  // before 3.4 a GLFW is built for one platform, and its version names it
    return std::strstr(glfwGetVersionString(), platform == Platform::x11 ? "X11" : "Wayland");
#endif
}

// Starts GLFW, or says why it didn't start.
std::optional<std::string> start_on(Platform platform) {
    if (!choose(platform)) return "GLFW is built without this platform";
    const PrintedErrors printed;
    if (glfwInit()) return std::nullopt;
    const std::string why = glfw_error(), more = printed.text();
    return more.empty() ? why : why + ", " + more;
}

// Starts GLFW on the first display that is named and answers. Else says what each answered; nothing if none is named.
// X11 comes first: a Wayland desktop mostly names an X server too, and every GLFW can use that.
bool start(std::string& refusals) {
    constexpr std::pair<const char*, Platform> names[] = {{"DISPLAY", Platform::x11},
                                                          {"WAYLAND_DISPLAY", Platform::wayland}};
    for (const auto& [name, platform] : names) {
        const char* display = std::getenv(name);
        if (!display || !*display) continue;
        const auto refusal = start_on(platform);
        if (!refusal) return true;
        refusals += (refusals.empty() ? "" : "; ") + std::string(name) + "=" + display + ": " + *refusal;
    }
    return false;
}

// The OpenGL that this display has, where it isn't what was asked for; empty: none. GLFW runs.
std::string found_on_display() {
    for (const bool core : {true, false}) {  // drivers answer a low version with the highest that they have
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        if (core) {
            glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
            glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
            glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        }
        GLFWwindow* probe = glfwCreateWindow(1, 1, "", nullptr, nullptr);
        if (!probe) continue;
        glfwMakeContextCurrent(probe);
        const std::string found = found_device();
        glfwDestroyWindow(probe);
        return found;
    }
    return "";
}

}  // namespace

bool Window::display_available(std::string* obstacle) {
    std::string refusals;
    const bool started = start(refusals);
    if (started) glfwTerminate();
    if (!started && !refusals.empty() && obstacle) *obstacle = "found no usable display (" + refusals + ")";
    return started;
}

Window::Window(const std::string& title, int width, int height, Use use) {
    std::string refusals;
    if (!start(refusals))
        throw std::runtime_error("window: found no usable display (" + (refusals.empty() ? "none is named" : refusals) +
                                 "), expected X11 or Wayland; --headless needs none");
    if (use == Use::draw) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    }
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // drawing happens in the renderer's own target
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string why = glfw_error(), there = use == Use::draw ? found_on_display() : "";
        glfwTerminate();
        const std::string wanted = use == Use::draw ? "OpenGL 4.5 core" : "OpenGL";
        throw std::runtime_error("window: found " + (there.empty() ? "no OpenGL" : there) + " for this display (" +
                                 why + "), expected " + wanted + "; --headless may have it");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    glfwGetFramebufferSize(window_, &width_, &height_);
    watch_keys();
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::watch_keys() {
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int width, int height) {
        auto* self = static_cast<Window*>(glfwGetWindowUserPointer(window));
        self->width_ = width;
        self->height_ = height;
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
        if (action != GLFW_PRESS) return;
        if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
        if (const auto command = command_of(key))
            static_cast<Window*>(glfwGetWindowUserPointer(window))->commands_.push_back(*command);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int character) {  // repeats while the key is held
        if (const auto command = command_of_character(character))
            static_cast<Window*>(glfwGetWindowUserPointer(window))->commands_.push_back(*command);
    });
}

Input Window::poll() {
    glfwPollEvents();
    Input input;
    input.commands = std::exchange(commands_, {});
    const auto held = [this](int key) { return glfwGetKey(window_, key) == GLFW_PRESS ? 1.0f : 0.0f; };
    input.forward = held(GLFW_KEY_W) - held(GLFW_KEY_S);
    input.right = held(GLFW_KEY_D) - held(GLFW_KEY_A);
    input.up = held(GLFW_KEY_E) - held(GLFW_KEY_Q);
    input.hurry = held(GLFW_KEY_LEFT_SHIFT) + held(GLFW_KEY_RIGHT_SHIFT) > 0;

    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    const bool pressed = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS ||
                         glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
    if (pressed && dragging_) {
        input.look_x = x - cursor_x_;
        input.look_y = y - cursor_y_;
    }
    dragging_ = pressed;
    cursor_x_ = x;
    cursor_y_ = y;
    return input;
}

bool Window::closed() const {
    return glfwWindowShouldClose(window_);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::swap() {
    glfwSwapBuffers(window_);
}

}  // namespace render::gl
