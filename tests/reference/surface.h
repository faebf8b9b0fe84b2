// Where a character's surface is at a time of a clip: glTF 2.0's words in double precision. Shares no code with
// motion/, only its plain data.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "model/character.h"

namespace reference {

struct Surface {
    std::vector<glm::dvec3> positions;  // one a vertex [model units]
    std::vector<glm::dvec3> normals;    // one a vertex, unit
};

// `clip` indexes character.clips; -1 is the rest pose. Before the first key and after the last, `seconds` is theirs.
Surface surface_at(const model::Character& character, int clip, double seconds);

// [units^2] of all triangles.
double area_of(const model::Mesh& mesh, const Surface& surface);

}  // namespace reference
