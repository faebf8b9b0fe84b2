// How near a picture is to a reference, by the measures that papers give beside FLIP (flip.h).
#pragma once

#include <glm/glm.hpp>

#include "render/image.h"

namespace bench {

// Pictures must have the same size, at least a pixel.

// Peak signal-to-noise ratio of the codes [dB]; infinite for equal pictures.
double psnr(const render::Image& reference, const render::Image& test);

// Mean structural similarity of the luma, 1 for equal pictures: Wang et al., "Image quality assessment: from error
// visibility to structural similarity", 2004, with its Gaussian window of 11 pixels and 1.5 of deviation.
double ssim(const render::Image& reference, const render::Image& test);

// Mean linear light of each channel, where a code is the square root of light.
glm::dvec3 mean_light(const render::Image& image);

// `image` smaller by a whole factor: means of squares of factor x factor pixels in linear light. Its sides must be
// multiples of the factor.
render::Image box_filtered(const render::Image& image, int factor);

}  // namespace bench
