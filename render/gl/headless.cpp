#include "render/gl/headless.h"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace render::gl {

namespace {

std::string egl_error() {
    char text[32];
    std::snprintf(text, sizeof text, "EGL error 0x%04x", static_cast<unsigned>(eglGetError()));
    return text;
}

// Every EGL device, hardware first whatever order the drivers list themselves in.
std::vector<EGLDeviceEXT> devices_by_preference() {
    EGLint count = 0;
    eglQueryDevicesEXT(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    eglQueryDevicesEXT(count, devices.data(), &count);
    std::stable_partition(devices.begin(), devices.end(), [](EGLDeviceEXT device) {
        const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
        return !extensions || !std::strstr(extensions, "EGL_MESA_device_software");
    });
    return devices;
}

// The devices, then Mesa's surfaceless platform, which is where a machine without a GPU may end.
std::vector<EGLDisplay> candidate_displays() {
    std::vector<EGLDisplay> displays;
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) return displays;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
        for (EGLDeviceEXT device : devices_by_preference())
            displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    return displays;
}

// A current 4.5 core context on `display`, or nothing; then `why` says what was missing.
std::optional<EGLContext> try_context(EGLDisplay display, std::string& why) {
    if (!eglInitialize(display, nullptr, nullptr)) {
        why = "eglInitialize: " + egl_error();
        return std::nullopt;
    }
    const EGLint config_wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint config_count = 0;
    eglChooseConfig(display, config_wanted, &config, 1, &config_count);
    if (config_count == 0) config = EGL_NO_CONFIG_KHR;
    const EGLint context_wanted[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLContext context = EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_API)) context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_wanted);
    if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return context;
    why = "no OpenGL 4.5 core context: " + egl_error();
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
    return std::nullopt;
}

}  // namespace

HeadlessContext::HeadlessContext() {
    // Where the library is missing, the first call through epoxy would end the program.
    void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!library) throw std::runtime_error("EGL: found no libEGL.so.1, expected one with a driver of OpenGL 4.5 core");
    dlclose(library);
    std::string why = "no EGL device and no surfaceless platform";
    for (EGLDisplay display : candidate_displays()) {
        if (display == EGL_NO_DISPLAY) continue;
        if (const auto context = try_context(display, why)) {
            display_ = display;
            context_ = *context;
            return;
        }
    }
    throw std::runtime_error("EGL: found " + why +
                             ", expected a driver with OpenGL 4.5 core (Mesa's llvmpipe will do)");
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

}  // namespace render::gl
