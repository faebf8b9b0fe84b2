#include "render/gl/program.h"

#include <stdexcept>
#include <string>

namespace render::gl {

namespace {

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

std::string shader_log(GLuint shader) {
    char log[1024] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    return first_line(log);
}

std::string program_log(GLuint program) {
    char log[1024] = "";
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    return first_line(log);
}

// The text of a shader with its includes in place.
std::string with_includes(std::string_view name) {
    constexpr std::string_view include = "#include \"";
    std::string text;
    std::string_view rest = shader_source(name);
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n') + 1);
        rest.remove_prefix(line.size());
        if (line.starts_with(include))
            text += with_includes(line.substr(include.size(), line.rfind('"') - include.size()));
        else
            text += line;
    }
    return text;
}

// Attached to `program` and marked for deletion with it.
void attach_stage(GLuint program, GLenum stage, std::string_view name, const std::string& preamble) {
    const GLuint shader = glCreateShader(stage);
    const std::string body = with_includes(name);
    const GLchar* texts[] = {preamble.c_str(), body.c_str()};
    glShaderSource(shader, 2, texts, nullptr);
    glCompileShader(shader);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    const std::string log = compiled ? "" : shader_log(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
    if (!compiled) throw std::runtime_error("shaders/" + std::string(name) + ": the driver refused it: " + log);
}

}  // namespace

Program build_program(std::string_view vertex, std::string_view fragment,
                      const std::vector<std::string_view>& defines) {
    std::string preamble = "#version 450 core\n";
    for (std::string_view define : defines) preamble += "#define " + std::string(define) + "\n";
    preamble += shader_source("layout.h");
    preamble += "\n#line 1\n";

    Program program = Program::create();
    attach_stage(program.name(), GL_VERTEX_SHADER, vertex, preamble);
    attach_stage(program.name(), GL_FRAGMENT_SHADER, fragment, preamble);
    glLinkProgram(program.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (!linked)
        throw std::runtime_error("shaders/" + std::string(vertex) + " with " + std::string(fragment) +
                                 ": the driver could not link them: " + program_log(program.name()));
    return program;
}

}  // namespace render::gl
