// What is drawn before any time is taken, so that shaders and tables are there.
#pragma once

#include <span>

#include "figures/figure.h"
#include "figures/way.h"
#include "render/frame.h"

namespace apps {

// A frame with one of each character that somebody is of, before the camera, in each representation that people can be
// drawn as one by one: what a first draw makes for everybody, however many they are. `figures` in the order of
// Crowd::character.
render::Frame one_of_each(const render::View& view, const scene::Crowd& crowd, std::span<const figures::Figure> figures,
                          const figures::Way& way);

}  // namespace apps
