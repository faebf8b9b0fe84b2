#include "render/gl/backdrop.h"

#include <cassert>
#include <cstddef>

#include "render/gl/program.h"
#include "render/gl/upload.h"
#include "shaders/layout.h"

namespace render::gl {

// Painted triangles and ground have programs of their own, so each sector's indices are parted by surface.
Backdrop::Backdrop(const scene::StaticMesh& structure, const scene::Ground& ground)
    : structure_programs_{build_program("structure.vert", "structure.frag"),
                          build_program("structure.vert", "structure.frag", {"SHADED"})},
      sky_program_(build_program("sky.vert", "sky.frag")),
      array_(VertexArray::create()),
      empty_array_(VertexArray::create()) {
    if (!ground.shader.empty())
        ground_programs_ = {build_program("structure.vert", "grounds/" + ground.shader, {"GROUND"}),
                            build_program("structure.vert", "grounds/" + ground.shader, {"GROUND", "SHADED"})};
    std::vector<std::uint32_t> indices;
    indices.reserve(structure.indices.size());
    for (const scene::Surface surface : {scene::Surface::painted, scene::Surface::ground}) {
        std::vector<SectorRange>& ranges = surface == scene::Surface::painted ? painted_ : ground_;
        for (const scene::StaticSector& sector : structure.sectors) {
            const auto first = static_cast<std::uint32_t>(indices.size());
            for (std::uint32_t i = sector.first_index; i < sector.first_index + sector.index_count; i += 3)
                if (structure.vertices[structure.indices[i]].color.a == static_cast<std::uint8_t>(surface))
                    indices.insert(indices.end(),
                                   {structure.indices[i], structure.indices[i + 1], structure.indices[i + 2]});
            const auto count = static_cast<std::uint32_t>(indices.size()) - first;
            if (count > 0) ranges.push_back({sector.box, first, count});
        }
    }
    assert(ground_.empty() || !ground.shader.empty());
    vertices_ = upload<scene::StaticVertex>(structure.vertices);
    indices_ = upload<std::uint32_t>(indices);
    constexpr GLuint binding = 0;
    const GLuint a = array_.name();
    glVertexArrayVertexBuffer(a, binding, vertices_.name(), 0, sizeof(scene::StaticVertex));
    glVertexArrayElementBuffer(a, indices_.name());
    add_float(a, attribute_static_position, 3, GL_FLOAT, false, offsetof(scene::StaticVertex, position), binding);
    add_float(a, attribute_static_normal, 3, GL_FLOAT, false, offsetof(scene::StaticVertex, normal), binding);
    add_float(a, attribute_static_color, 4, GL_UNSIGNED_BYTE, true, offsetof(scene::StaticVertex, color), binding);
    add_float(a, attribute_static_open, 1, GL_FLOAT, false, offsetof(scene::StaticVertex, open), binding);
}

sfsm::Work Backdrop::work(const View& view) const {
    sfsm::Work work;
    for (const std::vector<SectorRange>* sectors : {&painted_, &ground_})
        for (const SectorRange& sector : *sectors)
            if (overlap(view, sector.box) != Overlap::outside)
                work[sfsm::WorkKind::structure_triangle] += sector.index_count / 3;
    work[sfsm::WorkKind::pixel] = std::int64_t{view.width} * view.height;
    return work;
}

void Backdrop::draw(const View& view, const ContactGrid& contact) const {
    glBindVertexArray(array_.name());
    draw_sectors(view, contact, structure_programs_, painted_);
    draw_sectors(view, contact, ground_programs_, ground_);
    draw_sky();
}

void Backdrop::draw_sectors(const View& view, const ContactGrid& contact, const Programs& programs,
                            const std::vector<SectorRange>& sectors) const {
    for (const SectorRange& sector : sectors) {
        if (overlap(view, sector.box) == Overlap::outside) continue;
        glUseProgram(contact.touches(view, sector.box) ? programs.shaded.name() : programs.plain.name());
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(sector.index_count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::uintptr_t{sector.first_index}));
    }
}

void Backdrop::draw_sky() const {
    glDepthFunc(GL_GEQUAL);  // its depth is the cleared one
    glUseProgram(sky_program_.name());
    glBindVertexArray(empty_array_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render::gl
