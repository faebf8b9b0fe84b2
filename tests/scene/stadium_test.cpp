#include "scene/places/stadium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "scene/ground.h"
#include "sfsm/random.h"
#include "tests/scene/spacing.h"

namespace {

using scene::Seat;
using scene::StadiumPlan;
using scene::StaticMesh;
using scene::StaticVertex;

constexpr std::int64_t sizes[] = {1, 100, 8000, 20000, 45000, 1'000'000};
constexpr float track_width = 8 * 1.22f;  // [m]

// Chords of the bends come nearer to the pitch than the spokes that rows' offsets are measured along.
constexpr float chord_sag = 0.6f;  // [m]

TEST(Seating, HoldsEverybodyWhoIsNoAthleteUpToItsLargest) {
    for (const std::int64_t people : {1, 100, 8000, 20000, 45000, 60000}) {
        EXPECT_GE(static_cast<std::int64_t>(scene::plan_stadium(people).seats.size()), people - people / 100);
    }
    EXPECT_GE(scene::plan_stadium(1'000'000).seats.size(), 60'000u);
}

TEST(Seating, IsNearlyFullWithTheCrowdItIsPlannedFor) {
    for (const double people : {12000.0, 20000.0, 30000.0, 45000.0, 60000.0}) {
        const StadiumPlan plan = scene::plan_stadium(static_cast<std::int64_t>(people));
        EXPECT_GT((people - 200) / static_cast<double>(plan.seats.size()), 0.9);
    }
}

TEST(Seating, HasEightToSixtyRowsAndMoreForMore) {
    std::size_t previous = 8;
    for (const std::int64_t people : sizes) {
        const std::size_t rows = scene::plan_stadium(people).rows.size();
        EXPECT_GE(rows, previous);
        EXPECT_LE(rows, 60u);
        previous = rows;
    }
}

TEST(Seating, NeighboursKeepTheirDistance) {
    constexpr float least = 0.519f;  // [m] seats are 0.52 m apart
    for (const std::int64_t people : {std::int64_t{1}, std::int64_t{20000}, std::int64_t{1'000'000}}) {
        std::vector<glm::vec3> positions;
        for (const Seat& seat : scene::plan_stadium(people).seats) positions.push_back(seat.position);
        EXPECT_GE(tests::least_distance(positions, 1.0f), least) << people << " people";
    }
}

TEST(Seating, SeatsFaceThePitch) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        for (const Seat& seat : plan.seats) {
            const glm::vec2 xz(seat.position.x, seat.position.z), ahead(std::sin(seat.yaw), std::cos(seat.yaw));
            ASSERT_GT(plan.oval.offset_of(xz) - plan.oval.offset_of(xz + ahead), 0.98f);
        }
    }
}

TEST(Seating, SeatsLieBetweenTrackAndOuterWall) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        EXPECT_GT(plan.stand_offset, track_width);
        for (const Seat& seat : plan.seats) {
            const float offset = plan.oval.offset_of({seat.position.x, seat.position.z});
            ASSERT_GE(offset, plan.stand_offset - chord_sag);
            ASSERT_LT(offset, plan.outer_offset);
            ASSERT_LT(seat.position.y, plan.rim_height);
        }
    }
}

TEST(Seating, RowsAndSeatsAgree) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        std::uint32_t next = 0;
        for (std::size_t r = 0; r < plan.rows.size(); ++r) {
            ASSERT_EQ(plan.rows[r].first_seat, next);
            next += plan.rows[r].seat_count;
            for (std::uint32_t s = plan.rows[r].first_seat; s < next; ++s) {
                ASSERT_EQ(plan.seats[s].row, r);
                ASSERT_EQ(plan.seats[s].position.y, plan.rows[r].floor);
                ASSERT_LT(plan.seats[s].section, plan.spokes.size());
            }
        }
        ASSERT_EQ(next, plan.seats.size());
    }
}

TEST(Seating, EverybodySeesTheTrackOverTheHeadInFront) {
    constexpr float eye_height = 1.2f, c_value = 0.06f;  // [m] the least that guides for safe stadiums accept
    constexpr float focus = track_width / 2, hips = 0.61f;
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        for (std::size_t r = 1; r < plan.rows.size(); ++r) {
            const float eye = plan.rows[r].floor + eye_height;
            const float far = plan.rows[r].offset + hips - focus, near = plan.rows[r - 1].offset + hips - focus;
            const float clearance = eye * near / far - (plan.rows[r - 1].floor + eye_height);
            EXPECT_GE(clearance, c_value) << "row " << r << " of " << plan.rows.size();
        }
    }
}

TEST(Seating, IsTheSameEveryTime) {
    const StadiumPlan a = scene::plan_stadium(20000), b = scene::plan_stadium(20000);
    ASSERT_EQ(a.seats.size(), b.seats.size());
    for (std::size_t i = 0; i < a.seats.size(); ++i) ASSERT_EQ(a.seats[i].position, b.seats[i].position);
}

class Structure : public testing::TestWithParam<std::int64_t> {
protected:
    const StadiumPlan plan = scene::plan_stadium(GetParam());
    const StaticMesh mesh = scene::build_structure(plan);

    const StaticVertex& corner(std::size_t triangle, std::size_t i) const {
        return mesh.vertices[mesh.indices[3 * triangle + i]];
    }
    std::size_t triangle_count() const { return mesh.indices.size() / 3; }
    static bool is_ground(const StaticVertex& vertex) {
        return vertex.color.a == static_cast<std::uint8_t>(scene::Surface::ground);
    }
};

TEST_P(Structure, NormalsAgreeWithWinding) {
    ASSERT_EQ(mesh.indices.size() % 3, 0u);
    for (std::size_t t = 0; t < triangle_count(); ++t) {
        const StaticVertex &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
        const glm::vec3 across = glm::cross(b.position - a.position, c.position - a.position);
        const float twice_area = glm::length(across);
        ASSERT_GT(twice_area, 1e-4f) << "triangle " << t << " at " << a.position.x << ' ' << a.position.y;
        for (const StaticVertex* vertex : {&a, &b, &c}) {
            ASSERT_NEAR(glm::length(vertex->normal), 1.0f, 1e-5f);
            ASSERT_GT(glm::dot(vertex->normal, across / twice_area), 0.99f);
        }
    }
}

TEST_P(Structure, EveryNumberIsFinite) {
    for (const StaticVertex& vertex : mesh.vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_TRUE(std::isfinite(vertex.position[axis]));
            ASSERT_TRUE(std::isfinite(vertex.normal[axis]));
        }
        ASSERT_LE(vertex.color.a, static_cast<std::uint8_t>(scene::Surface::ground));
    }
}

TEST_P(Structure, SectorsCoverEveryTriangleOnce) {
    std::uint32_t next = 0;
    for (const scene::StaticSector& sector : mesh.sectors) {
        ASSERT_EQ(sector.first_index, next);
        ASSERT_GT(sector.index_count, 0u);
        ASSERT_EQ(sector.index_count % 3, 0u);
        next += sector.index_count;
    }
    EXPECT_EQ(next, mesh.indices.size());
}

TEST_P(Structure, SectorBoxesHoldTheirVertices) {
    for (const scene::StaticSector& sector : mesh.sectors) {
        for (std::uint32_t i = sector.first_index; i < sector.first_index + sector.index_count; ++i) {
            ASSERT_LT(mesh.indices[i], mesh.vertices.size());
            const glm::vec3 position = mesh.vertices[mesh.indices[i]].position;
            ASSERT_EQ(glm::clamp(position, sector.box.min, sector.box.max), position);
        }
    }
}

TEST_P(Structure, OnlyTheGroundIsGround) {
    for (std::size_t t = 0; t < triangle_count(); ++t) {
        const bool flat = corner(t, 0).position.y == 0 && corner(t, 1).position.y == 0 && corner(t, 2).position.y == 0;
        ASSERT_EQ(is_ground(corner(t, 0)), flat);
        if (flat) {
            ASSERT_EQ(corner(t, 0).normal, glm::vec3(0, 1, 0));
        }
    }
}

// No gap and no overlap: its triangles' areas add up to the square's, and whole edges meet everywhere inside of it.
TEST_P(Structure, GroundIsOneSheetAsFarAsCamerasCanSee) {
    constexpr double reach = scene::ground_reach, earth_radius = 6.371e6, farthest_camera = 1e5;  // [m]
    EXPECT_GT(reach - farthest_camera, std::sqrt(2 * earth_radius * 1e4)) << "from as high as aeroplanes fly";
    double area = 0;
    std::map<std::array<float, 4>, int> edges;  // from and to: how often, less how often the other way
    for (std::size_t t = 0; t < triangle_count(); ++t) {
        if (!is_ground(corner(t, 0))) continue;
        const glm::dvec3 a = corner(t, 0).position, b = corner(t, 1).position, c = corner(t, 2).position;
        area += 0.5 * glm::cross(b - a, c - a).y;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3 from = corner(t, i).position, to = corner(t, (i + 1) % 3).position;
            ++edges[{from.x, from.z, to.x, to.z}];
            --edges[{to.x, to.z, from.x, from.z}];
        }
    }
    EXPECT_NEAR(area / (4 * reach * reach), 1, 1e-9);
    for (const auto& [edge, count] : edges) {
        ASSERT_LE(std::abs(count), 1);
        if (count == 0) continue;
        const bool is_border =
            (edge[0] == edge[2] && std::abs(edge[0]) == reach) || (edge[1] == edge[3] && std::abs(edge[1]) == reach);
        ASSERT_TRUE(is_border) << edge[0] << ' ' << edge[1] << " to " << edge[2] << ' ' << edge[3];
    }
}

TEST_P(Structure, EverySeatIsOnATread) {
    constexpr float tolerance = 1e-3f;  // [m]
    constexpr std::size_t stride = 97;  // seats tried
    for (std::size_t s = 0; s < plan.seats.size(); s += stride) {
        const glm::vec3 seat = plan.seats[s].position;
        bool supported = false;
        for (std::size_t t = 0; t < triangle_count() && !supported; ++t) {
            if (corner(t, 0).normal.y < 0.99f || std::abs(corner(t, 0).position.y - seat.y) > tolerance) continue;
            bool inside = true;
            for (std::size_t i = 0; i < 3; ++i) {
                const glm::vec3 edge = corner(t, (i + 1) % 3).position - corner(t, i).position;
                inside = inside && glm::cross(edge, seat - corner(t, i).position).y >= -tolerance;
            }
            supported = inside;
        }
        ASSERT_TRUE(supported) << "seat " << s;
    }
}

// Whether the triangle a, b, c cuts the segment from `eye` to `target`, or lies at its end.
bool cuts(glm::vec3 eye, glm::vec3 target, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    constexpr float end = 1.0001f;
    const glm::vec3 along = target - eye, ab = b - a, ac = c - a, p = glm::cross(along, ac);
    const float determinant = glm::dot(ab, p);
    if (std::abs(determinant) < 1e-12f) return false;
    const glm::vec3 from = eye - a, q = glm::cross(from, ab);
    const float u = glm::dot(from, p) / determinant, v = glm::dot(along, q) / determinant;
    const float t = glm::dot(ac, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < end;
}

TEST_P(Structure, NobodySeesTheBackOfASurface) {
    constexpr std::size_t tried = 1500;  // triangles a view
    constexpr double tolerated = 0.005;  // of those seen: the open ends of benches, from the aisles
    const float far = plan.oval.half_straight + plan.oval.radius + plan.outer_offset + 60;
    const glm::vec3 eyes[] = {{3, 1.7f, 5}, {-40, 30, 12}, {far, 1.7f, 20}, {-50, 25, far}, {0, far, far}};
    std::size_t seen = 0, backs = 0;
    std::uint64_t bits = 1;
    for (const glm::vec3& eye : eyes) {
        for (std::size_t i = 0; i < tried; ++i) {
            bits = sfsm::mix(bits);
            const std::size_t t = sfsm::below(bits, static_cast<std::uint32_t>(triangle_count()));
            const glm::vec3 middle = (corner(t, 0).position + corner(t, 1).position + corner(t, 2).position) / 3.0f;
            bool hidden = false;  // by what is drawn: faces towards the eye
            for (std::size_t other = 0; other < triangle_count() && !hidden; ++other) {
                const glm::vec3 a = corner(other, 0).position;
                if (other == t || glm::dot(eye - a, corner(other, 0).normal) < 0) continue;
                hidden = cuts(eye, middle, a, corner(other, 1).position, corner(other, 2).position);
            }
            if (hidden) continue;
            ++seen;
            backs += glm::dot(eye - middle, corner(t, 0).normal) < 0;
        }
    }
    EXPECT_GT(seen, tried / 2);
    EXPECT_LE(static_cast<double>(backs), tolerated * static_cast<double>(seen)) << backs << " of " << seen;
}

INSTANTIATE_TEST_SUITE_P(Sizes, Structure, testing::Values(1, 12000, 20000, 1'000'000),
                         [](const auto& size) { return "For" + std::to_string(size.param); });

TEST(StructureBudget, TwentyThousandPeopleCostAtMostTwentyFiveThousandTriangles) {
    const StaticMesh mesh = scene::build_structure(scene::plan_stadium(20000));
    EXPECT_LE(mesh.indices.size() / 3, 25'000u);
    EXPECT_GE(mesh.sectors.size(), 16u);
    EXPECT_LE(mesh.sectors.size(), 26u);
}

}  // namespace
