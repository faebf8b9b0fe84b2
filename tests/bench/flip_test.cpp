#include "tests/bench/flip.h"

#include <gtest/gtest.h>
#include <stb_image.h>

#include <filesystem>
#include <memory>
#include <string>

namespace {

const std::string folder = GRANDSTAND_SHARED "/flip/";

// Empty if there is no such file.
render::Image load(const std::string& path) {
    render::Image image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> data(
        stbi_load(path.c_str(), &image.width, &image.height, &channels, 3), stbi_image_free);
    if (data) image.pixels.assign(data.get(), data.get() + std::size_t{3} * image.width * image.height);
    return image;
}

TEST(Flip, GivesTheAuthorsMeanOnTheReferencePair) {
    const render::Image reference = load(folder + "tree-ref.png"), test = load(folder + "tree-test.png");
    if (reference.pixels.empty()) GTEST_SKIP() << "no " << folder;
    constexpr double published = 0.133285, tolerance = 1e-4;  // shared/flip/README.md
    EXPECT_NEAR(bench::mean_flip_error(reference, test, 67), published, tolerance);
}

TEST(Flip, IsZeroForTheSamePictureAndOneAtMost) {
    const render::Image green{2, 1, {0, 255, 0, 0, 255, 0}}, blue{2, 1, {0, 0, 255, 0, 0, 255}};
    EXPECT_EQ(bench::mean_flip_error(green, green), 0.0);
    EXPECT_NEAR(bench::mean_flip_error(green, blue), 1.0, 1e-6);
}

}  // namespace
