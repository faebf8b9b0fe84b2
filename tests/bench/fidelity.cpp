#include "tests/bench/fidelity.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

namespace bench {

namespace {

constexpr double top = 255.0;

Plane luma_of(const render::Image& image) {
    Plane luma{image.width, image.height, {}};
    luma.values.reserve(image.pixels.size() / 3);
    for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3)
        luma.values.push_back(0.299 * image.pixels[i] + 0.587 * image.pixels[i + 1] + 0.114 * image.pixels[i + 2]);
    return luma;
}

// Weighted means around each pixel; at the picture's edge the window is cut and its weights are made to sum to 1.
Plane blurred(const Plane& plane) {
    constexpr int reach = 5;
    constexpr double deviation = 1.5;
    Taps window;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) {
        window.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
        sum += window.back();
    }
    for (double& weight : window) weight /= sum;
    return filtered_down(filtered_across(plane, window, Border::is_cut), window, Border::is_cut);
}

Plane product(const Plane& a, const Plane& b) {
    Plane out = a;
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] *= b.values[i];
    return out;
}

bool counts(Mask mask, std::size_t pixel) {
    return mask.empty() || mask[pixel] != 0;
}

}  // namespace

double psnr(const render::Image& reference, const render::Image& test, Mask mask) {
    std::int64_t sum = 0, values = 0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        if (!counts(mask, i / 3)) continue;
        const int off = reference.pixels[i] - test.pixels[i];
        sum += off * off;
        ++values;
    }
    if (sum == 0) return std::numeric_limits<double>::infinity();
    return 10.0 * std::log10(top * top * static_cast<double>(values) / static_cast<double>(sum));
}

SsimReference::SsimReference(const render::Image& reference)
    : luma_(luma_of(reference)), mean_(blurred(luma_)), mean_square_(blurred(product(luma_, luma_))) {}

std::vector<double> SsimReference::similarities(const render::Image& test) const {
    constexpr double c1 = 0.01 * 0.01 * top * top, c2 = 0.03 * 0.03 * top * top;
    const Plane luma = luma_of(test), mean = blurred(luma);
    const Plane mean_square = blurred(product(luma, luma)), mean_product = blurred(product(luma_, luma));
    std::vector<double> out(luma.values.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double mx = mean_.values[i], my = mean.values[i];
        const double vx = mean_square_.values[i] - mx * mx, vy = mean_square.values[i] - my * my;
        const double vxy = mean_product.values[i] - mx * my;
        out[i] = (2 * mx * my + c1) * (2 * vxy + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
    }
    return out;
}

double ssim(const render::Image& reference, const render::Image& test) {
    const std::vector<double> all = SsimReference(reference).similarities(test);
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

glm::dvec3 mean_light(const render::Image& image, Mask mask) {
    glm::dvec3 sum(0);
    double pixels = 0;
    for (std::size_t pixel = 0; pixel < image.pixels.size() / 3; ++pixel) {
        if (!counts(mask, pixel)) continue;
        for (int channel = 0; channel < 3; ++channel) {
            const double code = image.pixels[3 * pixel + channel] / top;
            sum[channel] += code * code;
        }
        ++pixels;
    }
    return pixels > 0 ? sum / pixels : sum;
}

double change_error(const render::Image& before, const render::Image& now, const render::Image& reference_before,
                    const render::Image& reference_now) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < now.pixels.size(); ++i)
        sum += std::abs((now.pixels[i] - before.pixels[i]) - (reference_now.pixels[i] - reference_before.pixels[i]));
    return static_cast<double>(sum) / static_cast<double>(now.pixels.size());
}

render::Image box_filtered(const render::Image& image, int factor) {
    render::Image out{image.width / factor, image.height / factor, {}};
    out.pixels.resize(std::size_t{3} * out.width * out.height);
    const auto light_at = [&](int x, int y, int channel) {
        const double code =
            image.pixels[std::size_t{3} * (static_cast<std::size_t>(y) * image.width + x) + channel] / top;
        return code * code;
    };
    for_each_row(out.height, [&](int y) {
        std::uint8_t* at = &out.pixels[std::size_t{3} * y * out.width];
        for (int x = 0; x < out.width; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                double sum = 0;
                for (int v = 0; v < factor; ++v)
                    for (int u = 0; u < factor; ++u) sum += light_at(x * factor + u, y * factor + v, channel);
                *at++ = static_cast<std::uint8_t>(std::lround(top * std::sqrt(sum / (factor * factor))));
            }
    });
    return out;
}

}  // namespace bench
