// People drawn by the processor as triangles, held against a rasteriser of doubles that tries every triangle on every
// sample, and against themselves: the same bits by every instruction set, number of threads and cut into tiles.
#include "render/native/triangles.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <random>

#include "scene/cast.h"
#include "scene/person.h"
#include "tests/native/layers.h"
#include "tests/native/mesh_people.h"
#include "tests/render/stiff_mesh.h"

namespace {

using render::native::TrianglePeople;

// A character with everything that drawers need, in its rest pose or its clips.
struct Actor {
    model::Character character;
    motion::PoseTable poses;

    explicit Actor(model::Character from, const std::vector<int>& clips = {})
        : character(std::move(from)), poses(motion::bake_poses(character, clips, {}, std::size_t{1} << 26)) {}
    Actor(const Actor&) = delete;
    Actor& operator=(const Actor&) = delete;

    figures::Figure figure() const { return {&character.mesh, &poses, nullptr}; }
};

// Uniform in [low, high): the same everywhere.
double draw_number(std::mt19937& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
}

struct Soup {
    int triangles = 100;
    double size = 0.3;  // [m] of a triangle, in a room of 2 m
    bool double_sided = false, textured = false;
    unsigned seed = 1;
};

// Triangles that have nothing to do with each other, of all colours.
model::Character make_soup(const Soup& soup) {
    std::mt19937 random(soup.seed);
    const auto vector = [&](double reach) {
        const double x = draw_number(random, -reach, reach), y = draw_number(random, -reach, reach);
        return glm::vec3(x, y, draw_number(random, -reach, reach));
    };
    model::Character character;
    character.name = "soup";
    model::Mesh& mesh = character.mesh;
    model::Material material;
    material.double_sided = soup.double_sided;
    if (soup.textured) {
        material.texture = 0;
        model::Texture texture{16, 16, {}};
        for (int i = 0; i < 256; ++i) texture.texels.emplace_back(random() % 256, random() % 256, random() % 256, 255);
        mesh.textures.push_back(texture);
    }
    mesh.materials.push_back(material);
    for (int t = 0; t < soup.triangles; ++t) {
        const glm::vec3 middle = vector(1);
        for (int k = 0; k < 3; ++k) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            const glm::vec3 position = middle + vector(soup.size);
            tests::add_vertex(mesh, position, glm::normalize(vector(1) + glm::vec3(1e-3f)));
            mesh.uvs.back() = glm::vec2(draw_number(random, -1, 2), draw_number(random, -1, 2));
            mesh.colors.back() = glm::u8vec4(random() % 256, random() % 256, random() % 256, 255);
            mesh.slots.back() = static_cast<model::Slot>(random() % (model::slot_count + 1));
        }
    }
    tests::add_only_joint(character);
    return character;
}

render::Person person_at(const glm::vec3& position, float scale = 1, double yaw = 0.4, std::uint32_t pose = 0,
                         std::uint32_t character = 0) {
    render::Person person{};
    person.instance.position = position;
    person.instance.scale = scale;
    person.instance.turn.sin_yaw = static_cast<std::int16_t>(std::lround(32767 * std::sin(yaw)));
    person.instance.turn.cos_yaw = static_cast<std::int16_t>(std::lround(32767 * std::cos(yaw)));
    person.instance.palette.colors = {
        {{230, 60, 50, 255}, {40, 200, 70, 255}, {60, 80, 240, 255}, {240, 220, 60, 255}}};
    person.pose = pose;
    person.character = character;
    return person;
}

// From the origin along -z.
render::View view_of(int width, int height, double fov_y = 0.9) {
    scene::CameraPose pose;
    pose.target = {0, 0, -1};
    pose.fov_y = fov_y;
    return render::make_view(pose, width, height);
}

// ---- the rasteriser of doubles ----

constexpr int across = render::native::samples_across;

struct Sample {
    double depth = 0;  // near_plane / view depth
    glm::dvec3 color{0};
    bool certain = true;  // no other triangle has its edge so close that rounding may decide
};

struct Exact {
    int width, height;  // [samples]
    std::vector<Sample> samples;
};

glm::dvec3 light_on(const glm::dvec3& n) {
    const scene::Light light;
    const glm::dvec3 around = glm::mix(glm::dvec3(light.from_below), glm::dvec3(light.from_above), 0.5 + 0.5 * n.y);
    return around + glm::dvec3(light.sun) * std::max(glm::dot(n, glm::dvec3(light.to_sun)), 0.0);
}

struct ExactVertex {
    glm::dvec3 position;  // right, up, forward [m]
    glm::dvec3 light[2];  // from before, and from behind
    glm::dvec3 albedo;
};

ExactVertex exact_vertex(const Actor& actor, const render::Person& person, const render::View& view, std::uint32_t v) {
    const render::Instance& instance = person.instance;
    const double sin = instance.turn.sin_yaw / 32767.0, cos = instance.turn.cos_yaw / 32767.0;
    const auto turned = [&](const glm::dvec3& p) {
        return glm::dvec3(cos * p.x + sin * p.z, p.y, cos * p.z - sin * p.x);
    };
    const model::Mesh& mesh = actor.character.mesh;
    const auto& posed = actor.poses.vertices[std::size_t{person.pose} * actor.poses.vertex_count + v];
    const glm::dvec3 world = glm::dvec3(instance.position) +
                             double{instance.scale} * turned(motion::unpack_position(posed, actor.poses.box));
    const glm::dvec3 normal = turned(motion::unpack_normal(posed));
    glm::dvec3 albedo = glm::dvec3(mesh.colors[v]) / 255.0;
    albedo *= albedo;
    if (mesh.slots[v] != model::no_slot) {
        const glm::dvec3 own = glm::dvec3(glm::vec4(instance.palette[mesh.slots[v]])) / 255.0;
        albedo *= own * own;
    }
    const glm::dvec3 right = view.right, up = view.up, forward = view.forward;
    return {{glm::dot(right, world), glm::dot(up, world), glm::dot(forward, world)},
            {light_on(normal), light_on(-normal)},
            albedo};
}

// By the ray through each sample: no clipping, no projection, no edges on a grid.
void cast(const ExactVertex (&v)[3], bool double_sided, const render::View& view, Exact& out) {
    const glm::dvec3 a = v[0].position, b = v[1].position, c = v[2].position;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const bool is_behind = glm::dot(normal, a) < 0;  // forward points into the picture: left-handed axes
    const bool culled = !double_sided && is_behind;
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const glm::dvec3 ray((2 * (x + 0.5) / out.width - 1) * view.tan_half_x,
                                 (1 - 2 * (y + 0.5) / out.height) * view.tan_half_y, 1);
            // Volumes: the shares of the corners, but for a common factor.
            const glm::dvec3 shares(glm::dot(ray, glm::cross(b, c)), glm::dot(ray, glm::cross(c, a)),
                                    glm::dot(ray, glm::cross(a, b)));
            const double sum = shares.x + shares.y + shares.z;
            if (sum == 0) continue;
            const glm::dvec3 w = shares / sum;
            const double depth = glm::dot(w, glm::dvec3(a.z, b.z, c.z));
            // How much the shares change when the vertices are put on the grid, several times over.
            constexpr double rounding = 0.2;  // [samples]
            const double step = rounding * 2.0 * view.tan_half_y / out.height;
            const glm::dvec3 all = glm::cross(b, c) + glm::cross(c, a) + glm::cross(a, b);
            const auto slope = [&](const glm::dvec3& p, const glm::dvec3& q, double share) {
                return glm::length(glm::cross(p, q) - share * all) / std::abs(sum);
            };
            const glm::dvec3 margin = step * glm::dvec3(slope(b, c, w.x), slope(c, a, w.y), slope(a, b, w.z));
            constexpr double steep = 0.03;  // where colours and depths change a lot from sample to sample
            const bool near_edge =
                glm::any(glm::lessThan(glm::abs(w), margin)) || glm::any(glm::greaterThan(margin, glm::dvec3(steep)));
            const bool near_it = glm::all(glm::greaterThan(w, -margin));
            Sample& sample = out.samples[static_cast<std::size_t>(y) * out.width + x];
            const double key = depth > 0 ? render::near_plane / depth : 0;
            if (near_it && (near_edge || std::abs(key - 1) < 0.1)) {
                sample.certain = false;
                continue;
            }
            if (culled || glm::any(glm::lessThan(w, glm::dvec3(0))) || depth < render::near_plane) continue;
            constexpr double close = 0.03;  // of depths, where surfaces cut each other
            if (std::abs(key - sample.depth) < close * key) sample.certain = false;
            if (key <= sample.depth) continue;
            sample.depth = key;
            sample.color = (w.x * v[0].light[is_behind] + w.y * v[1].light[is_behind] + w.z * v[2].light[is_behind]) *
                           (w.x * v[0].albedo + w.y * v[1].albedo + w.z * v[2].albedo);
        }
    }
}

Exact exact_picture(const Actor& actor, std::span<const render::Person> people, const render::View& view) {
    Exact out{across * view.width, across * view.height, {}};
    out.samples.resize(static_cast<std::size_t>(out.width) * out.height);
    const model::Mesh& mesh = actor.character.mesh;
    for (const render::Person& person : people) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            ExactVertex v[3];
            for (int k = 0; k < 3; ++k) v[k] = exact_vertex(actor, person, view, mesh.indices[i + k]);
            cast(v, mesh.double_sided(), view, out);
        }
    }
    return out;
}

// Pixels whose samples are all certain.
void expect_exact(const Actor& actor, const std::vector<render::Person>& people, const render::View& view,
                  double least_certain) {
    const Exact exact = exact_picture(actor, people, view);
    const std::vector figures{actor.figure()};
    TrianglePeople drawn(figures, {});
    const tests::MeshPeople whom(people);
    const tests::Layer layer = tests::draw(drawn, view, whom.pointers, tests::backdrop(view.width, view.height));
    int certain = 0, covered = 0;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            double cover = 0, nearest = 0;
            glm::dvec3 color(0);
            bool sure = true;
            for (int i = 0; i < across * across; ++i) {
                const std::size_t at =
                    static_cast<std::size_t>(across * y + i / across) * exact.width + across * x + i % across;
                const Sample& sample = exact.samples[at];
                sure = sure && sample.certain;
                cover += sample.depth > 0 ? 0.25 : 0;
                nearest = std::max(nearest, sample.depth);
                color += 0.25 * glm::min(sample.color, 1.0);
            }
            if (!sure) continue;
            ++certain;
            covered += cover > 0;
            const auto& pixel = layer.rgba[layer.at(x, y)];
            ASSERT_NEAR(pixel[3], 32767 * cover, 1) << x << ", " << y;
            ASSERT_NEAR(layer.depth[layer.at(x, y)], nearest, 0.02 * nearest) << x << ", " << y;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(255 * std::sqrt(pixel[c] / 32767.0), 255 * std::sqrt(color[c]), 3) << x << ", " << y;
        }
    }
    EXPECT_GT(certain, least_certain * view.width * view.height);
    EXPECT_GT(covered, 0);
}

TEST(NativeTriangles, AreWhereRaysMeetThem) {
    for (unsigned seed = 1; seed < 5; ++seed) {
        const Actor actor(make_soup({.triangles = 40, .size = 0.8, .double_sided = seed % 2 == 0, .seed = seed}));
        expect_exact(actor, {person_at({0, 0, -4})}, view_of(150, 120), 0.2);
    }
}

TEST(NativeTriangles, AreWhereRaysMeetThemWhenCutByTheNearPlane) {
    for (unsigned seed = 1; seed < 5; ++seed) {
        const Actor actor(make_soup({.triangles = 30, .size = 2, .double_sided = true, .seed = seed}));
        expect_exact(actor, {person_at({0.1f, 0, -0.2f})}, view_of(60, 50, 1.8), 0.2);
    }
}

TEST(NativeTriangles, AreWhereRaysMeetThemWhenHuge) {
    const Actor actor(make_soup({.triangles = 20, .double_sided = true}));
    expect_exact(actor, {person_at({0, 0, -3000}, 2000)}, view_of(60, 50), 0.4);
    expect_exact(actor, {person_at({0, 0, -1.2f}, 1)}, view_of(400, 100, 0.05), 0.2);
}

TEST(NativeTriangles, HideWhatIsBehindInAnyOrder) {
    const Actor actor(make_soup({.triangles = 40, .double_sided = true}));
    const render::Person front = person_at({0, 0, -4}), back = person_at({0.2f, 0, -9}, 2, 1.0);
    expect_exact(actor, {front, back}, view_of(80, 60), 0.2);
    expect_exact(actor, {back, front}, view_of(80, 60), 0.2);
}

// ---- the same bits ----

// Near and far, small and large, textured and not, cut and whole.
struct Company {
    Actor person{scene::make_person(), {0, 4}};
    Actor soup{make_soup({.triangles = 77, .double_sided = true, .textured = true})};
    std::vector<figures::Figure> figures{person.figure(), soup.figure()};
    render::View view = view_of(301, 203);
    std::unique_ptr<tests::MeshPeople> whom;
    render::native::BackdropPicture behind = tests::backdrop(301, 203, render::near_plane / 9);

    Company() {
        std::mt19937 random(7);
        std::vector<render::Person> people;
        for (int i = 0; i < 60; ++i) {
            const double depth = draw_number(random, 0.2, 12);
            const glm::vec3 at(draw_number(random, -0.5, 0.5) * depth, draw_number(random, -0.5, 0) * depth, -depth);
            people.push_back(
                person_at(at, 1, draw_number(random, 0, 6), static_cast<std::uint32_t>(i), i % 3 == 0 ? 1 : 0));
            if (people.back().character == 1) people.back().pose = 0;
        }
        people.push_back(person_at({0, -1, -0.3f}));
        people.push_back(person_at({0, -1, -800}));
        whom = std::make_unique<tests::MeshPeople>(people);
    }

    tests::Layer draw(const tests::Cut& cut = {}) const {
        TrianglePeople people(figures, {});
        return tests::draw(people, view, whom->pointers, behind, cut);
    }
};

TEST(NativeTriangles, AreTheSameBitsByEveryInstructionSet) {
    const Company company;
    const tests::Layer expected = company.draw();
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        EXPECT_TRUE(company.draw() == expected) << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
}

TEST(NativeTriangles, AreTheSameBitsOnAnyNumberOfThreads) {
    const Company company;
    const tests::Layer expected = company.draw();
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);  // on any machine
    for (const int threads : {2, 3, 8}) EXPECT_TRUE(company.draw({.threads = threads}) == expected) << threads;
}

TEST(NativeTriangles, AreTheSameBitsInAnyTiles) {
    const Company company;
    const tests::Layer expected = company.draw();
    for (const auto& [width, height] : {std::pair{2, 2}, std::pair{6, 50}, std::pair{34, 18}, std::pair{128, 4}})
        EXPECT_TRUE(company.draw({.tile_width = width, .tile_height = height}) == expected) << width << "x" << height;
}

// From the back nobody is hidden by who was drawn before; from the front nearly everybody is, in part or wholly.
TEST(NativeTriangles, AreTheSameBitsFromFrontToBackAndFromBackToFront) {
    const Actor person(scene::make_person(), {0, 4});
    const std::vector figures{person.figure()};
    std::mt19937 random(3);
    std::vector<render::Person> crowd;
    for (int i = 0; i < 250; ++i) {
        const double depth = draw_number(random, 2, 30);
        const glm::vec3 at(draw_number(random, -0.6, 0.6) * depth, draw_number(random, -0.6, 0) * depth, -depth);
        crowd.push_back(person_at(at, 1, draw_number(random, 0, 6), static_cast<std::uint32_t>(i)));
    }
    std::ranges::sort(crowd, {}, [](const render::Person& p) { return -p.instance.position.z; });
    const tests::MeshPeople front_first(crowd);
    std::ranges::reverse(crowd);
    const tests::MeshPeople back_first(crowd);
    const render::View view = view_of(301, 203);
    for (const float depth : {0.0f, render::near_plane / 12}) {
        const render::native::BackdropPicture behind = tests::backdrop(301, 203, depth);
        TrianglePeople people(figures, {});
        const tests::Layer expected = tests::draw(people, view, back_first.pointers, behind);
        EXPECT_TRUE(tests::draw(people, view, front_first.pointers, behind) == expected) << depth;
        EXPECT_TRUE(tests::draw(people, view, front_first.pointers, behind, {.tile_width = 34, .tile_height = 18}) ==
                    expected)
            << depth;
    }
}

TEST(NativeTriangles, StayInTheirBounds) {
    const Company company;
    for (const render::Person* person : company.whom->pointers) {
        TrianglePeople people(company.figures, {});
        const tests::Layer layer = tests::draw(people, company.view, std::span(&person, 1), company.behind);
        const render::native::Rect r = people.bounds(0);
        for (int y = 0; y < layer.height; ++y) {
            for (int x = 0; x < layer.width; ++x) {
                if (layer.rgba[layer.at(x, y)][3] == 0) continue;
                ASSERT_TRUE(x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1) << x << ", " << y;
            }
        }
    }
}

// ---- single properties ----

// Pixels that aren't wholly covered though there are such on all four sides of them. A convex body has none.
int holes(const tests::Layer& layer) {
    const auto is_full = [&](int x, int y) { return layer.rgba[layer.at(x, y)][3] == 32767; };
    const auto any_full = [&](int x, int y, int step_x, int step_y) {
        for (; x >= 0 && y >= 0 && x < layer.width && y < layer.height; x += step_x, y += step_y)
            if (is_full(x, y)) return true;
        return false;
    };
    int count = 0;
    for (int y = 0; y < layer.height; ++y)
        for (int x = 0; x < layer.width; ++x)
            count += !is_full(x, y) && any_full(x, y, 1, 0) && any_full(x, y, -1, 0) && any_full(x, y, 0, 1) &&
                     any_full(x, y, 0, -1);
    return count;
}

// A ball of many thin triangles: convex, so that nothing shows through it.
model::Character make_ball() {
    model::Character ball = make_soup({.triangles = 0});
    ball.name = "ball";
    model::Mesh& mesh = ball.mesh;
    constexpr int around = 40, down = 23;
    for (int j = 0; j <= down; ++j) {
        for (int i = 0; i < around; ++i) {
            const double theta = 3.14159265358979 * j / down, phi = 2 * 3.14159265358979 * i / around;
            const glm::vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            tests::add_vertex(mesh, n, n);
        }
    }
    for (std::uint32_t j = 0; j < down; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t next = (i + 1) % around, a = j * around, b = a + around;
            for (const std::uint32_t v : {a + i, b + i, b + next, a + i, b + next, a + next}) mesh.indices.push_back(v);
        }
    return ball;
}

TEST(NativeTriangles, OfAClosedBodyLeaveNoHoles) {
    const Actor ball(make_ball());
    const std::vector figures{ball.figure()};
    TrianglePeople people(figures, {});
    for (int i = 0; i < 60; ++i) {
        const double distance = 1.3 + 0.1 * i * i;
        const tests::MeshPeople whom({person_at({0.01f * static_cast<float>(i), 0, -distance}, 1, 0.1 * i)});
        const tests::Layer layer =
            tests::draw(people, view_of(200, 200, 1.7), whom.pointers, tests::backdrop(200, 200));
        EXPECT_EQ(holes(layer), 0) << distance;
    }
}

TEST(NativeTriangles, OfABodyAroundTheCameraFillThePicture) {
    model::Character inside_out = make_ball();
    for (std::size_t i = 0; i < inside_out.mesh.indices.size(); i += 3)
        std::swap(inside_out.mesh.indices[i], inside_out.mesh.indices[i + 1]);
    const Actor ball(std::move(inside_out));
    const std::vector figures{ball.figure()};
    TrianglePeople people(figures, {});
    for (const double fov : {0.02, 1.0, 2.96}) {
        const tests::MeshPeople whom({person_at({0.3f, 0.2f, 0.1f}, 4)});
        const tests::Layer layer = tests::draw(people, view_of(150, 90, fov), whom.pointers, tests::backdrop(150, 90));
        for (const auto& pixel : layer.rgba) ASSERT_EQ(pixel[3], 32767) << fov;
    }
}

TEST(NativeTriangles, AreHiddenByTheBackdrop) {
    const Actor ball(make_ball());
    const std::vector figures{ball.figure()};
    TrianglePeople people(figures, {});
    const tests::MeshPeople whom({person_at({0, 0, -5})});
    const render::View view = view_of(64, 64);
    // Its near half is before the wall.
    const tests::Layer half = tests::draw(people, view, whom.pointers, tests::backdrop(64, 64, 0.1f / 4.5f));
    const tests::Layer whole = tests::draw(people, view, whom.pointers, tests::backdrop(64, 64));
    const tests::Layer none = tests::draw(people, view, whom.pointers, tests::backdrop(64, 64, 0.1f / 3.9f));
    const auto covered = [](const tests::Layer& layer) {
        return std::ranges::count_if(layer.rgba, [](const auto& pixel) { return pixel[3] > 0; });
    };
    EXPECT_LT(covered(half), covered(whole));
    EXPECT_GT(covered(half), 0);
    EXPECT_EQ(covered(none), 0);
    EXPECT_EQ(half.rgba[half.at(32, 32)], whole.rgba[whole.at(32, 32)]);
}

TEST(NativeTriangles, OfWhoeverIsNowhereAreNotDrawn) {
    const Company company;
    const tests::Layer expected = company.draw();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    std::vector<render::Person> people = company.whom->people;
    for (const float odd : {nan, inf, -inf, 1e38f, -1e38f}) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 at(0, 0, -5);
            at[axis] = odd;
            people.push_back(person_at(at));
        }
        people.push_back(person_at({0, 0, -5}, odd));
    }
    people.push_back(person_at({0, 0, -5}, 0));
    people.push_back(person_at({0, 0, 50}));
    const tests::MeshPeople whom(people);
    TrianglePeople drawn(company.figures, {});
    EXPECT_TRUE(tests::draw(drawn, company.view, whom.pointers, company.behind) == expected);
}

TEST(NativeTriangles, FitPicturesOfAnySize) {
    const Company company;
    TrianglePeople people(company.figures, {});
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{1, 500}, std::pair{333, 1}, std::pair{8192, 40}}) {
        for (const double fov : {0.0175, 0.9, 2.967}) {
            const tests::Layer layer = tests::draw(people, view_of(width, height, fov), company.whom->pointers,
                                                   tests::backdrop(width, height));
            EXPECT_EQ(layer.rgba.size(), static_cast<std::size_t>(width) * height);
        }
    }
}

// More than fit what is kept between prepare() and draw().
TEST(NativeTriangles, OfManyPeopleAreLikeThoseOfFew) {
    const Actor person(scene::make_person());
    const std::vector figures{person.figure()};
    const render::View view = view_of(64, 64);
    std::vector<render::Person> people(6000, person_at({0, 0, -900}));
    people.push_back(person_at({0, -1, -4}));
    const tests::MeshPeople many(people), few({people.back()});
    TrianglePeople drawn(figures, {});
    const tests::Layer among_many = tests::draw(drawn, view, many.pointers, tests::backdrop(64, 64));
    const tests::Layer alone = tests::draw(drawn, view, few.pointers, tests::backdrop(64, 64));
    for (std::size_t i = 0; i < alone.rgba.size(); ++i) {
        if (alone.rgba[i][3] == 32767) {
            EXPECT_EQ(among_many.rgba[i], alone.rgba[i]);
        }
    }
}

}  // namespace
