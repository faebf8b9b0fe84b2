// The native background against OpenGL's.
#include "render/gl/renderer.h"
#include "render/native/backdrop.h"
#include "scene/places/stadium.h"
#include "tests/native/painting.h"
#include "tests/render/gl_test.h"

namespace {

using NativeBackdropAndGl = tests::GlTest;

TEST_F(NativeBackdropAndGl, ShowTheSame) {
    constexpr int width = 640, height = 360;
    constexpr int near_enough = 2;                       // of 255: rounding of two ways to the same number
    constexpr int most_others = width * height / 10000;  // on edges, which pass a pixel's centre on either side
    const scene::StadiumPlan plan = scene::plan_stadium(600);
    const scene::StaticMesh structure = scene::build_structure(plan);
    const scene::Ground ground = scene::paint_ground(plan);
    const scene::Cameras cameras = scene::aim_cameras(plan);
    render::gl::Renderer gl(structure, ground, {}, {}, width, height);
    render::native::Backdrop native(structure, ground, {});
    for (const scene::CameraPath* path :
         {&cameras.still, &cameras.close, &cameras.medium, &cameras.remote, &cameras.roam})
        for (const double time : {0.0, 21.0, 44.0}) {
            render::Frame nobody;
            nobody.view = render::make_view(path->at(time), width, height);
            gl.draw(nobody);
            const render::Image expected = gl.read_image();
            const render::native::BackdropPicture picture = tests::paint(native, nobody.view);
            int others = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    int difference = 0;
                    for (int channel = 0; channel < 3; ++channel) {
                        const int byte = picture.color.row(y)[x] >> (8 * channel) & 255;
                        difference =
                            std::max(difference,
                                     std::abs(byte - expected.pixels[3 * (std::size_t{1} * y * width + x) + channel]));
                    }
                    others += difference > near_enough;
                }
            EXPECT_LE(others, most_others);
        }
}

}  // namespace
