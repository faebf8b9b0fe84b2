// One person of a frame, placed, lit and ready to be filled.
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "render/frame.h"
#include "render/native/fill.h"
#include "render/native/near_layer.h"
#include "render/native/person_mesh.h"
#include "render/native/vertices.h"
#include "scene/light.h"

namespace render::native {

// Linear light of `light` on a normal.
Daylight daylight_of(const scene::Light& light);

// None: nobody to be drawn. `box`: of the pose table.
std::optional<Placement> placement_of(const View& view, const glm::vec3& to_sun, const motion::Bounds& box,
                                      const Instance& instance);

// Reused: allocates until it has seen the largest mesh.
class PersonTriangles {
public:
    // Returns the pixels that may be touched; empty if nothing is to be drawn.
    Rect place(const View& view, const Daylight& daylight, const PersonMesh& mesh, const Person& person);
    void draw(const PersonMesh& mesh, NearLayer& layer) const;

    // [bytes] that a person of that mesh takes.
    static std::size_t size_of(const PersonMesh& mesh);

private:
    void reserve(const PersonMesh& mesh);
    void paint(const PersonMesh& mesh, const scene::Palette& palette);
    Rect place_on_grid(const View& view, const PersonMesh& mesh, const Extent& extent);
    Rect place_anywhere(const View& view, const PersonMesh& mesh, const Placement& placement,
                        std::span<const motion::PosedVertex> posed);

    std::size_t vertex_room_ = 0, face_room_ = 0, paint_room_ = 0;
    hwy::AlignedFreeUniquePtr<LitVertex[]> lit_;
    hwy::AlignedFreeUniquePtr<Tint[]> tints_;
    hwy::AlignedFreeUniquePtr<FacingTriangle[]> facing_;
    std::uint32_t facing_count_ = 0;
    int origin_x_ = 0, origin_y_ = 0;  // PersonOnGrid's
    Rect pixels_;
    float nearest_ = 0;
    std::vector<WideTriangle> wide_;  // instead of facing_, of who is too large or too near for it
};

}  // namespace render::native
