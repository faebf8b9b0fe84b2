// How different two pictures look to a person who flips between them: FLIP for low dynamic range, after Andersson et
// al., "FLIP: A Difference Evaluator for Alternating Images", 2020.
#pragma once

#include <vector>

#include "render/image.h"

namespace bench {

// 0.7 m away from a 0.7 m wide screen of 3840 pixels [px/degree], as in the paper.
inline constexpr double usual_pixels_per_degree = 67.0206;

// One element a pixel, rows from the top, in [0, 1]; 0 where the pictures are the same. Both must have the same size,
// at least a pixel. Time is pixels * pixels_per_degree.
std::vector<float> flip_errors(const render::Image& reference, const render::Image& test,
                               double pixels_per_degree = usual_pixels_per_degree);

double mean_flip_error(const render::Image& reference, const render::Image& test,
                       double pixels_per_degree = usual_pixels_per_degree);

}  // namespace bench
