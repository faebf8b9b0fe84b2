#include "render/gl/device.h"

#include <array>
#include <stdexcept>
#include <string_view>

#include "render/gl/objects.h"

namespace render::gl {

namespace {

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

bool is_software(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> rasterisers = {"llvmpipe", "softpipe", "SWR", "Software"};
    for (std::string_view name : rasterisers)
        if (renderer.find(name) != std::string_view::npos) return true;
    return false;
}

}  // namespace

std::string found_device() {
    return "OpenGL " + gl_string(GL_VERSION) + " on " + gl_string(GL_RENDERER);
}

Device read_device() {
    constexpr int least_version = 45;
    if (epoxy_gl_version() < least_version)
        throw std::runtime_error("found " + found_device() + ", expected OpenGL 4.5 core or later");
    Device device;
    device.renderer = gl_string(GL_RENDERER);
    device.version = gl_string(GL_VERSION);
    device.software = is_software(device.renderer);
    return device;
}

}  // namespace render::gl
