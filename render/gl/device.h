// What draws: read once from a current context.
#pragma once

#include <string>

namespace render::gl {

struct Device {
    std::string renderer;   // GL_RENDERER
    std::string version;    // GL_VERSION
    bool software = false;  // a CPU rasteriser: its timer queries lie and a finish is the only true clock
};

// Reads the current context. Throws std::runtime_error below OpenGL 4.5.
Device read_device();

}  // namespace render::gl
