#include "render/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

// Uniform in [low, high); std's distributions differ between platforms.
double uniform(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

glm::vec3 uniform_point(std::mt19937_64& random, double reach) {
    return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

render::View any_view(std::mt19937_64& random) {
    scene::CameraPose pose;
    pose.position = uniform_point(random, 100);
    pose.target = pose.position + glm::dvec3(uniform_point(random, 10)) + glm::dvec3(0.01);
    pose.fov_y = uniform(random, 0.1, 2.5);
    return render::make_view(pose, 1280, 720);
}

// Clip space as OpenGL has it with reversed depth: visible where |x|, |y| <= w and 0 <= z <= w.
bool in_clip_volume(const render::View& view, glm::vec3 relative) {
    const glm::vec4 clip = view.clip_from_camera_relative * glm::vec4(relative, 1.0f);
    return std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z <= clip.w && clip.z >= 0;
}

TEST(View, PlanesBoundTheClipVolume) {
    std::mt19937_64 random(1);
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
        const render::View view = any_view(random);
        const glm::vec3 point = uniform_point(random, 50);
        bool within_planes = true;
        float closest = 1e9f;
        for (const glm::vec4& plane : view.planes) {
            const float distance = glm::dot(glm::vec3(plane), point) + plane.w;
            within_planes = within_planes && distance >= 0;
            closest = std::min(closest, std::abs(distance));
        }
        constexpr float rounding = 1e-3f;  // [m] on a plane either answer is right
        if (closest < rounding) continue;
        EXPECT_EQ(within_planes, in_clip_volume(view, point));
        inside += within_planes;
    }
    EXPECT_GT(inside, 500);
}

TEST(View, BoxWithAVisiblePointIsNeverOutside) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 20000; ++i) {
        const render::View view = any_view(random);
        const glm::vec3 corner = uniform_point(random, 150);
        const motion::Bounds box{corner, corner + glm::abs(uniform_point(random, 20))};
        const glm::vec3 inside =
            glm::mix(box.min, box.max, glm::vec3(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)));
        const render::Overlap found = render::overlap(view, box);
        const bool shows = in_clip_volume(view, view.relative(inside));
        EXPECT_FALSE(shows && found == render::Overlap::outside);
        EXPECT_FALSE(!shows && found == render::Overlap::inside);
    }
}

// A point just inside each face of the visible volume, and just outside of that face alone.
TEST(View, BallsAreSeenUntilTheyAreBeyondAPlane) {
    std::mt19937_64 random(4);
    for (int i = 0; i < 300; ++i) {
        const render::View view = any_view(random);
        const glm::vec3 f = view.forward, r = view.right * view.tan_half_x, u = view.up * view.tan_half_y;
        const auto depth = static_cast<float>(uniform(random, 1, 60));
        const glm::vec3 on_faces[] = {depth * (f - r), depth * (f + r), depth * (f - u), depth * (f + u),
                                      render::near_plane * f};
        const glm::vec3 outward[] = {-glm::normalize(glm::cross(f - r, u)), glm::normalize(glm::cross(f + r, u)),
                                     glm::normalize(glm::cross(f - u, r)), -glm::normalize(glm::cross(f + u, r)), -f};
        for (int face = 0; face < 5; ++face) {
            const auto radius = static_cast<float>(uniform(random, 0.02, 3));
            const float sign = glm::dot(outward[face], depth * f - on_faces[face]) > 0 ? -1.0f : 1.0f;
            const auto ball_at = [&](float distance) { return on_faces[face] + sign * distance * outward[face]; };
            EXPECT_TRUE(render::sphere_visible(view, ball_at(0.98f * radius), radius)) << "face " << face;
            EXPECT_FALSE(render::sphere_visible(view, ball_at(1.02f * radius), radius)) << "face " << face;
            // A cube is touched later, when it lies in the plane's way with a corner.
            const glm::vec3 center = glm::vec3(view.position) + ball_at(1.75f * radius);
            const motion::Bounds cube{center - radius, center + radius};
            EXPECT_EQ(render::overlap(view, cube), render::Overlap::outside) << "face " << face;
        }
    }
}

TEST(View, BoxWellInViewNeedsNoTestOfWhatIsInIt) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 300; ++i) {
        const render::View view = any_view(random);
        const glm::vec3 center = glm::vec3(view.position) + 20.0f * view.forward;
        const float reach = 20 * std::min({view.tan_half_x, view.tan_half_y, 0.9f}) / 4;
        EXPECT_EQ(render::overlap(view, {center - reach / 2, center + reach / 2}), render::Overlap::inside);
        EXPECT_EQ(render::overlap(view, {center - 100.0f, center + 100.0f}), render::Overlap::partly);
    }
}

TEST(View, PixelsPerMetreIsWhatProjectionDoes) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 1000; ++i) {
        const render::View view = any_view(random);
        const auto depth = static_cast<float>(uniform(random, 1, 300));
        const auto pixel_y = [&](glm::vec3 relative) {
            const glm::vec4 clip = view.clip_from_camera_relative * glm::vec4(relative, 1.0f);
            return 0.5f * static_cast<float>(view.height) * clip.y / clip.w;
        };
        const float metre = pixel_y(depth * view.forward + view.up) - pixel_y(depth * view.forward);
        EXPECT_NEAR(metre, view.pixels_per_metre(depth), 1e-3f * metre);
    }
}

TEST(View, KeepsCentimetresTwoKilometresOut) {
    scene::CameraPose pose;
    pose.position = {2000.004, 1.5, -2000.004};
    const render::View view = render::make_view(pose, 100, 100);
    EXPECT_NEAR(view.relative({2000.0f, 1.5f, -2000.0f}).x, -0.004f, 1e-4f);
}

// Steep as it may look, until a degree from the vertical the picture's vertical is the world's.
TEST(View, KeepsTheHorizonLevel) {
    for (double elevation = -89; elevation <= 89; elevation += 0.5) {
        for (double azimuth = 0; azimuth < 360; azimuth += 29) {
            const double e = glm::radians(elevation), a = glm::radians(azimuth);
            const glm::dvec3 along(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
            const render::View view = render::make_view({{3, 5, 7}, glm::dvec3(3, 5, 7) + along, 0.8}, 64, 36);
            EXPECT_NEAR(view.right.y, 0, 1e-5) << elevation << " degrees up, " << azimuth << " around";
            EXPECT_GT(view.up.y, 0) << elevation << " degrees up, " << azimuth << " around";
            EXPECT_LT(glm::dot(view.right, glm::vec3(std::cos(a), 0, -std::sin(a))), -0.999);
        }
    }
}

TEST(View, LooksStraightDownWithoutLosingItsAxes) {
    scene::CameraPose pose;
    pose.position = {0, 50, 0};
    pose.target = {0, 0, 0};
    const render::View view = render::make_view(pose, 100, 100);
    EXPECT_NEAR(glm::length(view.right), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(view.right, view.forward), 0.0f, 1e-5f);
}

}  // namespace
