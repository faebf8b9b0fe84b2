// Shader programs from the sources embedded at build time.
#pragma once

#include <string_view>
#include <vector>

#include "render/gl/objects.h"

namespace render::gl {

// The text of shaders/`name` as it was at build time; throws std::out_of_range for a name that isn't there.
std::string_view shader_source(std::string_view name);

// Compiles and links shaders/`vertex` and shaders/`fragment`, each preceded by #version, `defines` ("#define" each) and
// shaders/layout.h. A line #include "NAME" stands for shaders/NAME. Throws std::runtime_error with the stage's name and
// the driver's first message.
Program build_program(std::string_view vertex, std::string_view fragment,
                      const std::vector<std::string_view>& defines = {});

}  // namespace render::gl
