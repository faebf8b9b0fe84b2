// How different two pictures look to a person who flips between them: FLIP for low dynamic range, after Andersson et
// al., "FLIP: A Difference Evaluator for Alternating Images", 2020.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/image.h"

namespace bench {

// 0.7 m away from a 0.7 m wide screen of 3840 pixels [px/degree], as in the paper.
inline constexpr double usual_pixels_per_degree = 67.0206;

// A reference that many pictures are held against: its half of the work is done once.
class FlipReference {
public:
    // At least a pixel.
    explicit FlipReference(const render::Image& reference, double pixels_per_degree = usual_pixels_per_degree);

    // One element a pixel, rows from the top, in [0, 1]; 0 where the pictures are the same. `test` must have the
    // reference's size. Time is pixels * pixels_per_degree. The same bits on any number of threads.
    std::vector<float> errors(const render::Image& test) const;

private:
    // A picture as an eye has it.
    struct Side {
        std::vector<glm::dvec3> colors;     // L*a*b* after Hunt
        std::vector<double> edges, points;  // of lightness: how strong
    };
    static Side side_of(const render::Image& image, double pixels_per_degree);

    double pixels_per_degree_;
    Side reference_;
};

std::vector<float> flip_errors(const render::Image& reference, const render::Image& test,
                               double pixels_per_degree = usual_pixels_per_degree);

double mean_flip_error(const render::Image& reference, const render::Image& test,
                       double pixels_per_degree = usual_pixels_per_degree);

}  // namespace bench
