// Whole frames without OpenGL: the same bits on every processor, whatever is skipped; and people who cover what their
// meshes do.
#include "render/native/renderer.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <optional>
#include <set>

#include "figures/points.h"
#include "figures/way.h"
#include "render/select.h"
#include "tests/render/small_scene.h"

namespace {

using render::native::PointPeople;
using render::native::Renderer;
using sfsm::State;

struct Place : tests::SmallScene {
    Place() : SmallScene(1200, 2) {}
    scene::StaticMesh structure = scene::build_structure(plan);
    scene::Cameras cameras = scene::aim_cameras(plan);

    Renderer renderer(int width, int height) const {
        return {structure, scene::paint_ground(plan), scene::Light{}, figures(), width, height};
    }
    render::Selector selector() const {
        render::SelectOptions options;
        options.way = &figures::natively();
        return {crowd, cast, SmallScene::figures(), options};
    }
};

const Place& place() {
    static const Place one;
    return one;
}

struct Shot {
    scene::CameraPose pose;
    int width = 323, height = 187;
    sfsm::Decision decision{State::points, 1e6, 1.0};
    std::int64_t tick = 100;
};

render::Image shoot(Renderer& renderer, render::Selector& selector, const Shot& shot) {
    const render::View view = render::make_view(shot.pose, shot.width, shot.height);
    selector.survey(view, shot.tick, renderer.begin(view));
    renderer.draw(selector.select(shot.decision, shot.tick - 1));
    return renderer.read_image();
}

// With nothing kept from before but what is known of the characters.
render::Image shoot(const Shot& shot) {
    static Renderer renderer = place().renderer(1, 1);
    static render::Selector selector = place().selector();
    renderer.resize(shot.width, shot.height);
    return shoot(renderer, selector, shot);
}

sfsm::Decision points_of(double splat_size) {
    return {State::points, 1e6, splat_size};
}

std::vector<Shot> presets(const sfsm::Decision& decision) {
    std::vector<Shot> shots;
    for (const std::string_view name : {"still", "close", "medium", "remote"})
        shots.push_back({place().cameras.named(std::string(name)).at(0), 323, 187, decision});
    return shots;
}

TEST(NativeRenderer, DrawsTheSameOnEveryInstructionSet) {
    for (const double splat_size : {0.0, 0.7, 3.3})
        for (const Shot& shot : presets(splat_size > 0 ? points_of(splat_size) : sfsm::Decision{})) {
            std::optional<render::Image> first;
            for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
                hwy::SetSupportedTargetsForTest(rest & -rest);
                const render::Image image = shoot(shot);
                hwy::SetSupportedTargetsForTest(0);
                if (first)
                    EXPECT_EQ(first->pixels, image.pixels) << hwy::TargetName(rest & -rest) << ", S " << splat_size;
                else
                    first = image;
            }
        }
}

TEST(NativeRenderer, DrawsTheSameOnAnyNumberOfThreads) {
    for (const double splat_size : {0.8, 2.5})
        for (const Shot& shot : presets(points_of(splat_size))) {
            const render::Image expected = shoot(shot);
            for (const int threads : {1, 2, 3, 8}) {
                tbb::task_arena arena(threads);
                arena.execute([&] { EXPECT_EQ(shoot(shot).pixels, expected.pixels) << threads << " threads"; });
            }
        }
}

// Where the stands hide most of the people in them.
std::vector<Shot> from_outside(const sfsm::Decision& decision) {
    std::vector<Shot> shots = presets(decision);
    for (const glm::dvec3 from : {glm::dvec3(220, 3, 0), glm::dvec3(0, 12, 200), glm::dvec3(-160, 30, 120)})
        shots.push_back({{from, {0, 4, 0}, 0.6}, 323, 187, decision});
    return shots;
}

TEST(NativeRenderer, DrawsTheSameWithoutTheHiddenPeople) {
    std::int64_t hidden = 0;
    Renderer renderer = place().renderer(323, 187);
    render::Selector selector = place().selector();
    for (const double splat_size : {0.0, 1.0})
        for (const Shot& shot : from_outside(splat_size > 0 ? points_of(splat_size) : sfsm::Decision{})) {
            const render::View view = render::make_view(shot.pose, shot.width, shot.height);
            const render::Surroundings around = renderer.begin(view);
            hidden += selector.survey(view, shot.tick, around).hidden;
            renderer.draw(selector.select(shot.decision, shot.tick - 1));
            const render::Image without = renderer.read_image();
            EXPECT_EQ(selector.survey(view, shot.tick, {around.work, nullptr}).hidden, 0);
            renderer.draw(selector.select(shot.decision, shot.tick - 1));
            EXPECT_EQ(renderer.read_image().pixels, without.pixels);
        }
    EXPECT_GT(hidden, 0) << "nobody was hidden: nothing is shown";
}

TEST(NativeRenderer, KeepsItsBackgroundAndItsPictureOnlyWhileTheyAreTrue) {
    const std::vector<Shot> shots = presets(points_of(1));
    Renderer renderer = place().renderer(323, 187);
    render::Selector selector = place().selector();
    const render::View still = render::make_view(shots[0].pose, 323, 187),
                       close = render::make_view(shots[1].pose, 323, 187);
    EXPECT_GT(renderer.begin(still).work[sfsm::WorkKind::pixel], 0);
    EXPECT_EQ(renderer.begin(still).work, sfsm::Work{}) << "the camera stands still";
    EXPECT_GT(renderer.begin(close).work[sfsm::WorkKind::pixel], 0);
    Shot shot = shots[0];
    for (const std::int64_t tick : {100, 100, 130, 130, 100}) {
        shot.tick = tick;
        EXPECT_EQ(shoot(renderer, selector, shot).pixels, shoot(shot).pixels) << "tick " << tick;
    }
    shot.decision.splat_size = 2;
    EXPECT_EQ(shoot(renderer, selector, shot).pixels, shoot(shot).pixels) << "another S";
    renderer.resize(200, 100);
    shot.width = 200, shot.height = 100;
    EXPECT_EQ(shoot(renderer, selector, shot).pixels, shoot(shot).pixels) << "another size";
}

// Of the camera, and of the picture. People are drawn both ways.
TEST(NativeRenderer, DrawsFromAnywhereAtAnySize) {
    const scene::CameraPose still = place().cameras.still.at(0);
    const glm::dvec3 inside = glm::dvec3(place().crowd.position[0]) + glm::dvec3(0, 1, 0);
    std::vector<Shot> shots;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 700), std::pair(2000, 1), std::pair(129, 127)})
        shots.push_back({still, width, height});
    const auto look = [&](glm::dvec3 from, glm::dvec3 towards, double degrees) {
        shots.push_back({{from, from + towards, degrees * std::numbers::pi / 180}, 160, 90});
    };
    for (const double degrees : {1.0, 50.0, 170.0}) {
        look(inside, {1, 0.1, 0}, degrees);
        look(inside, {0, -1, 0}, degrees);
        look(inside, {0, 1, 0}, degrees);
        look(inside + glm::dvec3(0.3, 0, 0), {-1, 0, 0}, degrees);
        look({0, 3000, 0}, {0, -1, 0.001}, degrees);
        look({0, 2, 0}, {0, 1, 0}, degrees);
    }
    for (Shot& shot : shots)
        for (const double splat_size : {0.0, 0.5, 32.0}) {
            shot.decision = splat_size > 0 ? points_of(splat_size) : sfsm::Decision{};
            const render::Image image = shoot(shot);
            EXPECT_EQ(image.pixels.size(), std::size_t{3} * shot.width * shot.height);
        }
    Shot wide{still, 8192, 8192, points_of(1)};
    EXPECT_EQ(shoot(wide).pixels.size(), std::size_t{3} * 8192 * 8192);
}

// The person in white, in every part of them.
struct White {
    model::Mesh mesh = place().person.mesh;
    pointsample::PointModel points = place().points;

    White() {
        std::ranges::fill(mesh.colors, glm::u8vec4(255));
        std::ranges::fill(points.colors, glm::u8vec4(255));
    }
    std::vector<figures::Figure> figures() const { return {{&mesh, &place().poses[0], &points}}; }
};

// One person in white before a black sky, lit alike from everywhere: the light that they send is what they cover. The
// same person's mesh, projected in double precision onto so many samples a pixel, is the truth.
class Alone {
public:
    // `aside`: [px] of the picture's middle; where in a cell somebody is changes how much a pixel takes of it.
    Alone(double height_px, double yaw, double elevation, int pose, glm::dvec2 aside)
        : pose_(pose), height_px_(height_px) {
        const motion::PoseTable& poses = place().poses[0];
        const double distance = 40, middle = poses.box.center().y;
        const double fov = 2 * std::atan(0.5 * side * poses.rest_height / (height_px * distance));
        const glm::dvec3 eye =
            glm::dvec3(0, middle, 0) + distance * glm::dvec3(0, std::sin(elevation), std::cos(elevation));
        const glm::dvec2 off = poses.rest_height / height_px * aside;
        view_ = render::make_view({eye, {0.03 + off.x, middle + 0.02 + off.y, 0}, fov}, side, side);
        sine_ = static_cast<std::int16_t>(std::lround(32767 * std::sin(yaw)));
        cosine_ = static_cast<std::int16_t>(std::lround(32767 * std::cos(yaw)));
    }

    double natively(double splat_size) const {
        static const White white;
        static Renderer renderer(scene::StaticMesh{}, scene::Ground{}, white_before_black(), white.figures(), side,
                                 side);
        renderer.begin(view_);
        render::Frame frame;
        frame.view = view_;
        frame.splat_size = splat_size;
        frame.people.push_back(person(splat_size));
        renderer.draw(frame);
        double covered = 0;
        const std::vector<std::uint8_t> pixels = renderer.read_image().pixels;
        for (std::size_t i = 0; i < pixels.size(); i += 3) covered += std::pow(pixels[i] / 255.0, 2);
        return covered;
    }

    // [px]
    double truly() const {
        const double samples = height_px_ < 4 ? 64 : 8;  // a pixel, across and down
        std::set<std::pair<int, int>> hit;
        const model::Mesh& mesh = place().person.mesh;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            glm::dvec2 p[3];
            for (int corner = 0; corner < 3; ++corner) p[corner] = samples * on_screen(mesh.indices[i + corner]);
            fill(p, hit);
        }
        return static_cast<double>(hit.size()) / (samples * samples);
    }

private:
    static constexpr int side = 160;

    static scene::Light white_before_black() {
        scene::Light light;
        light.sun = light.glare = light.haze = light.zenith = glm::vec3(0);
        light.from_above = light.from_below = glm::vec3(1);
        return light;
    }

    render::Person person(double splat_size) const {
        const motion::PoseTable& poses = place().poses[0];
        render::Person person{};
        person.instance.position = view_.relative(glm::vec3(0));
        person.instance.scale = 1;
        person.instance.turn.sin_yaw = sine_;
        person.instance.turn.cos_yaw = cosine_;
        person.instance.palette.colors.fill(glm::u8vec4(255));
        person.representation = 1;
        person.pose = static_cast<std::uint32_t>(pose_);
        person.depth = view_.depth(person.instance.position);
        const double pixels = view_.pixels_per_metre(person.depth);
        const auto demand = static_cast<float>(1.2 * poses.area * pixels * pixels / (splat_size * splat_size));
        figures::Level level = figures::native_points.levels(place().figures()[0]).back();
        const figures::Part part = figures::part_of(level, demand);
        person.count = part.count;
        person.last_share = part.last_share;
        return person;
    }

    glm::dvec2 on_screen(std::uint32_t vertex) const {
        const motion::PoseTable& poses = place().poses[0];
        const glm::dvec3 p = motion::unpack_position(
            poses.vertices[static_cast<std::size_t>(pose_) * poses.vertex_count + vertex], poses.box);
        const double s = sine_ / 32767.0, c = cosine_ / 32767.0;
        const glm::dvec3 at = glm::dvec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x) - view_.position;
        const double depth = glm::dot(at, glm::dvec3(view_.forward));
        return 0.5 * side *
               glm::dvec2(1 + glm::dot(at, glm::dvec3(view_.right)) / (depth * view_.tan_half_x),
                          1 - glm::dot(at, glm::dvec3(view_.up)) / (depth * view_.tan_half_y));
    }

    static void fill(const glm::dvec2 (&p)[3], std::set<std::pair<int, int>>& hit) {
        const auto across = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
            return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        };
        const double area = across(p[0], p[1], p[2]);
        if (area == 0) return;
        const glm::dvec2 low = glm::floor(glm::min(p[0], glm::min(p[1], p[2])));
        const glm::dvec2 high = glm::ceil(glm::max(p[0], glm::max(p[1], p[2])));
        for (int y = static_cast<int>(low.y); y < high.y; ++y)
            for (int x = static_cast<int>(low.x); x < high.x; ++x) {
                const glm::dvec2 at(x + 0.5, y + 0.5);
                if (across(p[0], p[1], at) / area >= 0 && across(p[1], p[2], at) / area >= 0 &&
                    across(p[2], p[0], at) / area >= 0)
                    hit.insert({x, y});
            }
    }

    int pose_;
    double height_px_;
    render::View view_;
    std::int16_t sine_, cosine_;
};

TEST(NativePoints, CoverWhatTheMeshDoes) {
    const int poses = place().poses[0].pose_count;
    for (const double height : {1.0, 2.0, 5.0, 12.0, 30.0, 60.0})
        for (const double splat_size : {0.6, 1.0, 2.0, 4.0}) {
            double covered = 0, truth = 0, worst = 0;
            for (int i = 0; i < 24; ++i) {
                const glm::dvec2 aside(std::fmod(1.618034 * i, 4.0), std::fmod(2.754878 * i, 4.0));
                const Alone person(height, 0.7 * i, 0.12 * i - 0.4, i * 97 % poses, aside);
                const double one = person.natively(splat_size), of = person.truly();
                covered += one;
                truth += of;
                worst = std::max(worst, std::abs(one / of - 1));
            }
            EXPECT_NEAR(covered / truth, 1, 0.03) << height << " px high, S " << splat_size;
            EXPECT_LT(worst, 0.4) << height << " px high, S " << splat_size;
        }
}

// [bytes]
std::size_t resident() {
    std::ifstream file("/proc/self/statm");
    std::size_t all = 0, pages = 0;
    file >> all >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(NativeRenderer, TakesNoMoreMemoryFrameAfterFrame) {
    Renderer renderer = place().renderer(96, 54);
    render::Selector selector = place().selector();
    Shot shot{{}, 96, 54};
    const auto draw = [&](int first, int end) {
        for (int frame = first; frame < end; ++frame) {
            shot.pose = place().cameras.roam.at(frame / 60.0);
            shot.tick = frame;
            shot.decision = points_of(0.5 + frame % 7 * 0.5);
            const render::View view = render::make_view(shot.pose, shot.width, shot.height);
            selector.survey(view, shot.tick, renderer.begin(view));
            renderer.draw(selector.select(shot.decision, shot.tick - 1));
        }
    };
    draw(0, 4000);  // until all that grows has seen its largest
    const std::size_t before = resident();
    draw(4000, 10000);
    constexpr std::size_t slack = std::size_t{2} << 20;
    EXPECT_LE(resident(), before + slack);
}

}  // namespace
