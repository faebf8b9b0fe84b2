// A character that no two faults can make look right: every side of every part has a colour of its own, left and right
// differ, and there are textures beside plain parts, all slots, a bending joint, a mirrored part and a morph.
#pragma once

#include "model/character.h"

namespace reference {

// Two clips: "stand" (1 s) and "leap" (0.4 s), in which no two poses are alike. `open`: with a sheet that is seen from
// both sides.
model::Character make_harlequin(bool open);

// The open one with holes in what is textured, one of whose textures is mirrored and clamped, the other not blended.
model::Character make_masked_harlequin();

// All seen from both sides, with normals that lean so far to +x that many face away where their triangles don't.
model::Character make_leaning_harlequin();

}  // namespace reference
