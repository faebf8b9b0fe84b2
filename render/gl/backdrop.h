// What stands and lies around the people: structure, ground and sky.
#pragma once

#include <vector>

#include "render/gl/contact_grid.h"
#include "render/gl/objects.h"
#include "render/view.h"
#include "scene/ground.h"
#include "scene/static_mesh.h"
#include "sfsm/work.h"

namespace render::gl {

// Views are told from the structure's origin.
class Backdrop {
public:
    Backdrop(const scene::StaticMesh& structure, const scene::Ground& ground);

    // What draw() draws: triangles of the sectors in view, and every pixel of the picture.
    sfsm::Work work(const View& view) const;

    // After the people, whose depths hide most of it: the costliest pixels (ground, sky) come last.
    // Darkened by `contact`, which is filled for this view.
    void draw(const View& view, const ContactGrid& contact) const;

private:
    struct SectorRange {
        motion::Bounds box;
        std::uint32_t first_index, index_count;
    };

    // One program for sectors where people darken something, which has that to look for, and one for the others.
    struct Programs {
        Program plain, shaded;
    };

    void draw_sectors(const View& view, const ContactGrid& contact, const Programs& programs,
                      const std::vector<SectorRange>& sectors) const;
    void draw_sky() const;

    Programs structure_programs_, ground_programs_;
    Program sky_program_;
    Buffer vertices_, indices_;
    VertexArray array_, empty_array_;
    std::vector<SectorRange> painted_, ground_;
};

}  // namespace render::gl
