// Real characters, against an independent reference. They lie outside the repository: without them these tests skip.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/io/gltf.h"
#include "motion/pose.h"
#include "pointsample/point_model.h"
#include "pointsample/sample.h"

namespace {

namespace fs = std::filesystem;

const fs::path assets = fs::path(GRANDSTAND_SHARED) / "assets";

#define SKIP_WITHOUT_ASSETS() \
    if (!fs::exists(assets)) GTEST_SKIP() << "no characters at " << assets << ": nothing was checked"

std::vector<fs::path> character_files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(assets))
        if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

using pointsample::PosedMesh;

PosedMesh skinned(const model::Character& character, const motion::Pose& pose) {
    PosedMesh surface;
    motion::skin(character.mesh, pose, surface.positions, surface.normals);
    return surface;
}

motion::Bounds rest_bounds(const model::Character& character) {
    motion::Pose pose;
    motion::evaluate_rest(character, pose);
    return motion::bounds_of(skinned(character, pose).positions);
}

motion::Bounds clip_bounds(const model::Character& character, std::size_t clip, double time) {
    motion::Pose pose;
    motion::evaluate(character, character.clips.at(clip), time, pose);
    return motion::bounds_of(skinned(character, pose).positions);
}

// Within a thousandth of the reference's size, on every side.
void expect_bounds(const motion::Bounds& got, const nlohmann::json& expected, const std::string& what) {
    const auto vec = [&](const char* name) {
        return glm::vec3(expected[name][0].get<float>(), expected[name][1].get<float>(),
                         expected[name][2].get<float>());
    };
    const glm::vec3 size = vec("size");
    const float tolerance = 1e-3f * std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(got.min[axis], vec("min")[axis], tolerance) << what << " min " << axis;
        EXPECT_NEAR(got.max[axis], vec("max")[axis], tolerance) << what << " max " << axis;
    }
}

TEST(Assets, PosedBoundsMeetTheReference) {
    SKIP_WITHOUT_ASSETS();
    std::ifstream lines(assets / "posed_bounds.jsonl");
    int checked = 0;
    for (std::string line; std::getline(lines, line);) {
        const nlohmann::json expected = nlohmann::json::parse(line);
        const std::string name = expected["file"].get<std::string>().substr(std::string("public/").size());
        if (!fs::exists(assets / name)) continue;  // the reference lists one file more than is kept
        const model::Character character = model::load_gltf(assets / name);
        expect_bounds(rest_bounds(character), expected["rest"], name + " at rest");
        if (expected.contains("clip_mid")) {
            const auto clip = expected["clip"].get<std::size_t>();
            ASSERT_LT(clip, character.clips.size()) << name;
            if (!expected["clip_name"].is_null()) {
                EXPECT_EQ(character.clips[clip].name, expected["clip_name"].get<std::string>());
            }
            expect_bounds(clip_bounds(character, clip, expected["t"].get<double>()), expected["clip_mid"],
                          name + " mid-clip");
        }
        ++checked;
    }
    EXPECT_GE(checked, 20);
}

void expect_sane(const model::Character& character) {
    const model::Mesh& mesh = character.mesh;
    const std::size_t count = mesh.vertex_count();
    ASSERT_GT(mesh.triangle_count(), 0u);
    for (const std::size_t size : {mesh.normals.size(), mesh.uvs.size(), mesh.colors.size(), mesh.slots.size(),
                                   mesh.material_ids.size(), mesh.joints.size(), mesh.weights.size()})
        ASSERT_EQ(size, count);
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, count);
    for (std::size_t i = 0; i < count; ++i) {
        ASSERT_TRUE(std::isfinite(glm::length(mesh.positions[i])));
        ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5f);
        float sum = 0;
        mesh.visit_influences(i, [&](std::uint16_t joint, float weight) {
            sum += weight;
            ASSERT_GE(weight, 0.0f);
            ASSERT_LT(joint, character.skeleton.palette.size());
        });
        ASSERT_NEAR(sum, 1.0f, 1e-5f);
        ASSERT_LT(mesh.material_ids[i], mesh.materials.size());
    }
    for (const model::Material& material : mesh.materials) {
        if (material.texture != model::no_texture) {
            ASSERT_LT(material.texture, mesh.textures.size());
        }
    }
    for (std::size_t i = 0; i < character.skeleton.nodes.size(); ++i)
        ASSERT_LT(character.skeleton.nodes[i].parent, static_cast<std::int32_t>(i));
    for (const model::Clip& clip : character.clips) ASSERT_GE(clip.duration, 0.0);  // a clip may be one pose
}

TEST(Assets, AllLoadWithSaneFigures) {
    SKIP_WITHOUT_ASSETS();
    for (const fs::path& file : character_files()) {
        SCOPED_TRACE(file);
        expect_sane(model::load_gltf(file));
    }
}

TEST(Assets, TexturesAreFoundInsideAndBeside) {
    SKIP_WITHOUT_ASSETS();
    struct Expected {
        const char* file;
        std::size_t textures, clips;
    };
    for (const auto& [file, textures, clips] :
         {Expected{"Fox/Fox.glb", 1, 3}, Expected{"CesiumMan/CesiumMan.glb", 1, 1},
          Expected{"KayKitMage/Mage.glb", 1, 76}, Expected{"KenneyPlatformerCharacter/character.glb", 1, 4},
          Expected{"RaylibRobot/robot.glb", 0, 14}}) {
        const model::Character character = model::load_gltf(assets / file);
        EXPECT_EQ(character.mesh.textures.size(), textures) << file;
        EXPECT_EQ(character.clips.size(), clips) << file;
    }
}

TEST(Assets, ARedFoxIsRed) {
    SKIP_WITHOUT_ASSETS();
    const model::Character fox = model::load_gltf(assets / "Fox/Fox.glb");
    motion::Pose pose;
    motion::evaluate_rest(fox, pose);
    const PosedMesh surface = skinned(fox, pose);
    const auto model = pointsample::sample(fox.mesh, {&surface, 1}, {5000, 1, pointsample::Order::progressive, true});
    glm::dvec3 mean(0);
    for (const glm::u8vec4& color : model.colors) mean += glm::dvec3(color) / 5000.0;
    EXPECT_GT(mean.r, 1.4 * mean.b);
    EXPECT_GT(mean.r, mean.g);
}

// Triangles wind counter-clockwise seen from outside, also under mirrored nodes: the signed volume of a mostly closed
// character is positive.
TEST(Assets, TrianglesFaceOutward) {
    SKIP_WITHOUT_ASSETS();
    for (const fs::path& file : character_files()) {
        const model::Character character = model::load_gltf(file);
        motion::Pose pose;
        motion::evaluate_rest(character, pose);
        const PosedMesh surface = skinned(character, pose);
        const glm::vec3 center = motion::bounds_of(surface.positions).center();
        double volume = 0, agreeing = 0, all = 0;
        for (std::size_t i = 0; i < character.mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) {
                return glm::dvec3(surface.positions[character.mesh.indices[i + k]] - center);
            };
            const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
            volume += glm::dot(at(0), normal);
            all += glm::length(normal);
            if (glm::dot(normal, glm::dvec3(surface.normals[character.mesh.indices[i]])) > 0)
                agreeing += glm::length(normal);
        }
        if (motion::bounds_of(surface.positions).size().z > 0) {
            EXPECT_GT(volume, 0) << file;
        }
        EXPECT_GT(agreeing, 0.97 * all) << file;  // by area; hard edges smoothed over differ a little
    }
}

}  // namespace
