// What is known of a view before anybody is chosen for it.
#pragma once

#include "render/occlusion.h"
#include "sfsm/work.h"

namespace render {

struct Surroundings {
    sfsm::Work work;                       // of all that is drawn whoever is: structure and pixels
    const Occlusion* occlusion = nullptr;  // null: not known
    double background_error = 0;           // expected mean FLIP of the picture if nobody is in it
};

}  // namespace render
