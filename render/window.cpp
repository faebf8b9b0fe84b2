#include "render/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>

namespace render {

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

bool display_named() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

}  // namespace

bool Window::display_available(std::string* obstacle) {
    if (!display_named()) return false;
    const bool usable = glfwInit() == GLFW_TRUE;
    if (!usable && obstacle) *obstacle = "found no usable display (" + glfw_error() + ")";
    if (usable) glfwTerminate();
    return usable;
}

Window::Window(const std::string& title, int width, int height) {
    if (!glfwInit())
        throw std::runtime_error("window: found no usable display (" + glfw_error() +
                                 "), expected X11 or Wayland; --headless needs none");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // drawing happens in the renderer's own target
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string why = glfw_error();
        glfwTerminate();
        throw std::runtime_error("window: found no OpenGL 4.5 core on this display (" + why +
                                 "), expected one; --headless may have it");
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

}  // namespace render
