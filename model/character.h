// All that a file or scene/person.h says about one character: the editable form, before it is baked.
#pragma once

#include <string>
#include <vector>

#include "model/clip.h"
#include "model/mesh.h"
#include "model/skeleton.h"
#include "model/warnings.h"

namespace model {

struct Character {
    std::string name;
    Mesh mesh;
    Skeleton skeleton;
    std::vector<Clip> clips;  // may be empty: a statue
    Warnings warnings;        // what its file has that is not here
};

}  // namespace model
