// The stadium's pictures, to the byte: a change of layout may not change a pixel. What is right is for the reference
// (tests/reference) to say; a change that is meant to show makes pixels.txt anew: GRANDSTAND_PIXELS=FILE pixels_test.
#include <gtest/gtest.h>
#include <stb_image.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/apps/trace_text.h"
#include "tests/command.h"

namespace {

struct Picture {
    std::string name, arguments;
};

void PrintTo(const Picture& picture, std::ostream* out) {
    *out << picture.name;
}

std::vector<Picture> pictures() {
    const std::vector<Picture> ways{{"state-0", "--state 0"},
                                    {"state-1", "--state 1 --motion-distance 20"},
                                    {"S-1", "--state 2 --splat-px 1"},
                                    {"S-4", "--state 2 --splat-px 4 --motion-distance 15"}};
    std::vector<Picture> all;
    for (const std::string camera : {"still", "close", "medium", "remote"})
        for (const Picture& way : ways)
            all.push_back(
                {camera + "/" + way.name, "--people 3000 --frames 3 --camera " + camera + " " + way.arguments});
    all.push_back({"roam/S-2", "--people 600 --frames 600 --camera roam --state 2"});
    const std::filesystem::path assets = std::filesystem::path(GRANDSTAND_SHARED) / "assets";
    for (const std::string file : {"CesiumMan/CesiumMan.glb", "Fox/Fox.glb", "KayKitMage/Mage.glb",
                                   "QuaterniusKnight/KnightCharacter.glb", "RaylibRobot/robot.glb"})
        for (const std::string camera : {"close", "remote"})
            for (const Picture& way : {ways[0], ways[3]})
                all.push_back({file.substr(0, file.find('/')) + "/" + camera + "/" + way.name,
                               "--people 700 --frames 3 --camera " + camera + " " + way.arguments + " --character " +
                                   (assets / file).string()});
    return all;
}

// FNV-1a.
std::string hash(const void* data, std::size_t size) {
    std::uint64_t h = 0xcbf29ce484222325u;
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 0x100000001b3u;
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(h));
    return text;
}

struct Drawn {
    std::string pixels, counts, driver;
};

// What a frame drew and what was forecast of it, as the trace has it, without times.
void read_trace(const std::string& text, Drawn& drawn) {
    const std::vector<std::string> counted{"visible",           "triangles", "points",       "motion_updates",
                                           "motion_distance_m", "range_m",   "motion_steps", "splat_steps"};
    for (const std::string& line : tests::lines_of(text))
        if (line.starts_with("# device=") || line.starts_with("# driver=")) drawn.driver += line.substr(9) + "; ";
    const std::vector<std::vector<std::string>> table = tests::table_of(text);
    std::string kept;
    for (std::size_t row = 1; row < table.size(); ++row)
        for (std::size_t i = 0; i < table[0].size(); ++i)
            if (std::find(counted.begin(), counted.end(), table[0][i]) != counted.end()) kept += table[row].at(i) + ",";
    drawn.counts = hash(kept.data(), kept.size());
}

Drawn draw(const Picture& picture) {
    const tests::Directory directory;
    const std::string png = directory / "picture.png", trace = directory / "trace.csv";
    const tests::Outcome outcome = tests::run(
        "stadium", "--headless --draw gl --size 480x270 " + picture.arguments + " --png " + png + " --trace " + trace);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    Drawn drawn;
    int width = 0, height = 0, channels = 0;
    unsigned char* pixels = stbi_load(png.c_str(), &width, &height, &channels, 3);
    EXPECT_NE(pixels, nullptr);
    if (pixels) drawn.pixels = hash(pixels, std::size_t{3} * width * height);
    stbi_image_free(pixels);
    read_trace(tests::read_file(trace), drawn);
    return drawn;
}

// What is expected: the driver, then a line a picture.
const std::map<std::string, std::string>& expected() {
    static const std::map<std::string, std::string> table = [] {
        std::map<std::string, std::string> read;
        std::ifstream file(GRANDSTAND_PIXELS_FILE);
        std::getline(file, read["driver"]);
        for (std::string name, pixels, counts; file >> name >> pixels >> counts;) read[name] = pixels + " " + counts;
        return read;
    }();
    return table;
}

class Pixels : public testing::TestWithParam<Picture> {};

TEST_P(Pixels, AreWhatTheyWere) {
    if (GetParam().arguments.find("--character") != std::string::npos && !std::filesystem::exists(GRANDSTAND_SHARED))
        GTEST_SKIP() << "NO ../shared, " << GetParam().name << " IS NOT DRAWN";
    const Drawn drawn = draw(GetParam());
    if (const char* made = std::getenv("GRANDSTAND_PIXELS")) {
        const bool is_new = !std::filesystem::exists(made);
        std::ofstream file(made, std::ios::app);
        if (is_new) file << drawn.driver << '\n';
        file << GetParam().name << ' ' << drawn.pixels << ' ' << drawn.counts << '\n';
        return;
    }
    const auto& table = expected();
    ASSERT_TRUE(table.contains(GetParam().name));
    if (table.at("driver") != drawn.driver)
        GTEST_SKIP() << "THE PICTURES ARE KNOWN OF " << table.at("driver") << "NOT OF " << drawn.driver
                     << "THEIR BYTES ARE NOT COMPARED";
    EXPECT_EQ(drawn.pixels + " " + drawn.counts, table.at(GetParam().name));
}

INSTANTIATE_TEST_SUITE_P(Of, Pixels, testing::ValuesIn(pictures()), [](const auto& picture) {
    std::string title;
    for (const char c : picture.param.name) title += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return title;
});

}  // namespace
