// C++ and GLSL read the same bytes.
#include "shaders/layout.h"

#include <cstddef>
#include <string>

#include "render/gl/device.h"
#include "render/gl/program.h"
#include "tests/render/gl_test.h"

namespace {

using Layout = tests::GlTest;

struct Member {
    const char* name;
    std::size_t offset;
};

// The driver's offset of a member of a uniform block; -1 where the program doesn't use it.
GLint offset_in(const render::gl::Program& program, const std::string& member) {
    const char* name = member.c_str();
    GLuint index = GL_INVALID_INDEX;
    glGetUniformIndices(program.name(), 1, &name, &index);
    if (index == GL_INVALID_INDEX) return -1;
    GLint offset = -1;
    glGetActiveUniformsiv(program.name(), 1, &index, GL_UNIFORM_OFFSET, &offset);
    return offset;
}

TEST_F(Layout, UniformBlocksHaveTheOffsetsOfTheirStructs) {
    using render::ContactGridBlock;
    using render::FigureBlock;
    using render::FrameBlock;
    const Member members[] = {
        {"FrameBlock.clip_from_camera_relative", offsetof(FrameBlock, clip_from_camera_relative)},
        {"FrameBlock.camera_position", offsetof(FrameBlock, camera_position)},
        {"FrameBlock.sun_direction", offsetof(FrameBlock, sun_direction)},
        {"FrameBlock.sun_color", offsetof(FrameBlock, sun_color)},
        {"FrameBlock.sky_light", offsetof(FrameBlock, sky_light)},
        {"FrameBlock.ground_light", offsetof(FrameBlock, ground_light)},
        {"FrameBlock.sky_haze", offsetof(FrameBlock, sky_haze)},
        {"FrameBlock.sky_zenith", offsetof(FrameBlock, sky_zenith)},
        {"FrameBlock.sky_glare", offsetof(FrameBlock, sky_glare)},
        {"FrameBlock.view_right", offsetof(FrameBlock, view_right)},
        {"FrameBlock.view_up", offsetof(FrameBlock, view_up)},
        {"FrameBlock.view_forward", offsetof(FrameBlock, view_forward)},
        {"FrameBlock.ground_parameters[0]", offsetof(FrameBlock, ground_parameters)},
        {"FrameBlock.splat", offsetof(FrameBlock, splat)},
        {"FigureBlock.box_min", offsetof(FigureBlock, box_min)},
        {"FigureBlock.box_size", offsetof(FigureBlock, box_size)},
        {"ContactGridBlock.corner_and_scale", offsetof(ContactGridBlock, corner_and_scale)},
        {"ContactGridBlock.size", offsetof(ContactGridBlock, size)},
    };
    const render::gl::Program programs[] = {
        render::gl::build_program("person_points.vert", "person_points.frag"),
        render::gl::build_program("structure.vert", "grounds/stadium.glsl", {"GROUND"}),
        render::gl::build_program("sky.vert", "sky.frag"),
        render::gl::build_program("structure.vert", "structure.frag", {"SHADED"}),
    };
    for (const Member& member : members) {
        bool used = false;
        for (const render::gl::Program& program : programs) {
            const GLint offset = offset_in(program, member.name);
            if (offset < 0) continue;
            used = true;
            EXPECT_EQ(static_cast<std::size_t>(offset), member.offset) << member.name;
        }
        EXPECT_TRUE(used) << member.name << " is in the layout and no shader reads it";
    }
}

TEST_F(Layout, RefusedShaderNamesItsFile) {
    try {
        render::gl::build_program("person_points.vert", "person_points.frag", {"main not_a_function"});
        FAIL() << "the driver took nonsense";
    } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find("shaders/person_points.vert"), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST_F(Layout, DeviceSaysWhatDraws) {
    const render::gl::Device device = render::gl::read_device();
    EXPECT_FALSE(device.renderer.empty());
    EXPECT_EQ(device.renderer.find("llvmpipe") != std::string::npos, device.software) << device.renderer;
}

}  // namespace
