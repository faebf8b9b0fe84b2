// How far whole frames are from the 16-sample reference, and the coarsest native decision that is no farther from it
// than triangles at one sample.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/image.h"

namespace bench {

struct Errors {
    double flip = 0, psnr = 0, ssim = 0;

    bool as_good_as(const Errors& other) const {
        return flip <= other.flip && psnr >= other.psnr && ssim >= other.ssim;
    }
};

Errors errors_of(const render::Image& reference, const render::Image& test);

// Tried from the coarsest to the finest; 0: triangles, natively.
inline constexpr double tried_splat_sizes[] = {4, 2.8, 2, 1.7, 1.6, 1.5, 1.4, 1.3, 1.2, 1, 0.9, 0.8, 0.7, 0.5, 0};

struct PresetErrors {
    Errors triangles;                        // at one sample, by OpenGL
    std::vector<Errors> native;              // one a tried splat size
    Errors triangles_nobody, native_nobody;  // of the stadium alone, against its own reference

    // The first of the tried ones that is as good as triangles; the finest if none is.
    std::size_t chosen() const;
    bool met() const { return native[chosen()].as_good_as(triangles); }
    double splat_size() const { return tried_splat_sizes[chosen()]; }
};

// Of one of the presets. Found when first asked for, once.
const PresetErrors& errors_of_preset(const std::string& name);

}  // namespace bench
