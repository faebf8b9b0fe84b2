// A person's vertices, placed, lit and snapped to the grid on which triangles are filled; and which of their triangles
// face the viewer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "render/native/person_mesh.h"

namespace render::native {

inline constexpr int group = 16;             // vertices or triangles that are worked on together
inline constexpr int grid_per_sample = 16;   // the grid that vertices are snapped to: this many steps a sample
inline constexpr int reach_on_grid = 32000;  // who is wider or higher [grid steps] isn't drawn by 32-bit edges

constexpr std::size_t in_groups(std::size_t count) {  // room for whole ones
    return (count + group - 1) / group * group;
}

// One affine form of a vertex' packed position (x, y, z as they are stored).
struct Form {
    float x, y, z, one;
};

// From a pose's packed vertices to the picture.
struct Placement {
    Form across, down;         // times depth: [grid steps m] from the picture's corner
    Form depth;                // [m] along the view
    float center_x, center_y;  // [grid steps]
    float sun[3];              // towards the sun, turned into the model's axes
};

// Linear: on a normal n, level + n.y * slope + max(n . sun, 0) * sun.
struct Daylight {
    float level[3], slope[3], sun[3];
    glm::vec3 to_sun;  // unit, world
};

// A vertex as the filler reads it.
struct alignas(16) LitVertex {
    float light[3];
    float depth;  // near_plane / view depth
};

// [grid steps] from the picture's corner; empty: min > max.
struct Extent {
    std::int32_t min_x, min_y, max_x, max_y;
    float nearest = 0;  // the largest depth of a LitVertex
};

// Lights the vertices, and places them where `across` and `down` say. All three outputs have room for whole groups, and
// `lit` for as many more if `double_sided`: the same vertices seen from behind, mesh.behind() farther on.
Extent place_vertices(const Placement& placement, const Daylight& daylight, std::span<const motion::PosedVertex> posed,
                      bool double_sided, LitVertex* lit, std::int32_t* across, std::int32_t* down);

// A triangle that may hit a sample. Corners have x in the low half, y in the high one, signed [grid steps] from the
// person's origin, and go clockwise on the screen.
struct alignas(16) FacingTriangle {
    std::uint32_t corners[3];
    std::uint32_t face;  // into the mesh's; from_behind: seen from its other side, corners 1 and 2 swapped
};
inline constexpr std::uint32_t from_behind = 1u << 31;

// `packed`: the vertices' places, as above. `to` has room for all faces and a group more. Returns how many there are,
// in the mesh's order.
std::uint32_t find_facing(const PersonMesh& mesh, const std::uint32_t* packed, FacingTriangle* to);

}  // namespace render::native
