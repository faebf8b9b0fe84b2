// What points look like, against plain arithmetic in double.
#include "pointsample/attributes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "tests/motion/tentacle.h"
#include "tests/pointsample/shapes.h"

namespace {

using pointsample::PointModel;
using pointsample::PosedMesh;

// Of an sRGB code in [0, 255], and back (IEC 61966-2-1).
double light_of(double code) {
    const double c = code / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double code_of(double light) {
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

// Triangles with vertices of their own, each in one of two textures or in none; all else differs from corner to corner.
model::Mesh patchwork(std::size_t triangles, std::uint64_t seed) {
    tests::Random random(seed);
    const auto byte = [&] { return static_cast<std::uint8_t>(random(0, 256)); };
    model::Mesh mesh;
    mesh.materials.resize(3);
    mesh.materials[0].texture = 0;
    mesh.materials[1].texture = 1;
    for (std::uint32_t i = 0; i < 3 * triangles; ++i) {
        mesh.indices.push_back(i);
        mesh.positions.push_back(random.vector(-9, 9));
        mesh.normals.push_back(random.rotation() * glm::vec3(0, 0, 1));
        mesh.uvs.emplace_back(random(-2, 3), random(-2, 3));
        mesh.colors.emplace_back(byte(), byte(), byte(), byte());
        mesh.slots.push_back(static_cast<model::Slot>(byte() % (1 + model::slot_count)));
        mesh.material_ids.push_back(static_cast<std::uint16_t>(i / 3 % 3));
        mesh.joints.emplace_back(byte() % 6, byte() % 6, byte() % 6, byte() % 6);
        const glm::vec4 weights(random(0, 1), random(0, 1), random(0, 1), 0.0f);
        mesh.weights.push_back(weights / (weights.x + weights.y + weights.z));
    }
    for (const auto& [width, height] : {std::pair{5, 3}, {2, 7}}) {
        model::Texture texture{width, height, {}};
        for (int i = 0; i < width * height; ++i) texture.texels.emplace_back(byte(), byte(), byte(), byte());
        mesh.textures.push_back(texture);
    }
    std::swap(mesh.indices[1], mesh.indices[2]);  // the indices are no mere count
    return mesh;
}

std::vector<motion::SurfacePoint> points_on(const model::Mesh& mesh, std::size_t each) {
    tests::Random random(99);
    std::vector<motion::SurfacePoint> points;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        points.push_back({t, 0, 0});
        points.push_back({t, 1, 0});
        points.push_back({t, 0, 1});
        for (std::size_t i = 0; i < each; ++i) {
            const float u = random(0, 1);
            points.push_back({t, u, random(0, 1) * (1 - u)});
        }
    }
    return points;
}

// In a pose that is not the mesh's own.
PosedMesh some_pose(const model::Mesh& mesh) {
    tests::Random random(5);
    PosedMesh pose;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        pose.positions.push_back(random.vector(-3, 3));
        pose.normals.push_back(random.rotation() * glm::vec3(0, 1, 0));
    }
    return pose;
}

// A point's corners, each with its share.
struct Shares {
    std::array<std::uint32_t, 3> vertex;
    std::array<double, 3> share;

    Shares(const model::Mesh& mesh, const motion::SurfacePoint& point)
        : vertex{mesh.indices[3 * point.triangle], mesh.indices[3 * point.triangle + 1],
                 mesh.indices[3 * point.triangle + 2]},
          share{1.0 - static_cast<double>(point.u) - static_cast<double>(point.v), point.u, point.v} {}

    template <typename Value>
    Value mean(const auto& of) const {
        return share[0] * Value(of(vertex[0])) + share[1] * Value(of(vertex[1])) + share[2] * Value(of(vertex[2]));
    }
};

// The texel that is shown where number `i` of `size` would be.
int shown_texel(model::Wrap wrap, int i, int size) {
    if (wrap == model::Wrap::clamp) return std::clamp(i, 0, size - 1);
    if (wrap == model::Wrap::repeat) return ((i % size) + size) % size;
    const int there_and_back = ((i % (2 * size)) + 2 * size) % (2 * size);
    return there_and_back < size ? there_and_back : 2 * size - 1 - there_and_back;
}

glm::dvec3 light_of_texel(const model::Texture& texture, const model::Sampler& sampler, int x, int y) {
    const glm::u8vec4 texel = texture.texels[static_cast<std::size_t>(
        shown_texel(sampler.down, y, texture.height) * texture.width + shown_texel(sampler.across, x, texture.width))];
    return {light_of(texel.r), light_of(texel.g), light_of(texel.b)};
}

// Each texel weighs by how near its centre is, to one texel on both axes.
glm::dvec3 light_of_texture(const model::Texture& texture, const model::Sampler& sampler, const glm::dvec2& uv) {
    const double x = uv.x * texture.width, y = uv.y * texture.height;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    if (sampler.nearest) return light_of_texel(texture, sampler, column, row);
    glm::dvec3 light(0);
    for (int i = column - 1; i <= column + 1; ++i)
        for (int j = row - 1; j <= row + 1; ++j)
            light += light_of_texel(texture, sampler, i, j) * std::max(0.0, 1 - std::abs(x - (i + 0.5))) *
                     std::max(0.0, 1 - std::abs(y - (j + 0.5)));
    return light;
}

PointModel described(const model::Mesh& mesh, const PosedMesh& pose, std::vector<motion::SurfacePoint> points) {
    PointModel model;
    model.surface = std::move(points);
    pointsample::describe(mesh, pose, model);
    return model;
}

TEST(Attributes, PlacesAndNormalsAreThePosesBlended) {
    const model::Mesh mesh = patchwork(60, 1);
    const PosedMesh pose = some_pose(mesh);
    const PointModel model = described(mesh, pose, points_on(mesh, 20));
    for (std::size_t i = 0; i < model.surface.size(); ++i) {
        const Shares shares(mesh, model.surface[i]);
        const auto place = shares.mean<glm::dvec3>([&](std::uint32_t v) { return pose.positions[v]; });
        ASSERT_LT(glm::distance(glm::dvec3(model.positions[i]), place), 1e-6);
        const auto normal = shares.mean<glm::dvec3>([&](std::uint32_t v) { return pose.normals[v]; });
        if (glm::length(normal) < 0.01) continue;  // the corners' cancel out
        ASSERT_LT(glm::distance(glm::dvec3(model.normals[i]), glm::normalize(normal)), 1e-4);
    }
}

TEST(Attributes, WhereNormalsCancelOutTheTrianglesOwnStands) {
    model::Mesh mesh = tests::make_triangle({0, 0, 0}, {2, 0, 0}, {0, 0, -3});  // faces +y
    PosedMesh pose{mesh.positions, {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}};
    EXPECT_EQ(described(mesh, pose, {{0, 0.5f, 0}}).normals[0], glm::vec3(0, 1, 0));
}

void expect_colors_of(const model::Mesh& mesh) {
    constexpr double code = 0.51;  // half a code, and the float's rounding
    const PointModel model = described(mesh, some_pose(mesh), points_on(mesh, 20));
    for (std::size_t i = 0; i < model.surface.size(); ++i) {
        const Shares shares(mesh, model.surface[i]);
        glm::dvec3 light = shares.mean<glm::dvec3>([&](std::uint32_t v) {
            return glm::dvec3(light_of(mesh.colors[v].r), light_of(mesh.colors[v].g), light_of(mesh.colors[v].b));
        });
        const model::Material& material = mesh.material_of(shares.vertex[0]);
        if (material.texture != model::no_texture)
            light *= light_of_texture(mesh.textures[material.texture], material.sampler,
                                      shares.mean<glm::dvec2>([&](std::uint32_t v) { return mesh.uvs[v]; }));
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(model.colors[i][channel], code_of(light[channel]), code)
                << i << " texture " << int(material.texture);
        const auto alpha = shares.mean<double>([&](std::uint32_t v) { return mesh.colors[v].a; });
        ASSERT_NEAR(model.colors[i].a, alpha, code);
    }
}

TEST(Attributes, ColorsAreTextureTimesVertexInLightAtThePoint) {
    expect_colors_of(patchwork(90, 2));
}

TEST(Attributes, TexturesAreReadAsTheirSamplersSay) {
    using enum model::Wrap;
    for (const model::Wrap across : {repeat, mirror, clamp}) {
        for (const model::Wrap down : {repeat, mirror, clamp}) {
            for (const bool nearest : {false, true}) {
                SCOPED_TRACE(testing::Message() << int(across) << ' ' << int(down) << ' ' << nearest);
                model::Mesh mesh = patchwork(90, 12);
                for (model::Material& material : mesh.materials) material.sampler = {across, down, nearest};
                expect_colors_of(mesh);
            }
        }
    }
}

TEST(Attributes, OfAPaletteThatIsReadByItsNearestTexelsNoColorIsMixed) {
    model::Mesh mesh = patchwork(90, 13);
    mesh.colors.assign(mesh.vertex_count(), glm::u8vec4(255));
    for (model::Material& material : mesh.materials) material.sampler.nearest = true;
    const PointModel model = described(mesh, some_pose(mesh), points_on(mesh, 50));
    for (std::size_t i = 0; i < model.surface.size(); ++i) {
        const std::uint8_t texture = mesh.material_of(mesh.indices[3 * model.surface[i].triangle]).texture;
        if (texture == model::no_texture) continue;
        const auto is_color = [&](const glm::u8vec4& texel) {
            return glm::u8vec3(texel) == glm::u8vec3(model.colors[i]);
        };
        ASSERT_TRUE(std::ranges::any_of(mesh.textures[texture].texels, is_color)) << i;
    }
}

TEST(Attributes, SlotsAreOfTheCornerWithTheLargestShare) {
    const model::Mesh mesh = patchwork(60, 3);
    const PointModel model = described(mesh, some_pose(mesh), points_on(mesh, 20));
    for (std::size_t i = 0; i < model.surface.size(); ++i) {
        const Shares shares(mesh, model.surface[i]);
        const auto nearest = std::max_element(shares.share.begin(), shares.share.end()) - shares.share.begin();
        ASSERT_EQ(model.slots[i], mesh.slots[shares.vertex[static_cast<std::size_t>(nearest)]]) << i;
    }
}

TEST(Attributes, InfluencesAreTheFourHeaviestJointsOfAllCorners) {
    model::Mesh mesh = patchwork(60, 4);
    tests::Random random(5);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {  // half of them with eight
        const float more = v % 2 == 0 ? 0.0f : random(0, 0.9f);
        mesh.weights[v] *= 1 - more;
        mesh.more_joints.push_back(mesh.joints[v] + glm::u16vec4(6));
        mesh.more_weights.push_back(more * glm::vec4(0.4f, 0.3f, 0.2f, 0.1f));
    }
    const PointModel model = described(mesh, some_pose(mesh), points_on(mesh, 20));
    constexpr double rounding = 1e-6;
    for (std::size_t i = 0; i < model.surface.size(); ++i) {
        const Shares shares(mesh, model.surface[i]);
        std::map<int, double> joints;
        for (std::size_t k = 0; k < 3; ++k)
            mesh.visit_influences(shares.vertex[k], [&](std::uint16_t joint, float weight) {
                joints[joint] += shares.share[k] * static_cast<double>(weight);
            });
        std::vector<double> heaviest;
        for (const auto& [joint, weight] : joints) heaviest.push_back(weight);
        std::sort(heaviest.rbegin(), heaviest.rend());
        heaviest.resize(4);
        const double sum = heaviest[0] + heaviest[1] + heaviest[2] + heaviest[3];
        for (int k = 0; k < 4; ++k) {
            const double weight = static_cast<double>(model.weights[i][k]);
            ASSERT_NEAR(weight, heaviest[static_cast<std::size_t>(k)] / sum, rounding);
            if (weight > 0) {
                ASSERT_NEAR(weight, joints[model.joints[i][k]] / sum, rounding);
            }
            for (int j = 0; j < k && weight > 0; ++j) ASSERT_NE(model.joints[i][j], model.joints[i][k]);
        }
    }
}

}  // namespace
