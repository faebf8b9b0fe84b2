// What of a body hides what of it: the same on every processor and from whichever side it is asked.
#include "render/native/self_occlusion.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "pointsample/sample.h"
#include "render/native/directions.h"
#include "render/native/facets.h"
#include "scene/person.h"

namespace {

using render::native::direction_nodes;
using render::native::direction_of;
using render::native::SelfOcclusion;

// The built-in person in the pose that they have without a clip.
struct Body {
    model::Character character = scene::make_person();
    pointsample::PointModel points;
    motion::PoseTable poses;
    std::vector<float> shares;

    Body() {
        pointsample::SampleOptions options;
        options.count = 1000;  // not whole words of bits
        points = pointsample::sample(character.mesh, pointsample::spread_poses(character, {}, 1), options);
        poses = motion::bake_poses(character, {}, points.surface, std::size_t{1} << 24);
        shares.assign(points.size(), 1.0f);
    }
    figures::Figure figure() const { return {&character.mesh, &poses, &points}; }
    std::vector<glm::vec3> facets() const {
        const figures::Figure of = figure();
        return render::native::Facets(of).in_pose(0);
    }
    SelfOcclusion occlusion() const { return {figure(), 0, facets(), shares}; }
};

const Body& body() {
    static const Body one;
    return one;
}

// What must be the same.
struct Look {
    float silhouette, facing;
    std::vector<std::uint32_t> visible;
    std::vector<float> shown;

    explicit Look(const SelfOcclusion::Seen& seen)
        : silhouette(seen.silhouette),
          facing(seen.facing),
          visible(seen.visible.begin(), seen.visible.end()),
          shown(seen.shown.begin(), seen.shown.end()) {}
    bool operator==(const Look&) const = default;
};

std::vector<Look> look_around() {
    SelfOcclusion occlusion = body().occlusion();
    std::vector<Look> looks;
    for (int node = 0; node < direction_nodes; ++node)
        for (const SelfOcclusion::Seen& seen : occlusion.look_both_ways(direction_of(node))) looks.emplace_back(seen);
    return looks;
}

TEST(SelfOcclusion, IsTheSameOnEveryInstructionSet) {
    std::optional<std::vector<Look>> first;
    for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
        hwy::SetSupportedTargetsForTest(rest & -rest);
        const std::vector<Look> looks = look_around();
        hwy::SetSupportedTargetsForTest(0);
        if (first)
            EXPECT_TRUE(*first == looks) << hwy::TargetName(rest & -rest);
        else
            first = looks;
    }
}

// Asked for either direction first, cells lie elsewhere on the body, by less than one.
TEST(SelfOcclusion, SeesTheSameFromEitherSide) {
    constexpr float silhouette_tolerance = 0.015f;  // cells at the outline, of some 4000
    // Of all points: those at edges. Cells moved by a quarter to three quarters change up to 3.4 %.
    constexpr float point_tolerance = 0.035f;
    const std::vector<Look> looks = look_around();
    for (int node = 0; node < direction_nodes; ++node) {
        const int opposite = render::native::opposite_of(node);
        for (int way = 0; way < 2; ++way) {
            const Look &a = looks[2 * node + way], &b = looks[2 * opposite + 1 - way];
            EXPECT_NEAR(a.silhouette, b.silhouette, silhouette_tolerance * a.silhouette) << node;
            int different = 0;
            for (std::size_t word = 0; word < a.visible.size(); ++word)
                different += std::popcount(a.visible[word] ^ b.visible[word]);
            EXPECT_LE(different, point_tolerance * static_cast<float>(body().points.size())) << node;
        }
    }
}

// [model units] How far in front of a point, towards the eye, the farthest triangle that faces the eye is; 0: none is.
float in_front_of(glm::vec3 point, glm::vec3 to_eye) {
    const model::Mesh& mesh = body().character.mesh;
    float farthest = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t which) {
            return motion::unpack_position(body().poses.vertices[mesh.indices[i + which]], body().poses.box);
        };
        const glm::vec3 a = corner(0) - point, b = corner(1) - point, c = corner(2) - point;
        // The eye is on the inner side of all three planes through the point and an edge.
        const auto inside = [&](glm::vec3 from, glm::vec3 to) { return glm::dot(glm::cross(from, to), to_eye) > 0.0f; };
        if (!inside(a, b) || !inside(b, c) || !inside(c, a)) continue;
        const glm::vec3 normal = glm::cross(b - a, c - a);
        farthest = std::max(farthest, glm::dot(normal, a) / glm::dot(normal, to_eye));
    }
    return farthest;
}

// Rays tell.
TEST(SelfOcclusion, HidesWhatIsBehind) {
    constexpr float near = 0.05f;  // [model units, metres] less in front is taken for the same surface
    constexpr int step = 7;        // not all directions: a person has some thousand triangles
    int behind = 0, wrongly_hidden = 0, wrongly_shown = 0;
    SelfOcclusion occlusion = body().occlusion();
    const std::vector<glm::vec3> facets = body().facets();
    for (int node = 0; node < direction_nodes; node += step) {
        const glm::vec3 direction = direction_of(node);
        const auto seen = occlusion.look_both_ways(direction);
        for (int way = 0; way < 2; ++way) {
            const glm::vec3 to_eye = way == 0 ? direction : -direction;
            for (std::size_t i = 0; i < facets.size(); ++i) {
                if (!(glm::dot(facets[i], to_eye) > 0.0f)) continue;
                const glm::vec3 at = motion::unpack_position(body().poses.points[i], body().poses.box);
                const float in_front = in_front_of(at, to_eye);
                const bool is_hidden = (seen[way].visible[i / 32] >> (i % 32) & 1u) == 0;
                behind += in_front > near;
                wrongly_hidden += is_hidden && !(in_front > 0.0f);
                wrongly_shown += !is_hidden && in_front > near;
                EXPECT_EQ(seen[way].shown[i] > 0.0f, !is_hidden);
            }
        }
    }
    EXPECT_GT(behind, 1000);
    constexpr double narrow_gaps = 0.005;  // less than a cell wide
    EXPECT_LT(wrongly_hidden, narrow_gaps * behind);
    constexpr double at_edges = 0.2;  // a point shows unless all four cells around it are in front
    EXPECT_LT(wrongly_shown, at_edges * behind);
}

}  // namespace
