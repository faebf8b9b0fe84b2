// An OpenGL 4.5 core context without a display: raw EGL, surfaceless or on a device.
#pragma once

namespace render::gl {

class HeadlessContext {
public:
    // Makes the context current on this thread. Throws std::runtime_error saying what EGL offered.
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

private:
    void* display_ = nullptr;  // EGLDisplay
    void* context_ = nullptr;  // EGLContext
};

}  // namespace render::gl
