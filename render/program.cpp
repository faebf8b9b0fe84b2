#include "render/program.h"

#include <stdexcept>
#include <string>

namespace render {

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

// Attached to `program` and marked for deletion with it.
void attach_stage(GLuint program, GLenum stage, std::string_view name, const std::string& preamble) {
    const GLuint shader = glCreateShader(stage);
    const std::string_view body = shader_source(name);
    const GLchar* texts[] = {preamble.c_str(), body.data()};
    const GLint lengths[] = {static_cast<GLint>(preamble.size()), static_cast<GLint>(body.size())};
    glShaderSource(shader, 2, texts, lengths);
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
                      std::initializer_list<std::string_view> defines) {
    std::string preamble = "#version 450 core\n";
    for (std::string_view define : defines) preamble += "#define " + std::string(define) + "\n";
    preamble += shader_source("layout.h");

    Program program = Program::create();
    const std::string line_one = "\n#line 1\n";
    attach_stage(program.name(), GL_VERTEX_SHADER, vertex,
                 preamble + std::string(shader_source("light.glsl")) + line_one);
    attach_stage(program.name(), GL_FRAGMENT_SHADER, fragment, preamble + line_one);
    glLinkProgram(program.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (!linked)
        throw std::runtime_error("shaders/" + std::string(vertex) + " with " + std::string(fragment) +
                                 ": the driver could not link them: " + program_log(program.name()));
    return program;
}

}  // namespace render
