// The order in which people are drawn natively: of two who stand behind one another, the one behind must not show.
#include <algorithm>

#include "figures/points.h"
#include "figures/way.h"
#include "render/native/renderer.h"
#include "tests/native/far_crowd.h"
#include "tests/precision/things.h"

namespace precision {

namespace {

// All red, or all blue.
const tests::FarFigure& one_of(std::uint32_t number) {
    static const glm::u8vec4 red(255, 0, 0, 255), blue(0, 0, 255, 255);
    static const tests::FarFigure first({}, &red), second({}, &blue);
    return number == 0 ? first : second;
}

constexpr int side = 64;
constexpr double tall = 40;  // [px]

render::Person person_at(std::uint32_t number, double depth, const render::View& view) {
    const motion::PoseTable& poses = one_of(number).poses;
    render::Person person{};
    person.instance = {glm::vec3(0, -poses.box.center().y, -depth), 1, {0, 32767}, {}};
    person.character = number;
    person.depth = static_cast<float>(depth);
    person.batch = number;
    const auto all = figures::natively().representations;
    const auto points = std::ranges::find_if(all, [](const figures::Representation& one) { return !one.is_mesh; });
    person.representation = static_cast<std::uint32_t>(points - all.begin());
    const float splats = view.pixels_per_metre(person.depth);
    const figures::Part part = figures::part_of(figures::native_points.levels(one_of(number).figure()).back(),
                                                1.2f * poses.area * splats * splats);
    person.count = part.count;
    person.last_share = part.last_share;
    return person;
}

}  // namespace

// The one behind comes first in the crowd. Bodies are as deep as they are apart, so that where both are seen they share
// a pixel; but never may who is behind prevail.
double depth_limit_of_sort() {
    const scene::Light light = tests::even_before_black();
    const std::vector<figures::Figure> figures{one_of(0).figure(), one_of(1).figure()};
    render::native::Renderer renderer({}, {}, light, figures, side, side);
    double depth = 64;
    for (; depth < 1e9; depth *= 2) {
        constexpr double gap = 0.5;
        const double tangent = 0.5 * side * 1.75 / (tall * depth);
        const render::View view = render::make_view({{0, 0, 0}, {0, 0, -1}, 2 * std::atan(tangent)}, side, side);
        render::Frame frame;
        frame.view = view;
        frame.splat_size = 1;
        frame.batch_numbers = 2;
        frame.people = {person_at(1, depth + gap, view), person_at(0, depth, view)};
        renderer.begin(view);
        renderer.draw(frame);
        const render::Image image = renderer.read_image();
        double red = 0, blue = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
            red += image.pixels[i];
            blue += image.pixels[i + 2];
        }

        if (!(red > blue)) break;
    }
    return depth;
}

}  // namespace precision
