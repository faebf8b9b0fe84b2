// OpenGL 4.5 core through libepoxy, and owners for its objects. Everything else of render/ that touches GL includes
// this.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace render {

// Owns one GL name; `Traits` says how it is made and deleted. Needs the context current in both.
template <typename Traits>
class Object {
public:
    Object() = default;
    explicit Object(GLuint name) : name_(name) {}
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Object() {
        if (name_ != 0) Traits::destroy(name_);
    }
    GLuint name() const { return name_; }

private:
    GLuint name_ = 0;
};

struct BufferTraits {
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayTraits {
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureTraits {
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct RenderbufferTraits {
    static void destroy(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct FramebufferTraits {
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct ProgramTraits {
    static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct QueryTraits {
    static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};

using Buffer = Object<BufferTraits>;
using VertexArray = Object<VertexArrayTraits>;
using TextureObject = Object<TextureTraits>;
using Renderbuffer = Object<RenderbufferTraits>;
using Framebuffer = Object<FramebufferTraits>;
using Program = Object<ProgramTraits>;
using Query = Object<QueryTraits>;

// Direct-state-access constructors.
inline Buffer make_buffer() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return Buffer(name);
}
inline VertexArray make_vertex_array() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray(name);
}
inline TextureObject make_texture(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return TextureObject(name);
}
inline Renderbuffer make_renderbuffer() {
    GLuint name = 0;
    glCreateRenderbuffers(1, &name);
    return Renderbuffer(name);
}
inline Framebuffer make_framebuffer() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return Framebuffer(name);
}
inline Query make_query(GLenum target) {
    GLuint name = 0;
    glCreateQueries(target, 1, &name);
    return Query(name);
}

}  // namespace render
