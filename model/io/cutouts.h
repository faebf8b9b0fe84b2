// Colours of texels that a mask cuts away. Internal to the glTF reader.
#pragma once

#include "model/mesh.h"

namespace model {

// Gives texels of less than the cutoff's alpha the colours of what is beside them, several texels deep: filters mix
// them in at a mask's edge, and many programs leave them black. Textures that a surface without a cutoff wears too are
// left.
void fill_cutouts(Mesh& mesh);

}  // namespace model
