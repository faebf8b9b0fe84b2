// Who is seen and who is hidden, without OpenGL: people in front of and behind walls and one another, as triangles and
// as points, from 0.3 m to 3 km.
//
// All light comes from everywhere alike and nothing but people is red or blue, so that a pixel's red is the share of it
// that the red one covers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "figures/points.h"
#include "figures/way.h"
#include "pointsample/sample.h"
#include "render/native/renderer.h"
#include "scene/person.h"
#include "scene/static_mesh_builder.h"

namespace {

constexpr int width = 160, height = 96, tall = 60;  // [px] the picture, and people in it
constexpr double person_height = 1.75;              // [m]
const glm::dvec3 eye(20, 5, -30);                   // [m] where the camera is, looking along +z

// [m] to the foremost of whoever stands in front. Points are for those who are farther away than a few radii.
constexpr double nearest = 0.3, distances[] = {nearest, 5, 50, 500, 3000};
// [m] between a wall and what it must not touch: a hand.
constexpr double gap_to_wall = 0.1;
// [m] between one's back and the other's front: people closer than a body is deep are beside one another, and share.
constexpr double gap_to_other = 1.0;

enum class As { triangles, points };

const char* name_of(As as) {
    return as == As::triangles ? "triangles" : "points";
}

// The built-in person of one colour, in the pose that they have without a clip.
struct Dummy {
    model::Character character = scene::make_person();
    pointsample::PointModel points;
    motion::PoseTable poses;

    explicit Dummy(glm::u8vec4 color) {
        std::ranges::fill(character.mesh.colors, color);
        std::ranges::fill(character.mesh.slots, model::no_slot);
        pointsample::SampleOptions options;
        options.count = 3000;
        points = pointsample::sample(character.mesh, pointsample::spread_poses(character, {}, 1), options);
        poses = motion::bake_poses(character, {}, points.surface, std::size_t{1} << 24);
    }
    Dummy(const Dummy&) = delete;
    Dummy& operator=(const Dummy&) = delete;

    figures::Figure figure() const { return {&character.mesh, &poses, &points}; }
    // [m] before and behind the origin, as they face.
    double front() const { return poses.box.max.z; }
    double back() const { return -poses.box.min.z; }
};

const Dummy& dummy(std::uint32_t number) {
    static const Dummy red({255, 0, 0, 255}), blue({0, 0, 255, 255});
    return number == 0 ? red : blue;
}
constexpr std::uint32_t red = 0, blue = 1;

// Somebody who looks into the camera.
struct Who {
    std::uint32_t color;
    As as;
    double depth;      // [m] of their foremost, as long as they don't face aside
    double aside = 0;  // [m] to the left
};

double origin_depth(const Who& who) {
    return who.depth + dummy(who.color).front();
}

double backmost(const Who& who) {
    return origin_depth(who) + dummy(who.color).back();
}

render::View view_of(double distance) {
    const double at = distance + dummy(red).front();
    const double fov = 2 * std::atan(0.5 * height / tall * person_height / at);
    return render::make_view({eye, eye + glm::dvec3(0, 0, 1), fov}, width, height);
}

render::Person person_of(const Who& who, const render::View& view, double splat_size) {
    const Dummy& model = dummy(who.color);
    render::Person person{};
    person.instance.position = glm::vec3(who.aside, -model.poses.box.center().y, origin_depth(who));
    person.instance.scale = 1;
    person.instance.turn.cos_yaw = -32767;
    person.character = who.color;
    person.depth = view.depth(person.instance.position);
    person.batch = who.color;
    person.last_share = 1;
    if (who.as == As::triangles) return person;
    const auto by = [&](const figures::Representation& one) { return !one.is_mesh; };
    const auto all = figures::natively().representations;
    person.representation = static_cast<std::uint32_t>(std::ranges::find_if(all, by) - all.begin());
    const double splats = view.pixels_per_metre(person.depth) / splat_size;  // a metre
    const auto demand = static_cast<float>(1.2 * model.poses.area * splats * splats);
    const figures::Part part = figures::part_of(figures::native_points.levels(model.figure()).back(), demand);
    person.count = part.count;
    person.last_share = part.last_share;
    return person;
}

// What of each pixel is red, and blue: as bytes, which are equal where the same was covered.
struct Seen {
    std::vector<std::uint8_t> red, blue;
};

// [0, 1] of a pixel.
double share(std::uint8_t byte) {
    return byte / 255.0 * (byte / 255.0);
}

int lit(const std::vector<std::uint8_t>& bytes) {
    return static_cast<int>(std::ranges::count_if(bytes, [](std::uint8_t byte) { return byte > 0; }));
}

double sum(const std::vector<std::uint8_t>& bytes) {
    double all = 0;
    for (const std::uint8_t byte : bytes) all += share(byte);
    return all;
}

// A green wall across the view at `depth` [m], from `left` to `right` in pictures' halves.
scene::StaticMesh wall(const render::View& view, double depth, double left = -2, double right = 2) {
    const double half_x = depth * view.tan_half_x, half_y = 2 * depth * view.tan_half_y;
    const auto at = [&](double x, double y) { return glm::vec3(eye + glm::dvec3(-x * half_x, y * half_y, depth)); };
    scene::StaticMeshBuilder builder;
    builder.quad(at(left, -1), at(right, -1), at(right, 1), at(left, 1), scene::painted(0, 255, 0));
    builder.close_sector();
    return builder.mesh;
}

class Stage {
public:
    explicit Stage(double distance, const scene::StaticMesh& structure = {}, double splat_size = 1)
        : view_(view_of(distance)),
          splat_size_(splat_size),
          renderer_(structure, {}, even_light(), figures(), width, height) {}

    Seen look_at(const std::vector<Who>& people) {
        render::Frame frame;
        frame.view = view_;
        frame.splat_size = splat_size_;
        for (const Who& who : people) frame.people.push_back(person_of(who, view_, splat_size_));
        renderer_.begin(view_);
        renderer_.draw(frame);
        const std::vector<std::uint8_t> pixels = renderer_.read_image().pixels;
        Seen seen;
        for (std::size_t i = 0; i < pixels.size(); i += 3) {
            seen.red.push_back(pixels[i]);
            seen.blue.push_back(pixels[i + 2]);
        }
        return seen;
    }

private:
    static scene::Light even_light() {
        scene::Light light;
        light.sun = light.glare = light.haze = light.zenith = glm::vec3(0);
        light.from_above = light.from_below = glm::vec3(1);
        return light;
    }
    static std::vector<figures::Figure> figures() { return {dummy(red).figure(), dummy(blue).figure()}; }

    render::View view_;
    double splat_size_;
    render::native::Renderer renderer_;
};

// [of a pixel] Points' depths are weighed by what they cover, in 13 bits: of so little they cannot be told.
constexpr double dust = 4.0 / 8192;

// Whoever fills fewer pixels shows nothing.
constexpr int least_pixels = 300;

class Order : public testing::TestWithParam<double> {
protected:
    static double distance() { return GetParam(); }
    static std::vector<As> ways() {
        if (distance() == nearest) return {As::triangles};
        return {As::triangles, As::points};
    }
};

TEST_P(Order, AWallHidesWhoIsBehindItAndNobodyInFront) {
    const render::View view = view_of(distance());
    const Who anybody{red, As::triangles, distance()};
    Stage open(distance()), before(distance(), wall(view, distance() - gap_to_wall)),
        behind(distance(), wall(view, backmost(anybody) + gap_to_wall));
    for (const As as : ways()) {
        const std::vector<Who> whom{{red, as, distance()}};
        const Seen alone = open.look_at(whom);
        EXPECT_GT(lit(alone.red), least_pixels) << name_of(as);
        EXPECT_EQ(lit(before.look_at(whom).red), 0) << name_of(as) << " behind the wall";
        const std::vector<std::uint8_t> seen = behind.look_at(whom).red;
        for (std::size_t i = 0; i < seen.size(); ++i)
            ASSERT_NEAR(share(seen[i]), share(alone.red[i]), as == As::triangles ? 0 : dust)
                << name_of(as) << " in front of the wall, pixel " << i;
    }
}

TEST_P(Order, AWallsEdgeCutsWhomItHidesAndLeavesTheRest) {
    Stage open(distance()), half(distance(), wall(view_of(distance()), distance() - gap_to_wall, -2, 0));
    for (const As as : ways()) {
        const std::vector<Who> whom{{red, as, distance()}};
        std::vector<std::uint8_t> expected = open.look_at(whom).red;
        for (std::size_t i = 0; i < expected.size(); ++i)
            if (i % width < width / 2) expected[i] = 0;
        EXPECT_GT(lit(expected), least_pixels / 2) << name_of(as);
        EXPECT_EQ(half.look_at(whom).red, expected) << name_of(as);
    }
}

// A wall that is moved back through them uncovers more and more.
TEST_P(Order, WhoeverStandsInAWallIsSeenAsFarAsTheyReachOut) {
    const render::View view = view_of(distance());
    const double end = backmost({red, As::triangles, distance()});
    constexpr int steps = 6;
    for (const As as : ways()) {
        const std::vector<Who> whom{{red, as, distance()}};
        const Seen alone = Stage(distance()).look_at(whom);
        std::vector<std::uint8_t> before(alone.red.size());
        int partly = 0;
        for (int step = 1; step < steps; ++step) {
            const double depth = distance() + (end - distance()) * step / steps;
            const std::vector<std::uint8_t> now = Stage(distance(), wall(view, depth)).look_at(whom).red;
            for (std::size_t i = 0; i < now.size(); ++i) {
                ASSERT_GE(now[i], before[i]) << name_of(as) << ", pixel " << i << ", step " << step;
                ASSERT_LE(now[i], alone.red[i]) << name_of(as) << ", pixel " << i << ", step " << step;
            }
            partly += sum(now) > 0.05 * sum(alone.red) && sum(now) < 0.95 * sum(alone.red);
            before = now;
        }
        EXPECT_GE(partly, 1) << name_of(as) << ": nobody was ever half behind the wall";
    }
}

TEST_P(Order, OfTwoTheNearerHidesTheFarther) {
    // [of 1] Three bytes of light, each half a step of the stored root off, and 14 bits of coverage.
    constexpr double rounding = 0.015;
    constexpr int enough = 20;                  // [px] From 0.3 m, who is a metre behind is small.
    constexpr double steps_aside[] = {0, 0.3};  // [m] the farther is hidden wholly but for perspective, or half
    Stage stage(distance());
    for (const As front_as : ways())
        for (const As back_as : ways())
            for (const double aside : steps_aside) {
                const std::string what = std::string(name_of(front_as)) + " before " + name_of(back_as) + ", " +
                                         std::to_string(aside) + " m aside";
                const Who front{red, front_as, distance()},
                    back{blue, back_as, backmost(front) + gap_to_other, aside * (1 + 1 / distance())};
                const Seen both = stage.look_at({front, back}), listed_last = stage.look_at({back, front});
                EXPECT_EQ(both.red, listed_last.red) << what;
                EXPECT_EQ(both.blue, listed_last.blue) << what;
                const std::vector<std::uint8_t> first = stage.look_at({front}).red, second = stage.look_at({back}).blue;
                EXPECT_EQ(both.red, first) << what << ": the nearer is seen as if alone";
                int hidden = 0, open = 0, wrong = 0;
                double most = 0;
                for (std::size_t i = 0; i < first.size(); ++i) {
                    // Within a pixel the nearer may cover the same part as the farther, or another.
                    const double r = share(first[i]), b = share(second[i]), shown = share(both.blue[i]);
                    const double off = std::max(std::max(0.0, b - r) - shown, shown - std::min(b, 1 - r));
                    most = std::max(most, off);
                    wrong += off > rounding;
                    hidden += first[i] == 255 && b > 0.5;
                    open += r == 0 && b > 0.5;
                }
                EXPECT_EQ(wrong, 0) << what << ", by up to " << most;
                EXPECT_GT(aside > 0 ? open : hidden, enough) << what;
            }
}

INSTANTIATE_TEST_SUITE_P(Metres, Order, testing::ValuesIn(distances));

// Cells that are larger than pixels, or points that are fewer, by S [px]: the last with cells of pixels, cells that are
// hardly larger, as large as S, and no whole number.
const double last_of_pixels = std::exp2(0.25);
class CoarseOrder : public testing::TestWithParam<double> {
protected:
    static constexpr double distance = 50;
    static constexpr Who whom{red, As::points, distance};
    static Stage stage(const scene::StaticMesh& structure = {}) { return Stage(distance, structure, GetParam()); }
};

TEST_P(CoarseOrder, CellsHardlyLargerThanPixelsShowWhatPixelsDo) {
    const double finest = last_of_pixels;
    if (GetParam() > finest + 0.01) GTEST_SKIP() << "larger";
    const double larger = GetParam() / finest - 1;
    // [of 1] Two bytes of light, and of four cells' worth of points, which are placed to a 128th of a cell.
    constexpr double rounding = 0.015 + 4.0 / 128;
    const double off = larger * (width + height) + rounding;  // so far the last cells are aside of their pixels
    const Seen fine = Stage(distance, {}, finest).look_at({whom}), coarse = stage().look_at({whom});
    for (std::size_t i = 0; i < fine.red.size(); ++i)
        ASSERT_NEAR(share(coarse.red[i]), share(fine.red[i]), off) << "pixel " << i;
}

TEST_P(CoarseOrder, NobodyLosesAnythingInBetween) {
    double fine = 0, coarse = 0;
    for (const double aside : {-0.31, -0.12, 0.0, 0.07, 0.23, 0.4}) {
        const Who somewhere{red, As::points, distance, aside};
        fine += sum(Stage(distance).look_at({somewhere}).red);
        coarse += sum(stage().look_at({somewhere}).red);
    }
    EXPECT_NEAR(coarse, fine, 0.04 * fine);
}

TEST_P(CoarseOrder, AWallHidesWhoIsBehindItAndNobodyInFront) {
    const render::View view = view_of(distance);
    const Seen alone = stage().look_at({whom});
    EXPECT_EQ(lit(stage(wall(view, distance - gap_to_wall)).look_at({whom}).red), 0);
    const std::vector<std::uint8_t> seen = stage(wall(view, backmost(whom) + gap_to_wall)).look_at({whom}).red;
    for (std::size_t i = 0; i < seen.size(); ++i)
        ASSERT_NEAR(share(seen[i]), share(alone.red[i]), dust) << "in front of the wall, pixel " << i;
}

TEST_P(CoarseOrder, AWallsEdgeCutsWhomItHidesPixelByPixel) {
    for (const double edge : {-0.05, 0.0, 0.03}) {
        std::vector<std::uint8_t> expected = stage().look_at({whom}).red;
        const int end = static_cast<int>(std::lround((1 + edge) * width / 2));
        for (std::size_t i = 0; i < expected.size(); ++i)
            if (static_cast<int>(i % width) < end) expected[i] = 0;
        const double at = 2.0 * end / width - 1;
        EXPECT_EQ(stage(wall(view_of(distance), distance - gap_to_wall, -2, at)).look_at({whom}).red, expected) << at;
    }
}

TEST_P(CoarseOrder, NearPeopleComeInBetweenPixelByPixel) {
    constexpr double rounding = 0.015;  // as of two people above
    Stage both = stage();
    const Who near{blue, As::triangles, backmost(whom) + gap_to_other, 0.3};
    const Who behind{red, As::points, backmost(near) + gap_to_other, 0.5};
    const Seen before = both.look_at({whom, near}), after = both.look_at({near, behind});
    const Seen near_alone = both.look_at({near});
    EXPECT_EQ(before.red, both.look_at({whom}).red) << "points before triangles";
    EXPECT_EQ(after.blue, near_alone.blue) << "triangles before points";
    const Seen behind_alone = both.look_at({behind});
    for (std::size_t i = 0; i < after.red.size(); ++i) {
        const double n = share(near_alone.blue[i]);
        EXPECT_NEAR(share(after.red[i]), share(behind_alone.red[i]) * (1 - n), rounding) << "pixel " << i;
        EXPECT_NEAR(share(before.blue[i]), n * (1 - share(before.red[i])), rounding) << "pixel " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Pixels, CoarseOrder, testing::Values(last_of_pixels, last_of_pixels + 5e-6, 2.0, 3.7));

}  // namespace
