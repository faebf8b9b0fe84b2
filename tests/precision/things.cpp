#include "tests/precision/things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "figures/way.h"
#include "render/native/far_people.h"
#include "render/native/triangles_on_screen.h"
#include "tests/native/far_crowd.h"

namespace precision {

namespace {

constexpr double person_height = 1.75;  // [m]
constexpr double gap = 0.5;             // [m] between two people

double unit(int number, int axis) {
    const double value = 0.754877666 * number + 0.569840291 * axis + 0.25 * number * axis;
    return value - std::floor(value);
}

const tests::FarFigure& somebody() {
    static const tests::FarFigure one(std::array<int, 0>{});
    return one;
}

// One person of a far block, in cells of a pixel.
class FarSplat {
public:
    FarSplat() : model_(figures_[0], tests::even_before_black()), crowd_(figures_, tests::even_before_black()) {
        crowd_.learn(std::array<const render::native::SplatModel*, 1>{&model_});
    }

    struct Covered {
        double area;        // [px^2]
        glm::dvec2 middle;  // [px]
    };
    // Somebody at `local` [m] from their block's origin, which is at `place`.
    Covered cover(const glm::dvec3& place, glm::vec3 local, const render::View& view) {
        tests::FarGathering gathering(figures_);
        tests::FarPerson person;
        person.at = local;
        person.role = scene::Role::standing;
        gathering.add_block(std::array{person});
        gathering.add_others();
        for (scene::CrowdBlock& block : gathering.crowd.blocks) block.origin = place;
        render::Frame frame = gathering.frame(view, {});
        const glm::vec3 middle = view.from(place).relative(gathering.crowd.blocks[0].box.center());
        frame.far_blocks = {{0, view.depth(middle), 0}};
        crowd_ = render::native::FarCrowd(figures_, tests::even_before_black());
        crowd_.learn(std::array<const render::native::SplatModel*, 1>{&model_});
        crowd_.prepare(frame, 1);
        const render::native::Rect cells = crowd_.blocks()[0].cells();
        const render::native::Patch patch = room_.patch(cells.x0, cells.y0, cells.x1 - cells.x0, cells.y1 - cells.y0);
        crowd_.splat(crowd_.blocks()[0], patch);
        Covered covered{0, glm::dvec2(0)};
        for (int y = 0; y < patch.height; ++y)
            for (int x = 0; x < patch.width; ++x) {
                // What covers a cell by chance, taken back to areas.
                const double share = patch.cells[8 * (patch.stride * y + x) + 3] / 8192.0;
                const double area = -std::log(1 - std::min(share, 0.999));
                covered.area += area;
                covered.middle += area * glm::dvec2(patch.x0 + x + 0.5, patch.y0 + y + 0.5);
            }
        render::native::clear(patch);
        if (covered.area > 0) covered.middle /= covered.area;
        return covered;
    }

    // [m] Of the splat, from the person's origin, unturned.
    glm::dvec3 center() const {
        return person_height / double(somebody().height()) *
               glm::dvec3(render::native::far_shape(somebody().poses).center);
    }

private:
    std::vector<figures::Figure> figures_{somebody().figure()};
    render::native::SplatModel model_;
    render::native::FarCrowd crowd_;
    render::native::PatchRoom room_;
};

// Doubles a depth until people aren't told apart.
template <typename ToldApart>
double first_failure(ToldApart told_apart) {
    double depth = 64;
    while (depth < 1e15 && told_apart(depth)) depth *= 2;
    return depth;
}

float depth_at(double depth) {
    const render::View view = render::make_view({{0, 0, 0}, {0.6, 0, 0.8}}, 1920, 1080);
    return view.depth(render::relative(glm::vec3(0), -depth * glm::dvec3(0.6, 0, 0.8)));
}

}  // namespace

Errors errors_of_structure(const Setting& setting, double spread) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 64; ++i)
        corners.emplace_back(spread * (2 * unit(i, 1) - 1), 0.2 * spread * unit(i, 2), spread * (2 * unit(i, 3) - 1));
    const render::native::Corners packed(corners);
    render::native::ScreenCorners screen(packed.count);
    const glm::dvec3 origin = setting.place();
    Errors errors;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 at = origin + glm::dvec3(corners[i]);
        const scene::CameraPose pose = aim(setting, at + glm::dvec3(0.1, 0.2, 0.1), static_cast<int>(i));
        const render::View view = render::make_view(pose, setting.width, setting.height);
        render::native::project(view.from(origin), packed, screen);
        const glm::dvec2 truth = Eye(pose, setting.width, setting.height).pixel(at - pose.position);
        if (screen.sides[i] & render::native::clipped) continue;
        errors.add(glm::distance(glm::dvec2(screen.x[i], screen.y[i]) / 256.0, truth));
    }
    return errors;
}

CoverageErrors errors_of_coverage(const Setting& setting) {
    constexpr double height_px = 1.2;
    FarSplat splat;
    const glm::dvec3 place = setting.place();
    const double distance = std::max(2.0, person_height * setting.pixels_per_metre(1) / height_px);
    const double pixels = person_height * setting.pixels_per_metre(distance);
    const double true_area = area_of_person(height_px) * std::pow(pixels / height_px, 2);
    CoverageErrors errors;
    for (int i = 0; i < 32; ++i) {
        const glm::vec3 local(20 * unit(i, 1), 3 * unit(i, 2), 20 * unit(i, 3));
        const glm::dvec3 middle = place + glm::dvec3(local) + splat.center();
        scene::CameraPose pose = aim(setting, middle, 0);
        const glm::dvec3 back = glm::normalize(pose.position - pose.target);
        pose.position = middle + distance * back;
        // So that the person lies anywhere on the grid; a picture of one pixel has none, and aside all is aslant.
        const double pixel = std::min(1.0, 0.05 * setting.height) / setting.pixels_per_metre(distance);
        const glm::dvec3 right = glm::normalize(glm::cross(back, glm::dvec3(0, 1, 0)));
        const glm::dvec3 off = pixel * (unit(i, 4) * right + glm::dvec3(0, unit(i, 5), 0));
        pose.position += off;
        pose.target += off;
        const FarSplat::Covered covered =
            splat.cover(place, local, render::make_view(pose, setting.width, setting.height));
        const glm::dvec2 truth = Eye(pose, setting.width, setting.height).pixel(middle - pose.position);
        errors.middle.add(covered.area * glm::distance(covered.middle, truth));
        errors.area.add(std::abs(covered.area - true_area));
    }
    return errors;
}

double area_of_person(double height_px) {
    FarSplat splat;
    const Setting setting{1, 0, 1, 7680, 4320};
    const double distance = person_height * setting.pixels_per_metre(1) / height_px;
    const scene::CameraPose pose{splat.center() + distance * glm::dvec3(0, 0, 1), splat.center(),
                                 setting.fov * std::numbers::pi / 180};
    return splat.cover(glm::dvec3(0), glm::vec3(0), render::make_view(pose, setting.width, setting.height)).area;
}

double depth_limit_of_frame() {
    return first_failure([](double depth) { return depth_at(depth) < depth_at(depth + gap); });
}

double depth_limit_of_buffer() {
    return first_failure(
        [](double depth) { return render::near_plane / depth_at(depth) > render::near_plane / depth_at(depth + gap); });
}

}  // namespace precision
