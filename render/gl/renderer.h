// Frames by OpenGL: uploads a scene once, then draws what was selected.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "render/batches.h"
#include "render/frame.h"
#include "render/gl/backdrop.h"
#include "render/gl/contact_grid.h"
#include "render/gl/figure_drawer.h"
#include "render/gl/objects.h"
#include "render/gl/splats.h"
#include "render/native/occluder.h"
#include "render/renderer.h"
#include "scene/ground.h"
#include "scene/light.h"
#include "scene/static_mesh.h"

namespace render::gl {

class Renderer final : public render::Renderer {
public:
    // Needs a current OpenGL 4.5 context. `figures` in the order of Crowd::character; what they point at must outlive
    // it. width, height >= 1. Throws std::runtime_error when the driver refuses.
    Renderer(const scene::StaticMesh& structure, const scene::Ground& ground, const scene::Light& light,
             std::span<const figures::Figure> figures, int width, int height);

    void resize(int width, int height) override;

    // Where OpenGL is software, with whom the structure hides.
    Surroundings begin(const View& view) override;

    // Draws into the renderer's own target; splats are at least one pixel wide.
    void draw(const Frame& frame) override;

    // Copies the target to the window's framebuffer, stretched to it.
    void present(int window_width, int window_height) const;

    Image read_image() const override;

private:
    // A run of indirect commands of one character and one representation.
    struct CommandRun {
        std::uint32_t character, representation;
        std::uintptr_t offset;
        GLsizei count;
    };

    void upload_frame(const View& view, double splat_size);
    void upload_people(const Frame& frame);
    void upload_instances(const Frame& frame);
    void draw_people() const;
    void set_viewport(int margin) const;  // [px] around the picture

    glm::dvec3 origin_;  // the structure's
    Backdrop backdrop_;
    ContactGrid contact_;
    std::optional<native::Occluder> occluder_;
    std::vector<std::unique_ptr<FigureDrawer>> drawers_;  // by representation
    FarDrawer far_;
    std::vector<Buffer> figure_blocks_;  // by character
    Buffer frame_block_, instances_, commands_;
    scene::Ground ground_;
    scene::Light light_;
    Renderbuffer color_, depth_;
    Framebuffer target_;
    int width_ = 0, height_ = 0;
    Batches batches_;
    std::vector<std::uint32_t> command_words_;
    std::vector<CommandRun> runs_;
};

}  // namespace render::gl
