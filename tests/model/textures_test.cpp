// Textures that meshes name: found wherever they are, read or said to be lost, and scaled down where they are too
// large.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "model/io/file_finder.h"
#include "model/io/image.h"
#include "model/io/mesh_textures.h"
#include "model/srgb.h"
#include "tests/model/gltf_builder.h"
#include "tests/model/mesh_text.h"
#include "tests/model/webp.h"

namespace {

namespace fs = std::filesystem;

std::span<const unsigned char> bytes_of(const std::string& text) {
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

// The size of a picture is all that its first bytes say.
std::string make_pgm(int width, int height) {
    const std::string header = "P5 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
    return header + std::string(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\x80');
}

class Textures : public testing::Test {
protected:
    tests::TemporaryFolder folder_;
    model::Warnings warnings_;
    model::MeshTextures textures_{folder_ / "", warnings_};
};

TEST(FileFinder, FindsWhatIsMeantWhateverTheWriterCalledIt) {
    const tests::TemporaryFolder folder;
    fs::create_directories(folder / "models/Maps");
    const auto file = [&](const std::string& name) { return folder.write(name, "x"); };
    const fs::path skin = file("models/Skin one.PNG"), map = file("models/Maps/wood.jpg"), out = file("out.png"),
                   literal = file("models/odd\\name.png"), small = file("models/twice.png"),
                   large = file("models/TWICE.png");
    const std::pair<const char*, fs::path> cases[] = {{"Skin one.PNG", skin},
                                                      {"skin ONE.png", skin},
                                                      {"C:\\work\\maps\\Skin one.PNG", skin},
                                                      {"C:/work/maps/skin one.png", skin},
                                                      {"\\\\server\\share\\skin one.png", skin},
                                                      {"/home/someone/skin one.png", skin},
                                                      {"\"Skin one.PNG\"", skin},
                                                      {" 'skin one.png'\r", skin},
                                                      {"../gone/skin one.png", skin},
                                                      {"Maps\\wood.jpg", map},
                                                      {"maps/WOOD.jpg", map},
                                                      {".\\maps\\Wood.jpg", map},
                                                      {"D:\\a\\b\\maps\\wood.jpg", map},
                                                      {"..\\out.png", out},
                                                      {"odd\\name.png", literal},
                                                      {"twice.png", small},
                                                      {"TWICE.png", large},
                                                      {"Twice.png", large},
                                                      {"", {}},
                                                      {"\"\"", {}},
                                                      {".", {}},
                                                      {"..", {}},
                                                      {"Maps", {}},
                                                      {"/dev/zero", {}},
                                                      {"skin two.png", {}},
                                                      {"gone/", {}}};
    model::FileFinder finder(folder / "models");
    for (const auto& [name, expected] : cases) {
        const fs::path found = finder.find(name);
        ASSERT_EQ(found.empty(), expected.empty()) << name << " " << found;
        if (!expected.empty()) {
            EXPECT_TRUE(fs::equivalent(found, expected)) << name << " " << found;
        }
    }
    EXPECT_TRUE(finder.find(std::string("a\0b", 3)).empty());
    EXPECT_TRUE(finder.find(std::string(100'000, '/')).empty());
}

TEST_F(Textures, AreReadOnceAFile) {
    folder_.write("a.png", tests::make_png(1, 1, "abc"));
    folder_.write("b.png", tests::make_png(1, 1, "xyz"));
    const auto a = textures_.of_file("a.png");
    EXPECT_NE(textures_.of_file("b.png"), a);
    EXPECT_EQ(textures_.of_file("a.png"), a);
    EXPECT_EQ(textures_.of_file("C:\\A.PNG"), a);
    const auto all = textures_.take();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[a].texels[0], glm::u8vec4('a', 'b', 'c', 255));
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(Textures, AreReadAsWebp) {
    const std::vector<std::uint8_t> rgba{10, 200, 30, 255, 1, 2, 3, 128};
    const model::Texture texture = model::decode_image(bytes_of(tests::make_webp(2, 1, rgba)));
    ASSERT_EQ(texture.width, 2);
    ASSERT_EQ(texture.height, 1);
    EXPECT_EQ(texture.texels[0], glm::u8vec4(10, 200, 30, 255));
    EXPECT_EQ(texture.texels[1], glm::u8vec4(1, 2, 3, 128));
}

TEST_F(Textures, ThatCantBeHadAreSaid) {
    const std::string webp = tests::make_webp(2, 1, {1, 2, 3, 4, 5, 6, 7, 8});
    folder_.write("cut.png", tests::make_png(9, 9, std::string(243, 'x')).substr(0, 90));
    folder_.write("cut.webp", webp.substr(0, webp.size() - 6));
    folder_.write("a.tif", std::string("II*\0\x08\0\0\0", 8));
    folder_.write("a.ktx2", "\xabKTX 20\xbb\r\n\x1a\n");
    folder_.write("a.dds", "DDS |");
    folder_.write("text.png", "<html>no image</html>");
    folder_.write("empty.png", "");
    folder_.write("huge.png", tests::make_png(17000, 17000, ""));
    folder_.write("bomb.png", tests::make_png(16000, 16000, ""));
    const std::pair<const char*, const char*> cases[] = {
        {"cut.png", "texture is damaged, left out"},
        {"cut.webp", "texture is damaged, left out"},
        {"a.tif", "texture is a TIFF, left out"},
        {"a.ktx2", "texture is a KTX2, left out"},
        {"a.dds", "texture is a DDS, left out"},
        {"text.png", "texture is in an unknown format, left out"},
        {"empty.png", "texture is in an unknown format, left out"},
        {"huge.png", "texture has over 2^28 texels, left out"},
        {"bomb.png", "texture claims more texels than its bytes hold, left out"},
        {"gone.png", "texture not found, left out"}};
    for (const auto& [name, said] : cases) {
        model::Warnings warnings;
        model::MeshTextures textures(folder_ / "", warnings);
        EXPECT_EQ(textures.of_file(name), model::no_texture) << name;
        EXPECT_EQ(textures.of_file(name), model::no_texture) << name;
        EXPECT_EQ(tests::texts(warnings), std::vector<std::string>{std::string(said) + ": '" + name + "'"});
    }
}

std::size_t most_addresses() {  // [KiB] so far
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == "VmPeak:" && status >> word) return std::stoul(word);
    return 0;
}

// What isn't touched counts too: where memory is limited it is refused.
TEST_F(Textures, WhoseChunksAreCutAskForNoMemory) {
    std::string png = tests::make_png(2, 1, "abcxyz");
    png.replace(png.find("IDAT") - 4, 4, std::string("\x3f\0\0\0", 4));
    const std::size_t before = most_addresses();
    EXPECT_THROW(model::decode_image(bytes_of(png)), model::ImageError);
    EXPECT_LT(most_addresses() - before, 64u << 10);
}

TEST_F(Textures, BeyondThe255thAreLeftOut) {
    const std::string png = tests::make_png(1, 1, "abc");
    for (int i = 0; i < 255; ++i) EXPECT_EQ(textures_.of_bytes(bytes_of(png), "early"), i);
    EXPECT_TRUE(warnings_.empty());
    EXPECT_EQ(textures_.of_bytes(bytes_of(png), "late"), model::no_texture);
    EXPECT_EQ(tests::texts(warnings_), std::vector<std::string>{"texture beyond the 255th, left out: 'late'"});
}

// Of 2^26 texels in all: the largest are halved until the rest fits, each said once.
TEST_F(Textures, TooManyTexelsAreScaledDown) {
    const std::string large = make_pgm(8192, 8192), small = make_pgm(16, 16), strip = make_pgm(40000, 3);
    textures_.of_bytes(bytes_of(small), "small");
    textures_.of_bytes(bytes_of(large), "large");
    textures_.of_bytes(bytes_of(strip), "strip");
    const auto all = textures_.take();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(std::pair(all[0].width, all[0].height), std::pair(16, 16));
    EXPECT_EQ(std::pair(all[1].width, all[1].height), std::pair(4096, 4096));
    EXPECT_EQ(std::pair(all[2].width, all[2].height), std::pair(10000, 1));
    for (const model::Texture& texture : all) {
        ASSERT_EQ(texture.texels.size(), static_cast<std::size_t>(texture.width) * texture.height);
        EXPECT_EQ(texture.texels.back(), glm::u8vec4(128, 128, 128, 255));
    }
    EXPECT_EQ(tests::texts(warnings_), std::vector<std::string>{"texture too large, scaled down: 'large', and 1 more"});
}

TEST(Halved, KeepsTheLight) {
    const glm::u8vec4 white(255), black(0, 0, 0, 255), clear(255, 255, 255, 1);
    const model::Texture half = model::halved({4, 2, {white, black, clear, white, black, white, white, clear}});
    ASSERT_EQ(half.width, 2);
    ASSERT_EQ(half.height, 1);
    EXPECT_EQ(half.texels[0], glm::u8vec4(188, 188, 188, 255));  // half the light
    EXPECT_EQ(half.texels[1], glm::u8vec4(255, 255, 255, 128));
    EXPECT_EQ(model::halved({1, 1, {black}}).texels, std::vector<glm::u8vec4>{black});
}

}  // namespace
