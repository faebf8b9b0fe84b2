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

#include "render/gl/device.h"

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

// What a display had in place of what is needed.
struct Refusal {
    std::string found;
    bool names_version = false;
};

struct Version {
    EGLint major, minor;
    bool core;
};
constexpr Version needed{4, 5, true};

// Current, or EGL_NO_CONTEXT.
EGLContext make_context(EGLDisplay display, EGLConfig config, const Version& version) {
    std::vector<EGLint> wanted = {EGL_CONTEXT_MAJOR_VERSION, version.major, EGL_CONTEXT_MINOR_VERSION, version.minor};
    if (version.core)
        wanted.insert(wanted.end(), {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT});
    wanted.push_back(EGL_NONE);
    if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, wanted.data());
    if (context != EGL_NO_CONTEXT && !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        eglDestroyContext(display, context);
        context = EGL_NO_CONTEXT;
    }
    return context;
}

// After `error`, a needed context's: drivers answer any lower version with the highest that they have.
Refusal refusal_of(EGLDisplay display, EGLConfig config, const std::string& error) {
    for (const Version& lower : {Version{3, 2, true}, Version{1, 0, false}}) {
        const EGLContext context = make_context(display, config, lower);
        if (context == EGL_NO_CONTEXT) continue;
        Refusal refusal{found_device(), true};
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
        return refusal;
    }
    return {"no OpenGL (" + error + ")"};
}

// A current context of the needed version on `display`, or nothing; then `refusal` says what was found, unless it
// names a version that another display had and this one has none.
std::optional<EGLContext> try_context(EGLDisplay display, Refusal& refusal) {
    const auto refuse = [&](const Refusal& by) {
        if (by.names_version || !refusal.names_version) refusal = by;
        return std::nullopt;
    };
    if (!eglInitialize(display, nullptr, nullptr)) return refuse({"eglInitialize: " + egl_error()});
    const EGLint config_wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint config_count = 0;
    eglChooseConfig(display, config_wanted, &config, 1, &config_count);
    if (config_count == 0) config = EGL_NO_CONFIG_KHR;
    const EGLContext context = make_context(display, config, needed);
    if (context != EGL_NO_CONTEXT) return context;
    const Refusal by = refusal_of(display, config, egl_error());
    eglTerminate(display);
    return refuse(by);
}

}  // namespace

HeadlessContext::HeadlessContext() {
    // Where the library is missing, the first call through epoxy would end the program.
    void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!library) throw std::runtime_error("EGL: found no libEGL.so.1, expected one with a driver of OpenGL 4.5 core");
    dlclose(library);
    Refusal refusal{"no EGL device and no surfaceless platform"};
    for (EGLDisplay display : candidate_displays()) {
        if (display == EGL_NO_DISPLAY) continue;
        if (const auto context = try_context(display, refusal)) {
            display_ = display;
            context_ = *context;
            return;
        }
    }
    throw std::runtime_error("EGL: found " + refusal.found +
                             ", expected a driver with OpenGL 4.5 core (Mesa's llvmpipe will do)");
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

}  // namespace render::gl
