// Popping and shimmer: how far a picture's change from frame to frame is from the reference's.
#pragma once

#include <string>
#include <vector>

#include "scene/camera_path.h"

namespace bench {

inline constexpr double change_splat_sizes[] = {0, 0.5, 1};  // [px]; 0: triangles, natively

// Means over frames and pixels of |(test - test before) - (reference - reference before)| [of 255 codes].
struct Change {
    double reference = 0;  // |reference - reference before|
    double triangles = 0;  // at one sample, by OpenGL
    double native[std::size(change_splat_sizes)] = {};
    double worst[std::size(change_splat_sizes)] = {};  // the frame that is farthest off
    double worst_triangles = 0;
    int worst_frame[std::size(change_splat_sizes)] = {};
};

// The middle of a preset's picture, 640x360 pixels of its 1280x720, while people move and the camera backs away by 5 cm
// a frame, or turns by 1.5 pixels a frame. Nobody: what the stadium alone has of it.
enum class Present { everybody, nobody };
Change change_backing(const std::string& preset, Present present);
Change change_panning(const std::string& preset, Present present);

// Some fifty people before the sky as the camera backs away until those who were 150 pixels tall are 15: from triangles
// to points.
Change change_of_group();

}  // namespace bench
