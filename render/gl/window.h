// A window with an OpenGL 4.5 core context, and what its user does in it.
#pragma once

#include <string>
#include <vector>

#include "render/input.h"

struct GLFWwindow;

namespace render::gl {

class Window {
public:
    // What its context is for: to draw takes OpenGL 4.5 core, to show pictures whatever there is.
    enum class Use { draw, show };

    // Makes its context current. Throws std::runtime_error saying what GLFW found.
    Window(const std::string& title, int width, int height, Use use);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Whether a display is named and answers. If it is named and doesn't, `obstacle` says why; else it stays as it was.
    static bool display_available(std::string* obstacle = nullptr);

    Input poll();
    bool closed() const;
    int width() const { return width_; }  // [px] of its framebuffer; 0 while minimised
    int height() const { return height_; }
    void set_title(const std::string& title);
    void swap();

private:
    void watch_keys();

    GLFWwindow* window_ = nullptr;
    int width_ = 0, height_ = 0;
    double cursor_x_ = 0, cursor_y_ = 0;
    bool dragging_ = false;
    std::vector<Command> commands_;
};

}  // namespace render::gl
