// Colours of texels that masks cut away.
#include "model/io/cutouts.h"

#include <gtest/gtest.h>

namespace model {
namespace {

constexpr glm::u8vec4 green(20, 160, 20, 255), blue(0, 0, 200, 255), clear(0, 0, 0, 0);

// A row of texels on a material that cuts at one half.
Mesh leaf(std::vector<glm::u8vec4> texels) {
    Mesh mesh;
    mesh.textures = {{static_cast<int>(texels.size()), 1, std::move(texels)}};
    mesh.materials.push_back({.texture = 0, .alpha_cutoff = 0.5f});
    return mesh;
}

glm::u8vec3 color_at(const Mesh& mesh, std::size_t texel) {
    return mesh.textures[0].texels[texel];
}

TEST(Cutouts, TakeTheColoursBesideThemAndStayClear) {
    std::vector<glm::u8vec4> texels(9, clear);
    texels[2] = green;
    Mesh mesh = leaf(texels);
    fill_cutouts(mesh);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        EXPECT_EQ(color_at(mesh, i), glm::u8vec3(green)) << i;
        EXPECT_EQ(mesh.textures[0].texels[i].a, i == 2 ? 255 : 0) << i;
    }
}

TEST(Cutouts, AreMixedWhereTwoColoursMeet) {
    Mesh mesh = leaf({green, clear, blue});
    fill_cutouts(mesh);
    EXPECT_EQ(color_at(mesh, 1), glm::u8vec3(10, 80, 110));
    EXPECT_EQ(color_at(mesh, 0), glm::u8vec3(green));
    EXPECT_EQ(color_at(mesh, 2), glm::u8vec3(blue));
}

TEST(Cutouts, AreFilledSomeTexelsDeepOnly) {
    std::vector<glm::u8vec4> texels(100, clear);
    texels[0] = green;
    Mesh mesh = leaf(texels);
    fill_cutouts(mesh);
    EXPECT_EQ(color_at(mesh, 10), glm::u8vec3(green));
    EXPECT_EQ(color_at(mesh, 90), glm::u8vec3(green)) << "around the edge: textures repeat";
    EXPECT_EQ(color_at(mesh, 50), glm::u8vec3(clear));
}

TEST(Cutouts, OfTexturesThatAreWornWholeTooAreLeft) {
    Mesh mesh = leaf({green, clear});
    mesh.materials.push_back({.texture = 0});
    fill_cutouts(mesh);
    EXPECT_EQ(color_at(mesh, 1), glm::u8vec3(clear));
    Mesh all_clear = leaf({clear, clear});
    fill_cutouts(all_clear);
    EXPECT_EQ(color_at(all_clear, 1), glm::u8vec3(clear));
}

}  // namespace
}  // namespace model
