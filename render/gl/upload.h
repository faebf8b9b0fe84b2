// Plain data onto the device, and how vertex arrays read it.
#pragma once

#include <cstddef>
#include <span>

#include "render/gl/objects.h"

namespace render::gl {

template <typename T>
Buffer upload(std::span<const T> data) {
    Buffer buffer = Buffer::create();
    if (data.empty()) return buffer;  // GL has no storage of no bytes
    glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(data.size_bytes()), data.data(), 0);
    return buffer;
}

// An attribute of a vertex array that shaders read as floats; `offset` [bytes] in the element of `binding`.
inline void add_float(GLuint array, int attribute, int size, GLenum type, bool normalized, std::size_t offset,
                      GLuint binding) {
    const auto index = static_cast<GLuint>(attribute);
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribFormat(array, index, size, type, normalized, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array, index, binding);
}

// The same, read as integers.
inline void add_integer(GLuint array, int attribute, int size, GLenum type, std::size_t offset, GLuint binding) {
    const auto index = static_cast<GLuint>(attribute);
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribIFormat(array, index, size, type, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array, index, binding);
}

}  // namespace render::gl
