// All that a file or scene/person.h says about one character: the editable form, before it is baked.
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"
#include "motion/mesh.h"
#include "motion/skeleton.h"

namespace motion {

struct Character {
    std::string name;
    Mesh mesh;
    Skeleton skeleton;
    std::vector<Clip> clips;  // may be empty: a statue
};

}  // namespace motion
