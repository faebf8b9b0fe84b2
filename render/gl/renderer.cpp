#include "render/gl/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "render/frame_block.h"
#include "render/gl/device.h"

namespace render::gl {

namespace {

static_assert(offsetof(FrameBlock, camera_position) == 64 && offsetof(FrameBlock, splat) == 272 &&
              sizeof(FrameBlock) == 288);
static_assert(offsetof(FigureBlock, box_size) == 16 && sizeof(FigureBlock) == 32);
static_assert(offsetof(ContactGridBlock, size) == 16 && sizeof(ContactGridBlock) == 32);

// Set-up must have left no error behind; memory is the one that a user can do something about.
void check_for_errors() {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
        if (error == GL_OUT_OF_MEMORY)
            throw std::runtime_error(
                "OpenGL: the driver ran out of memory for the characters' poses; fewer --character files will do");
        char code[16];
        std::snprintf(code, sizeof code, "0x%04x", error);
        throw std::runtime_error(std::string("OpenGL: the driver reported error ") + code +
                                 " during set-up, expected none");
    }
}

Buffer make_figure_block(const figures::Figure& figure) {
    const motion::PoseTable& poses = *figure.poses;
    const float silhouette = 0.25f * poses.area;  // a quarter of the surface, as of any convex body
    const FigureBlock block{glm::vec4(poses.box.min, figure.mesh->double_sided() ? 1.0f : 0.0f),
                            glm::vec4(poses.box.size(), std::sqrt(silhouette))};
    Buffer buffer = Buffer::create();
    glNamedBufferStorage(buffer.name(), sizeof block, &block, 0);
    return buffer;
}

// [px] OpenGL drops a point whose middle is outside the viewport, though half of it may be in the picture, and some
// drivers draw it none the less. So points have a viewport that is larger by half of the largest on every side.
constexpr int point_margin = static_cast<int>(sfsm::max_splat_size) / 2;

// Whether it pays to find out beforehand who is hidden, and a picture can't show it.
bool is_worth_an_occluder() {
    constexpr GLint enough_subpixel_bits = 8;
    GLint subpixel_bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    return read_device().software && subpixel_bits >= enough_subpixel_bits;
}

}  // namespace

Renderer::Renderer(const scene::StaticMesh& structure, const scene::Ground& ground, const scene::Light& light,
                   std::span<const figures::Figure> figures, int width, int height)
    : origin_(structure.origin),
      backdrop_(structure, ground),
      drawers_(make_figure_drawers()),
      far_(figures, light),
      frame_block_(Buffer::create()),
      instances_(Buffer::create()),
      commands_(Buffer::create()),
      ground_(ground),
      light_(light) {
    if (is_worth_an_occluder()) occluder_.emplace(structure);
    glNamedBufferStorage(frame_block_.name(), sizeof(FrameBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    for (const figures::Figure& figure : figures) {
        figure_blocks_.push_back(make_figure_block(figure));
        for (const auto& drawer : drawers_) drawer->add(figure, instances_);
    }
    resize(width, height);
    check_for_errors();
}

Surroundings Renderer::begin(const View& view) {
    const View here = view.from(origin_);
    return {backdrop_.work(here), occluder_ ? occluder_->look(here) : nullptr};
}

void Renderer::resize(int width, int height) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    largest = std::min({largest, viewport[0] - 2 * point_margin, viewport[1] - 2 * point_margin});
    if (width > largest || height > largest)
        throw std::runtime_error("OpenGL: found a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                                 " pixels, expected sides of at most " + std::to_string(largest));
    width_ = width;
    height_ = height;
    color_ = Renderbuffer::create();
    depth_ = Renderbuffer::create();
    target_ = Framebuffer::create();
    glNamedRenderbufferStorage(color_.name(), GL_RGBA8, width, height);
    glNamedRenderbufferStorage(depth_.name(), GL_DEPTH_COMPONENT32F, width, height);
    glNamedFramebufferRenderbuffer(target_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.name());
    glNamedFramebufferRenderbuffer(target_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    if (glCheckNamedFramebufferStatus(target_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL: the driver has no framebuffer of " + std::to_string(width) + "x" +
                                 std::to_string(height) + " pixels");
}

void Renderer::draw(const Frame& frame) {
    const View here = frame.view.from(origin_);
    upload_frame(here, frame.splat_size);
    upload_people(frame);

    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glEnable(GL_CULL_FACE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    const GLfloat farthest = 0.0f;
    const GLfloat black[] = {0.0f, 0.0f, 0.0f, 1.0f};
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, black);
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &farthest);

    draw_people();
    set_viewport(point_margin);
    far_.draw(frame);
    set_viewport(0);
    contact_.fill(frame);
    backdrop_.draw(here, contact_);
}

void Renderer::upload_frame(const View& view, double splat_size) {
    FrameBlock frame = make_frame_block(view, ground_, light_, std::max(1.0f, static_cast<float>(splat_size)));
    frame.splat.z = static_cast<float>(width_) / static_cast<float>(width_ + 2 * point_margin);
    frame.splat.w = static_cast<float>(height_) / static_cast<float>(height_ + 2 * point_margin);
    glNamedBufferSubData(frame_block_.name(), 0, sizeof frame, &frame);
    glBindBufferBase(GL_UNIFORM_BUFFER, Frame_binding, frame_block_.name());
}

// Batches become indirect commands; neighbours of one character and representation become one run, drawn by one call.
void Renderer::upload_people(const Frame& frame) {
    batches_.gather(frame);
    command_words_.clear();
    runs_.clear();
    for (const Batch& batch : batches_.all()) {
        if (runs_.empty() || runs_.back().character != batch.character ||
            runs_.back().representation != batch.representation)
            runs_.push_back({batch.character, batch.representation, command_words_.size() * sizeof(std::uint32_t), 0});
        ++runs_.back().count;
        drawers_[batch.representation]->append_command(batch, command_words_);
    }
    // A fresh store each frame: the device may still be reading the last one.
    glNamedBufferData(commands_.name(), static_cast<GLsizeiptr>(command_words_.size() * sizeof(std::uint32_t)),
                      command_words_.data(), GL_STREAM_DRAW);
    upload_instances(frame);
}

void Renderer::upload_instances(const Frame& frame) {
    const std::size_t people = frame.people.size();
    if (people == 0) return;
    const auto bytes = static_cast<GLsizeiptr>(people * sizeof(Instance));
    glNamedBufferData(instances_.name(), bytes, nullptr, GL_STREAM_DRAW);
    void* store = glMapNamedBufferRange(instances_.name(), 0, bytes, GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!store) throw std::runtime_error("OpenGL: the driver has no memory for " + std::to_string(people) + " people");
    batches_.write_instances(frame, {static_cast<Instance*>(store), people});
    glUnmapNamedBuffer(instances_.name());
}

void Renderer::draw_people() const {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
    for (const CommandRun& run : runs_) {
        glBindBufferBase(GL_UNIFORM_BUFFER, Figure_binding, figure_blocks_[run.character].name());
        const FigureDrawer& drawer = *drawers_[run.representation];
        set_viewport(drawer.draws_points() ? point_margin : 0);
        drawer.draw(run.character, run.offset, run.count);
    }
}

void Renderer::set_viewport(int margin) const {
    glViewport(-margin, -margin, width_ + 2 * margin, height_ + 2 * margin);
}

void Renderer::present(int window_width, int window_height) const {
    constexpr GLuint window_framebuffer = 0;
    glBlitNamedFramebuffer(target_.name(), window_framebuffer, 0, 0, width_, height_, 0, 0, window_width, window_height,
                           GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

Image Renderer::read_image() const {
    constexpr int channels = 3;
    std::vector<std::uint8_t> rows(static_cast<std::size_t>(channels) * width_ * height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target_.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    Image image{width_, height_, std::vector<std::uint8_t>(rows.size())};
    const std::size_t stride = static_cast<std::size_t>(channels) * width_;
    for (int y = 0; y < height_; ++y)  // GL's rows come from the bottom
        std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(stride * (height_ - 1 - y)), stride,
                    image.pixels.begin() + static_cast<std::ptrdiff_t>(stride * y));
    return image;
}

}  // namespace render::gl
