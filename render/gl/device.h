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

// The version and what it runs on, of the current context, as a message says what was found: "OpenGL 3.3 on a GPU".
std::string found_device();

}  // namespace render::gl
