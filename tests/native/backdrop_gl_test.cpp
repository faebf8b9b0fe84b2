// The native background against OpenGL's.
#include <cmath>
#include <vector>

#include "render/gl/renderer.h"
#include "render/native/backdrop.h"
#include "scene/places/stadium.h"
#include "tests/native/painting.h"
#include "tests/render/gl_test.h"

namespace {

using NativeBackdropAndGl = tests::GlTest;

constexpr int width = 640, height = 360;
// OpenGL has one sample a pixel and the processor four: each is in the middle of one of so many times as many pixels.
constexpr int finer = render::native::sample_steps / 2;

int byte_of(const render::Image& image, int x, int y, int channel) {
    return image.pixels[3 * (std::size_t{1} * y * image.width + x) + channel];
}

// The mean of the samples' light in a channel, as the square root of it.
double filtered(const render::Image& fine, int x, int y, int channel) {
    double light = 0;
    for (const render::native::SamplePoint& at : render::native::sample_points<4>) {
        const double root = byte_of(fine, finer * x + at.x / 2, finer * y + at.y / 2, channel);
        light += root * root / 4;
    }
    return std::sqrt(light);
}

// Where one surface fills a pixel both show it by one sample's light, and across edges the processor shows the mean of
// its samples'.
TEST_F(NativeBackdropAndGl, ShowTheSame) {
    constexpr int near_enough = 2;  // of 255: rounding of two ways to the same number
    // Ground and sky that are seen in a part of a pixel have the light of its middle.
    constexpr int nearly = 12;  // of 255
    constexpr int most_nearly =
        width * height / 500 + width;  // at the horizon, a row of pixels, the sky changes fastest
    // Edges pass a sample on either side.
    constexpr int most_others = 4 * width * height / 10000;
    const scene::StadiumPlan plan = scene::plan_stadium(600);
    const scene::StaticMesh structure = scene::build_structure(plan);
    const scene::Ground ground = scene::paint_ground(plan);
    const scene::Cameras cameras = scene::aim_cameras(plan);
    render::gl::Renderer gl(structure, ground, {}, {}, width, height);
    render::native::Backdrop native(structure, ground, {});
    const auto shoot = [&](const scene::CameraPose& pose, int times) {
        gl.resize(times * width, times * height);
        render::Frame nobody;
        nobody.view = render::make_view(pose, times * width, times * height);
        gl.draw(nobody);
        return gl.read_image();
    };
    std::vector<scene::CameraPose> poses = {
        {{1000, 300, 400}, {0, 0, 0}, 1}, {{10, 1000, 5}, {0, 0, 0}, 1}, {{3000, 30, -4000}, {0, 20, 0}, 0.5}};
    for (const scene::CameraPath* path :
         {&cameras.still, &cameras.close, &cameras.medium, &cameras.remote, &cameras.roam})
        for (const double time : {0.0, 21.0, 44.0}) poses.push_back(path->at(time));
    for (const scene::CameraPose& pose : poses) {
        const render::Image same = shoot(pose, 1), fine = shoot(pose, finer);
        const render::native::BackdropPicture picture = tests::paint(native, render::make_view(pose, width, height));
        int nearlies = 0, others = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                double off_same = 0, off_mean = 0;
                for (int channel = 0; channel < 3; ++channel) {
                    const int byte = picture.color.row(y)[x] >> (8 * channel) & 255;
                    off_same = std::max<double>(off_same, std::abs(byte - byte_of(same, x, y, channel)));
                    off_mean = std::max(off_mean, std::abs(byte - filtered(fine, x, y, channel)));
                }
                const double off = std::min(off_same, off_mean);
                nearlies += off > near_enough;
                others += off > nearly;
            }
        std::printf("%d nearly, %d others\n", nearlies, others);
        EXPECT_LE(nearlies, most_nearly);
        EXPECT_LE(others, most_others);
    }
}

}  // namespace
