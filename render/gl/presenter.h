// Shows pictures that were drawn without OpenGL in a window. Any context since OpenGL 3.0 will do.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>

namespace render::gl {

// Needs a current context for as long as it lives.
class Presenter {
public:
    Presenter();
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Copies a picture to the window's framebuffer, stretched to it. Rows from the top, `stride` pixels apart; red,
    // green, blue in bytes 0, 1, 2 of a pixel.
    void present(const std::uint32_t* pixels, int stride, int width, int height, int window_width, int window_height);

private:
    GLuint texture_ = 0, framebuffer_ = 0;
    int width_ = 0, height_ = 0;
};

}  // namespace render::gl
