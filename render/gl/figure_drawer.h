// One way to draw people, on the device: everything that a representation of figures/ needs here is a drawer in a file
// of its own, and its function's name in figure_drawers.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "figures/figure.h"
#include "render/batches.h"
#include "render/gl/objects.h"

namespace render::gl {

class FigureDrawer {
public:
    virtual ~FigureDrawer() = default;

    // The next character, in the crowd's order. Its people will be read from `instances`.
    virtual void add(const figures::Figure& figure, const Buffer& instances) = 0;

    // The indirect command that draws a batch, as words of 32 bits; all of a drawer's are equally long.
    virtual void append_command(const Batch& batch, std::vector<std::uint32_t>& words) const = 0;

    // Then its shaders scale to the picture's share of the viewport.
    virtual bool draws_points() const = 0;

    // `count` commands of one character, from `offset` [bytes] of the bound indirect buffer on. Its FigureBlock is
    // bound; culling is on, and is left on.
    virtual void draw(std::uint32_t character, std::uintptr_t offset, GLsizei count) const = 0;
};

// One for each of by_opengl()'s representations, in their order.
std::vector<std::unique_ptr<FigureDrawer>> make_figure_drawers();

}  // namespace render::gl
