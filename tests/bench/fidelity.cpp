#include "tests/bench/fidelity.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace bench {

namespace {

constexpr double top = 255.0;

std::vector<double> luma_of(const render::Image& image) {
    std::vector<double> luma;
    for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3)
        luma.push_back(0.299 * image.pixels[i] + 0.587 * image.pixels[i + 1] + 0.114 * image.pixels[i + 2]);
    return luma;
}

constexpr int window_reach = 5;
using Window = std::array<double, 2 * window_reach + 1>;

Window gaussian() {
    constexpr double deviation = 1.5;
    Window window;
    double sum = 0;
    for (int i = -window_reach; i <= window_reach; ++i)
        sum += window[i + window_reach] = std::exp(-0.5 * i * i / (deviation * deviation));
    for (double& weight : window) weight /= sum;
    return window;
}

// Weighted means around each pixel; at the picture's edge the window is cut and its weights are made to sum to 1.
std::vector<double> blurred(const std::vector<double>& values, int width, int height) {
    const Window window = gaussian();
    const auto along = [&](const std::vector<double>& from, int count, int lines, int step, int line_step) {
        std::vector<double> to(from.size());
        for (int line = 0; line < lines; ++line)
            for (int at = 0; at < count; ++at) {
                double sum = 0, weights = 0;
                for (int i = -window_reach; i <= window_reach; ++i) {
                    if (at + i < 0 || at + i >= count) continue;
                    sum +=
                        window[i + window_reach] * from[static_cast<std::size_t>(line) * line_step + (at + i) * step];
                    weights += window[i + window_reach];
                }
                to[static_cast<std::size_t>(line) * line_step + at * step] = sum / weights;
            }
        return to;
    };
    return along(along(values, width, height, 1, width), height, width, width, 1);
}

std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] * b[i];
    return out;
}

}  // namespace

double psnr(const render::Image& reference, const render::Image& test) {
    double sum = 0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        const double off = static_cast<double>(reference.pixels[i]) - test.pixels[i];
        sum += off * off;
    }
    if (sum == 0) return std::numeric_limits<double>::infinity();
    return 10.0 * std::log10(top * top * static_cast<double>(reference.pixels.size()) / sum);
}

double ssim(const render::Image& reference, const render::Image& test) {
    const int width = reference.width, height = reference.height;
    const std::vector<double> x = luma_of(reference), y = luma_of(test);
    const auto blur = [&](const std::vector<double>& values) { return blurred(values, width, height); };
    const std::vector<double> mx = blur(x), my = blur(y);
    const std::vector<double> xx = blur(product(x, x)), yy = blur(product(y, y)), xy = blur(product(x, y));
    constexpr double c1 = 0.01 * 0.01 * top * top, c2 = 0.03 * 0.03 * top * top;
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double vx = xx[i] - mx[i] * mx[i], vy = yy[i] - my[i] * my[i], vxy = xy[i] - mx[i] * my[i];
        sum += (2 * mx[i] * my[i] + c1) * (2 * vxy + c2) / ((mx[i] * mx[i] + my[i] * my[i] + c1) * (vx + vy + c2));
    }
    return sum / static_cast<double>(x.size());
}

glm::dvec3 mean_light(const render::Image& image) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double code = image.pixels[i] / top;
        sum[static_cast<int>(i % 3)] += code * code;
    }
    return sum / (static_cast<double>(image.width) * image.height);
}

render::Image box_filtered(const render::Image& image, int factor) {
    render::Image out{image.width / factor, image.height / factor, {}};
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                double sum = 0;
                for (int v = 0; v < factor; ++v)
                    for (int u = 0; u < factor; ++u) {
                        const std::size_t at =
                            std::size_t{3} *
                            ((static_cast<std::size_t>(y) * factor + v) * image.width + x * factor + u);
                        const double code = image.pixels[at + channel] / top;
                        sum += code * code;
                    }
                out.pixels.push_back(static_cast<std::uint8_t>(std::lround(top * std::sqrt(sum / (factor * factor)))));
            }
    return out;
}

}  // namespace bench
