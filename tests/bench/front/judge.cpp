#include "tests/bench/front/judge.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace bench::front {

namespace {

template <typename Values>
double mean(const Values& values, Mask mask) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        sum += static_cast<double>(values[i]);
        ++count;
    }
    return sum / count;
}

double share_off(double light, double reference) {
    return reference > 0 ? light / reference - 1 : 0;
}

}  // namespace

Judge::Judge(Reference reference)
    : reference_(std::move(reference)),
      crowd_(reference_.crowd()),
      has_crowd_(std::ranges::count(crowd_, 1) > 0),
      flip_(reference_.now),
      ssim_(reference_.now) {}

void Judge::judge(const render::Image& before, const render::Image& now, Row& row) const {
    const Maps maps{flip_.errors(now), ssim_.similarities(now)};
    row.frame = errors(now, maps, {});
    row.crowd_share = mean(crowd_, {});
    row.crowd = has_crowd_ ? errors(now, maps, crowd_) : ImageErrors{.psnr = std::numeric_limits<double>::infinity()};
    row.change = change_error(before, now, reference_.before, reference_.now);
}

ImageErrors Judge::errors(const render::Image& now, const Maps& maps, Mask mask) const {
    ImageErrors errors;
    errors.flip = mean(maps.flip, mask);
    errors.psnr = psnr(reference_.now, now, mask);
    errors.ssim = mean(maps.ssim, mask);
    const glm::dvec3 light = mean_light(now, mask), wanted = mean_light(reference_.now, mask);
    errors.brightness = share_off(light.r + light.g + light.b, wanted.r + wanted.g + wanted.b);
    errors.red = share_off(light.r, wanted.r);
    errors.green = share_off(light.g, wanted.g);
    errors.blue = share_off(light.b, wanted.b);
    return errors;
}

}  // namespace bench::front
