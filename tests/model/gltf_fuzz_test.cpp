// Damaged files, from fixed seeds: each loads or is refused with one line. What loads must hold together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "model/io/gltf.h"
#include "motion/pose.h"
#include "pointsample/point_model.h"
#include "pointsample/sample.h"
#include "tests/model/gltf_builder.h"

namespace {

// Uses what was loaded as a program would; the sanitizers watch.
void use(const model::Character& character) {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate_rest(character, pose);
    for (const model::Clip& clip : character.clips) motion::evaluate(character, clip, 0.3 * clip.duration, pose);
    motion::skin(character.mesh, pose, positions, normals);
    for (const std::uint32_t index : character.mesh.indices) ASSERT_LT(index, positions.size());
    try {
        const pointsample::PosedMesh posed{positions, normals};
        ASSERT_EQ(
            pointsample::sample(character.mesh, {&posed, 1}, {20, 1, pointsample::Order::progressive, false}).size(),
            20u);
    } catch (const std::runtime_error&) {
        // no triangle has an area any more
    }
}

struct Outcome {
    int loaded = 0, refused = 0;
};

void attempt(const tests::TemporaryFolder& folder, const std::string& bytes, Outcome& outcome) {
    const auto path = folder.write("damaged.glb", bytes);
    try {
        use(model::load_gltf(path));
        ++outcome.loaded;
    } catch (const std::runtime_error& error) {
        ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        ++outcome.refused;
    }
}

TEST(GltfFuzz, EveryTruncationIsRefused) {
    const tests::TemporaryFolder folder;
    const std::string whole = tests::make_everything().glb();
    Outcome outcome;
    for (std::size_t length = 0; length < whole.size(); ++length) attempt(folder, whole.substr(0, length), outcome);
    EXPECT_EQ(outcome.loaded, 0);
}

TEST(GltfFuzz, FlippedBytesNeverCrash) {
    const tests::TemporaryFolder folder;
    const std::string whole = tests::make_everything().glb();
    std::mt19937_64 random(20260101);
    Outcome outcome;
    for (int run = 0; run < 4000; ++run) {
        std::string damaged = whole;
        for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips)
            damaged[random() % damaged.size()] = static_cast<char>(random());
        attempt(folder, damaged, outcome);
    }
    EXPECT_GT(outcome.loaded, 100);  // else nothing past the first check was ever tried
    EXPECT_GT(outcome.refused, 100);
}

// Replaces every number, string, list and object of the document, one at a time, by every hostile value.
void replace_everywhere(const nlohmann::json& document, const std::vector<nlohmann::json>& hostile,
                        const std::string& binary, const tests::TemporaryFolder& folder, Outcome& outcome) {
    const nlohmann::json flat = document.flatten();
    std::vector<std::string> places;
    for (const auto& [place, value] : flat.items()) {
        for (std::string pointer = place; !pointer.empty(); pointer = pointer.substr(0, pointer.rfind('/')))
            if (places.empty() || std::find(places.begin(), places.end(), pointer) == places.end())
                places.push_back(pointer);
    }
    for (const std::string& place : places) {
        for (const nlohmann::json& value : hostile) {
            nlohmann::json changed = document;
            changed[nlohmann::json::json_pointer(place)] = value;
            attempt(folder, tests::make_glb(changed.dump(), binary), outcome);
        }
    }
}

TEST(GltfFuzz, LyingJsonNeverCrashes) {
    const tests::TemporaryFolder folder;
    tests::GltfBuilder builder = tests::make_everything();
    builder.glb();  // completes the document
    const std::vector<nlohmann::json> hostile{-1,
                                              0,
                                              1,
                                              2,
                                              3,
                                              7,
                                              255,
                                              65535,
                                              65536,
                                              2147483647,
                                              -2147483648LL,
                                              4294967295LL,
                                              4294967296LL,
                                              9223372036854775807LL,
                                              18446744073709551615ULL,
                                              1e308,
                                              -1e308,
                                              0.5,
                                              "",
                                              "VEC4",
                                              "x",
                                              nullptr,
                                              true,
                                              nlohmann::json::array(),
                                              nlohmann::json::object(),
                                              {-1, 99999999},
                                              {{"x", 1}}};
    Outcome outcome;
    replace_everywhere(builder.document, hostile, builder.binary, folder, outcome);
    EXPECT_GT(outcome.loaded, 500);
    EXPECT_GT(outcome.refused, 500);
}

}  // namespace
