// Who darkens what they stand on, how far and how much.
#include <gtest/gtest.h>

#include <cmath>

#include "render/contact_shade.h"

namespace {

// People with these radii [m], all at one place before a camera that sees a metre there as so many pixels.
std::vector<render::ContactShade> shades(double pixels_a_metre, std::initializer_list<float> radii) {
    constexpr int side = 400;  // [px]
    const double distance = 10, fov = 2 * std::atan(0.5 * side / pixels_a_metre / distance);
    render::Frame frame;
    frame.view = render::make_view({{0, 0, distance}, {0, 0, 0}, fov}, side, side);
    for (const float radius : radii) {
        render::Person person{};
        person.instance.position = frame.view.relative(glm::vec3(0));
        person.shade_radius = radius;
        frame.people.push_back(person);
    }
    std::vector<render::ContactShade> out(3);  // what was there is gone
    render::find_contact_shades(frame, figures::by_opengl(), out);
    return out;
}

TEST(ContactShade, IsOfThoseWhoHaveARadius) {
    const auto found = shades(100, {0.0f, 0.5f, 0.0f, 0.4f});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].radius, 0.5f);
    EXPECT_EQ(found[1].radius, 0.4f);
    for (const render::ContactShade& shade : found) {
        EXPECT_NEAR(shade.peak * shade.peak, render::contact_strength, 1e-6);
        EXPECT_NEAR(shade.fall * shade.radius * shade.radius, shade.peak, 1e-6) << "it ends at the radius";
        EXPECT_NEAR(shade.feet.z, -10, 1e-5);
    }
}

TEST(ContactShade, FadesSteadilyBeforeItIsTooSmall) {
    EXPECT_TRUE(shades(render::contact_least_px - 0.01, {1.0f}).empty());
    float last = 0;
    for (double pixels = render::contact_least_px + 0.05; pixels < 6; pixels += 0.05) {
        const auto found = shades(pixels, {1.0f});
        ASSERT_EQ(found.size(), 1u) << pixels;
        const float strength = found[0].peak * found[0].peak;
        EXPECT_GE(strength, last - 1e-5f) << pixels;
        EXPECT_LT(strength, last + 0.02f) << pixels << ": it leaps";
        last = strength;
    }
    EXPECT_NEAR(last, render::contact_strength, 1e-5);
}

}  // namespace
