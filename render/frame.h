// The renderer: uploads a scene once, then draws what was selected. All GL state of a frame is set in frame.cpp;
// upload.cpp fills the buffers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/character.h"
#include "motion/pose_table.h"
#include "pointsample/point_model.h"
#include "render/gl.h"
#include "render/image.h"
#include "render/select.h"
#include "render/view.h"
#include "scene/stadium.h"

namespace render {

// A character ready to be drawn; what it points at is needed only while the Renderer is made.
struct FigureAssets {
    const model::Mesh* mesh = nullptr;
    const motion::PoseTable* poses = nullptr;  // baked with the model's points
    const pointsample::PointModel* points = nullptr;
};

class Renderer {
public:
    // Needs a current OpenGL 4.5 context. width, height >= 1. Throws std::runtime_error when the driver refuses.
    Renderer(const scene::StaticMesh& structure, const scene::StadiumPlan& plan, std::span<const FigureAssets> figures,
             int width, int height);

    void resize(int width, int height);

    // Draws into the renderer's own target; splats are `splat_size` [px] wide, at least one pixel.
    void draw(const View& view, const Selection& selection, double splat_size);

    // Copies the target to the window's framebuffer, stretched to it.
    void present(int window_width, int window_height) const;

    // What was drawn last. Waits for it.
    Image read_image() const;

private:
    struct FigureObjects {
        Buffer vertices, indices, points, box;
        VertexArray triangle_array, point_array;
        TextureObject layers;  // none if the figure has no textures
        GLsizei index_count = 0;
        GLuint vertex_count = 0, point_count = 0;
        GLuint point_record_count = 0;  // a pose: first_point says where prefixes start
        bool double_sided = false, textured = false;
    };
    struct SectorRange {
        motion::Bounds box;
        std::uint32_t first_index, index_count;
    };
    // A run of indirect commands of one character and one representation.
    struct CommandRun {
        std::uint32_t character;
        bool points;
        std::uintptr_t offset;
        GLsizei count;
    };

    FigureObjects upload_figure(const FigureAssets& assets) const;
    void upload_structure(const scene::StaticMesh& structure);
    void upload_frame(const View& view, double splat_size);
    void upload_selection(const Selection& selection);
    static GLuint first_point(const FigureObjects& figure, std::uint32_t points);
    void draw_people() const;
    void draw_structure(const View& view) const;
    void draw_sky() const;

    Program triangle_program_, textured_program_, point_program_;
    Program structure_program_, ground_program_, sky_program_;
    Buffer frame_block_, instances_, commands_;
    std::vector<FigureObjects> figures_;
    Buffer structure_vertices_, structure_indices_;
    VertexArray structure_array_, empty_array_;
    std::vector<SectorRange> painted_, ground_;
    glm::vec4 oval_{0.0f};
    Renderbuffer color_, depth_;
    Framebuffer target_;
    int width_ = 0, height_ = 0;
    std::vector<std::uint32_t> command_words_;
    std::vector<CommandRun> runs_;
};

}  // namespace render
