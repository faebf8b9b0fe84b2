// What is drawn before any time is taken, so that shaders and tables are there.
#pragma once

#include "render/frame.h"

namespace apps {

// The frame with the first of each character and representation alone: what a first draw makes for everybody, however
// many they are.
render::Frame one_of_each(const render::Frame& everybody);

}  // namespace apps
