// Surfaces that are seen from both sides beside others that aren't, as surfaces of one side each.
#pragma once

#include "model/mesh.h"

namespace model {

// If only some of a mesh's triangles are double-sided, gives each of those a twin that is its other side, with vertices
// of its own, and makes all materials single-sided: samplers and drawers then need to know one kind of surface only.
// Meshes of one kind are left as they are.
void split_sides(Mesh& mesh);

}  // namespace model
