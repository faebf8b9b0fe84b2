// OpenGL 4.5 core through libepoxy, and owners for its objects. Everything that touches GL includes this.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace render::gl {

// Owns one GL name; `Traits` says how it is made and deleted. Needs the context current in both.
template <typename Traits>
class Object {
public:
    Object() = default;
    // A new one; textures and queries want their target.
    template <typename... Target>
    static Object create(Target... target) {
        Object object;
        Traits::create(&object.name_, target...);
        return object;
    }
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
    static void create(GLuint* name) { glCreateBuffers(1, name); }
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayTraits {
    static void create(GLuint* name) { glCreateVertexArrays(1, name); }
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureTraits {
    static void create(GLuint* name, GLenum target) { glCreateTextures(target, 1, name); }
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct RenderbufferTraits {
    static void create(GLuint* name) { glCreateRenderbuffers(1, name); }
    static void destroy(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct FramebufferTraits {
    static void create(GLuint* name) { glCreateFramebuffers(1, name); }
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct QueryTraits {
    static void create(GLuint* name, GLenum target) { glCreateQueries(target, 1, name); }
    static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
struct ProgramTraits {
    static void create(GLuint* name) { *name = glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};

using Buffer = Object<BufferTraits>;
using VertexArray = Object<VertexArrayTraits>;
using TextureObject = Object<TextureTraits>;
using Renderbuffer = Object<RenderbufferTraits>;
using Framebuffer = Object<FramebufferTraits>;
using Query = Object<QueryTraits>;
using Program = Object<ProgramTraits>;

}  // namespace render::gl
