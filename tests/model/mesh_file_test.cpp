// Meshes of any format: the same surface comes out of each, and every refusal is one line.
#include "model/io/mesh_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/model/gltf_builder.h"
#include "tests/model/mesh_text.h"

namespace {

using model::load_mesh;
using model::Mesh;

void expect_whole(const Mesh& mesh) {
    const std::size_t count = mesh.vertex_count();
    EXPECT_EQ(mesh.normals.size(), count);
    EXPECT_EQ(mesh.uvs.size(), count);
    EXPECT_EQ(mesh.colors.size(), count);
    EXPECT_EQ(mesh.slots.size(), count);
    EXPECT_EQ(mesh.material_ids.size(), count);
    EXPECT_EQ(mesh.joints.size(), count);
    EXPECT_EQ(mesh.weights.size(), count);
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, count);
    for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1.0f, 1e-5f);
}

class MeshFile : public testing::Test {
protected:
    tests::TemporaryFolder folder_;
};

TEST_F(MeshFile, ACubeIsTheSameInEveryFormat) {
    tests::PlainMesh cube = tests::make_cube();
    std::vector<std::filesystem::path> files{folder_.write("cube.obj", tests::obj_of(cube))};
    for (const char* format : tests::ply_formats)
        files.push_back(folder_.write(std::string(format) + ".PLY", tests::ply_of(cube, format)));
    for (const std::filesystem::path& file : files) {
        SCOPED_TRACE(file);
        const model::Character character = load_mesh(file);
        const Mesh& mesh = character.mesh;
        expect_whole(mesh);
        EXPECT_EQ(character.name, file.stem());
        EXPECT_EQ(character.skeleton.nodes.size(), 1u);
        EXPECT_EQ(character.skeleton.palette.size(), 1u);
        EXPECT_TRUE(character.clips.empty());
        EXPECT_TRUE(mesh.double_sided());  // neither format says
        EXPECT_EQ(mesh.weights[0], glm::vec4(1, 0, 0, 0));
        motion::Pose pose;
        motion::evaluate_rest(character, pose);
        EXPECT_EQ(pose.palette[mesh.joints[0].x], glm::mat4(1.0f));
        EXPECT_EQ(mesh.triangle_count(), 12u);
        EXPECT_DOUBLE_EQ(tests::area_of(mesh), 24.0);
        const motion::Bounds bounds = motion::bounds_of(mesh.positions);
        EXPECT_EQ(bounds.min, glm::vec3(-1));
        EXPECT_EQ(bounds.max, glm::vec3(1));
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            // Every corner's computed normal points outwards: by area, two triangles of one face may count twice.
            EXPECT_GT(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i])), 0.9f);
            const auto at = std::find(cube.positions.begin(), cube.positions.end(), mesh.positions[i]);
            ASSERT_NE(at, cube.positions.end());
            const glm::u8vec3 color = cube.colors[static_cast<std::size_t>(at - cube.positions.begin())];
            EXPECT_EQ(mesh.colors[i], glm::u8vec4(color, 255));
        }
    }
}

TEST_F(MeshFile, ACharacterIsTheSameInEveryFormat) {
    const std::filesystem::path asset = std::filesystem::path(GRANDSTAND_SHARED) / "assets/Fox/Fox.glb";
    if (!std::filesystem::exists(asset)) GTEST_SKIP() << "no " << asset;
    const tests::PlainMesh fox = tests::plain_of(load_mesh(asset));
    std::vector<std::filesystem::path> files{folder_.write("fox.obj", tests::obj_of(fox))};
    for (const char* format : tests::ply_formats)
        files.push_back(folder_.write(std::string(format) + ".ply", tests::ply_of(fox, format)));
    const Mesh first = load_mesh(files.front()).mesh;
    EXPECT_EQ(first.triangle_count(), fox.faces.size());
    EXPECT_EQ(motion::bounds_of(first.positions).min, motion::bounds_of(fox.positions).min);
    EXPECT_EQ(motion::bounds_of(first.positions).max, motion::bounds_of(fox.positions).max);
    for (const std::filesystem::path& file : files) {
        SCOPED_TRACE(file);
        const Mesh mesh = load_mesh(file).mesh;
        expect_whole(mesh);
        EXPECT_EQ(tests::area_of(mesh), tests::area_of(first));
        ASSERT_EQ(mesh.indices.size(), 3 * fox.faces.size());
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::uint32_t vertex = mesh.indices[i], wanted = fox.faces[i / 3][i % 3];
            ASSERT_EQ(mesh.positions[vertex], fox.positions[wanted]);
            ASSERT_EQ(glm::u8vec3(mesh.colors[vertex]), fox.colors[wanted]);
            ASSERT_LT(glm::distance(mesh.normals[vertex], fox.normals[wanted]), 1e-6f);
        }
    }
}

TEST_F(MeshFile, GltfLoadsByEitherName) {
    EXPECT_EQ(load_mesh(folder_.write("square.GLB", tests::make_square().glb())).mesh.triangle_count(), 2u);
    EXPECT_EQ(load_mesh(folder_.write("square.gltf", tests::make_square().glb())).mesh.triangle_count(), 2u);
}

TEST_F(MeshFile, OthersAreRefusedByName) {
    std::ofstream(folder_ / "model.fbx") << "solid";
    std::ofstream(folder_ / "model.glb.gz") << "solid";
    std::ofstream(folder_ / "model") << "solid";
    for (const auto& [name, found] :
         std::vector<std::pair<std::string, std::string>>{{"model.fbx", "a name that ends in '.fbx'"},
                                                          {"model.glb.gz", "a name that ends in '.glb'"},
                                                          {"model", "a name without extension"},
                                                          {"none", "no such file"},
                                                          {"none.obj", "no such file"},
                                                          {"none.ply", "no such file"},
                                                          {"none.glb", "no such file"}}) {
        try {
            load_mesh(folder_ / name);
            ADD_FAILURE() << name;
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(std::string(error.what()).find((folder_ / name).string() + ": found " + found), 0u)
                << error.what();
        }
    }
    std::filesystem::create_directory(folder_ / "folder.ply");
    EXPECT_THROW(load_mesh(folder_ / "folder.ply"), std::runtime_error);
    std::filesystem::create_symlink("/dev/zero", folder_ / "zero.obj");
    EXPECT_THROW(load_mesh(folder_ / "zero.obj"), std::runtime_error);
}

}  // namespace
