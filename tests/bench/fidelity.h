// How near a picture is to a reference, by the measures that papers give beside FLIP (flip.h).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/image.h"
#include "tests/bench/filter.h"

namespace bench {

// Pictures must have the same size, at least a pixel.

// Which pixels count, an element each: those that aren't 0. Empty: all. Of a mask of zeros pictures are equal.
using Mask = std::span<const std::uint8_t>;

// Peak signal-to-noise ratio of the codes [dB]; infinite for equal pictures.
double psnr(const render::Image& reference, const render::Image& test, Mask mask = {});

// Mean structural similarity of the luma, 1 for equal pictures: Wang et al., "Image quality assessment: from error
// visibility to structural similarity", 2004, with its Gaussian window of 11 pixels and 1.5 of deviation.
double ssim(const render::Image& reference, const render::Image& test);

// A reference that many pictures are held against: its half of the work is done once.
class SsimReference {
public:
    explicit SsimReference(const render::Image& reference);

    // One element a pixel: ssim() is their mean. The same bits on any number of threads.
    std::vector<double> similarities(const render::Image& test) const;

private:
    Plane luma_, mean_, mean_square_;
};

// Mean linear light of each channel, where a code is the square root of light.
glm::dvec3 mean_light(const render::Image& image, Mask mask = {});

// Popping and shimmer, from a frame to the next: the mean over pixels and channels of how far a picture's change is
// from the reference's, |(now - before) - (reference_now - reference_before)| [of 255 codes].
double change_error(const render::Image& before, const render::Image& now, const render::Image& reference_before,
                    const render::Image& reference_now);

// `image` smaller by a whole factor: means of squares of factor x factor pixels in linear light. Its sides must be
// multiples of the factor.
render::Image box_filtered(const render::Image& image, int factor);

}  // namespace bench
