// Triangles into the samples of a layer. Edges are exact integers and neighbours share none of their samples (what lies
// on an edge belongs to the triangle below or to the right of it), so a closed mesh has no seams.
#pragma once

#include <cstdint>
#include <span>

#include "render/native/near_layer.h"
#include "render/native/person_mesh.h"
#include "render/native/vertices.h"

namespace render::native {

// What a paint is on one person: linear, times `full`.
struct alignas(16) Tint {
    float red, green, blue;
    float one = 1;
};

// Everything that is interpolated.
struct Corner {
    float light[3];
    float depth;      // near_plane / view depth
    float albedo[3];  // linear, times `full`
    float u, v;
    float alpha = 1;  // where there are cutouts
};

// A triangle of any size, anywhere.
struct WideTriangle {
    std::int32_t x[3], y[3];  // [grid steps] from the picture's corner, within wide_reach of it; clockwise
    Corner corners[3];
    Texturing texturing;
};
inline constexpr std::int32_t wide_reach = 1 << 21;

// A person whose triangles fit 32-bit edges.
struct PersonOnGrid {
    std::span<const FacingTriangle> facing;  // can be read to the end of its last group
    int origin_x, origin_y;                  // of its corners: [samples], at a block's corner
    Rect pixels;                             // of the picture, that they may touch
    float nearest;                           // of the vertices' depths
    const LitVertex* vertices;
    const Tint* tints;  // one a paint
};

void fill(const PersonMesh& mesh, const PersonOnGrid& person, NearLayer& layer);

void fill(const TextureLayers& textures, std::span<const WideTriangle> triangles, NearLayer& layer);

}  // namespace render::native
