// The plan: what everybody sees, and how seats, aisles, tiers and roof fit together. All by the geometry of seats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "motion/pose.h"
#include "scene/person.h"
#include "scene/places/stadium.h"

namespace {

using scene::Seat;
using scene::Spoke;
using scene::StadiumPlan;

constexpr std::int64_t sizes[] = {1, 8'000, 12'000, 20'000, 45'000, 1'000'000};
constexpr float eye_height = 1.2f;                                          // [m] of who sits, above the row's floor
constexpr float focus_offset = 8 * 1.22f / 2;                               // [m] the middle of the track
constexpr float least_riser = 0.35f, most_riser = 0.55f, rounding = 1e-3f;  // [m]

// One seat of every row on the main straight, where offsets are plain distances.
std::vector<glm::vec3> column_of_seats(const StadiumPlan& plan) {
    std::vector<glm::vec3> result;
    for (const scene::Row& row : plan.rows) {
        for (std::uint32_t s = row.first_seat; s < row.first_seat + row.seat_count; ++s) {
            const glm::vec3 at = plan.seats[s].position;
            if (at.z > 0 && std::abs(at.x) < 12) {
                result.push_back(at);
                break;
            }
        }
    }
    return result;
}

TEST(Sightlines, ClearTheHeadInFrontByNineCentimetresAndNoMoreThanStepsAskFor) {
    constexpr float clearance = 0.09f;  // [m] "good" in guides for stadiums
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const std::vector<glm::vec3> seats = column_of_seats(plan);
        ASSERT_EQ(seats.size(), plan.rows.size());
        const float focus = plan.oval.radius + focus_offset;
        for (std::size_t row = 1; row < seats.size(); ++row) {
            const float eye = seats[row].y + eye_height, front = seats[row - 1].y + eye_height;
            // Where the line from the eye to the ground at the focus passes the head in front.
            const float passes = eye * (seats[row - 1].z - focus) / (seats[row].z - focus);
            if (row == plan.lower_rows) {
                EXPECT_GT(passes - front, clearance) << "over the concourse";
                continue;
            }
            const float riser = seats[row].y - seats[row - 1].y;
            EXPECT_GE(riser, least_riser - rounding);
            EXPECT_LE(riser, most_riser + rounding);
            if (riser < most_riser - rounding) {
                EXPECT_GE(passes - front, clearance - rounding) << "row " << row;
            }
            if (riser > least_riser + rounding) {
                EXPECT_LE(passes - front, clearance + rounding) << "row " << row;
            }
        }
    }
}

TEST(Sightlines, AreDrawnFromTheEyesOfTheBuiltInPerson) {
    constexpr float tolerance = 0.05f;  // [m]
    const model::Character person = scene::make_person();
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    const auto sit =
        std::find_if(person.clips.begin(), person.clips.end(), [](auto& clip) { return clip.name == "sit"; });
    ASSERT_NE(sit, person.clips.end());
    motion::evaluate(person, *sit, 0, pose);
    motion::skin(person.mesh, pose, positions, normals);
    float sum = 0, count = 0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (person.mesh.slots[v] != model::no_slot || person.mesh.positions[v].y < 1.5f) continue;
        sum += positions[v].y;
        ++count;
    }
    ASSERT_GT(count, 0);
    // Whoever is of average height and rests on the seat.
    constexpr float average = 1.70f;  // [m]
    const float above_seat = (sum / count - scene::seat_height) * average / 1.75f;
    EXPECT_NEAR(scene::seat_height + above_seat, eye_height, tolerance);
}

TEST(Tiers, AreTwoFromNineteenRowsOnTheLowerOneTheSmaller) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        if (plan.rows.size() <= 18) {
            EXPECT_EQ(plan.lower_rows, plan.rows.size());
        } else {
            const double share = plan.lower_rows / static_cast<double>(plan.rows.size());
            EXPECT_NEAR(share, 0.45, 0.5 / static_cast<double>(plan.rows.size()) + 1e-6);
        }
    }
    EXPECT_LT(scene::plan_stadium(45'000).lower_rows, scene::plan_stadium(45'000).rows.size());
}

TEST(Tiers, HaveAWalkwayBetweenThemAndNoneWithin) {
    constexpr float walkway = 2.4f, wall = 2.6f;  // [m] deep, and high enough for doors below the first row
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        for (std::size_t row = 1; row < plan.rows.size(); ++row) {
            const scene::Row &below = plan.rows[row - 1], &here = plan.rows[row];
            const bool between = row == plan.lower_rows;
            EXPECT_NEAR(here.offset - below.offset, plan.room.depth + (between ? walkway : 0), rounding);
            if (between) {
                EXPECT_NEAR(here.floor - below.floor, wall, rounding);
            }
        }
    }
}

TEST(Rows, AreNoMoreThanPeopleNeedWithAFewSeatsToSpare) {
    constexpr double filled = 0.975;
    for (const std::int64_t people : {12'000, 20'000, 31'000, 45'000, 60'000}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const double sitting = static_cast<double>(people) - 200, seats = static_cast<double>(plan.seats.size());
        EXPECT_LE(sitting, filled * seats) << people << " people";
        EXPECT_GT(sitting, filled * (seats - 1.02 * plan.rows.back().seat_count)) << people << " people";
    }
    EXPECT_EQ(scene::plan_stadium(1).rows.size(), 8u);
    EXPECT_EQ(scene::plan_stadium(1'000'000).rows.size(), 60u);
}

TEST(Rows, BeginBehindAWalkwayAtTheWall) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        EXPECT_EQ(plan.stand_offset, plan.rows.front().offset);
        EXPECT_NEAR(plan.stand_offset, 14.0f, rounding);
        EXPECT_NEAR(plan.rows.front().floor, 1.2f, rounding);
        EXPECT_NEAR(plan.outer_offset, plan.rows.back().offset + plan.room.depth + 1.6f, rounding);
    }
}

// ---- Spokes and aisles ----

float turn(const Spoke& from, const Spoke& to) {
    return std::acos(std::clamp(glm::dot(from.outward, to.outward), -1.0f, 1.0f));
}

TEST(Spokes, StandOnTheInnerLineAtRightAnglesToIt) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        for (const Spoke& spoke : plan.spokes) {
            EXPECT_NEAR(plan.oval.offset_of(spoke.foot), 0, rounding);
            for (const float offset : {10.0f, 50.0f})
                EXPECT_NEAR(plan.oval.offset_of(spoke.at(offset)), offset, rounding);
        }
    }
}

TEST(Spokes, CutStraightsAndBendsIntoEqualSectionsOfAboutTwelveMetres) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const float middle = (plan.rows.front().offset + plan.rows.back().offset + plan.room.depth) / 2;
        std::vector<float> straight, bend;
        for (std::size_t s = 0; s < plan.spokes.size(); ++s) {
            const Spoke &from = plan.spokes[s], &to = plan.spokes[(s + 1) % plan.spokes.size()];
            const float length = glm::distance(from.at(middle), to.at(middle));
            EXPECT_GT(length, 10.5f);
            EXPECT_LT(length, 13.5f);
            const bool parallel = turn(from, to) < 1e-3f;
            (parallel ? straight : bend).push_back(length);
            if (parallel) {
                EXPECT_NEAR(std::abs(from.outward.y), 1, 1e-6f);
            }
        }
        for (const auto& lengths : {straight, bend}) {
            const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
            EXPECT_LT(*most - *least, 0.01f);
        }
        EXPECT_EQ(straight.size(), 14u) << "two straights of 84.39 m";
        EXPECT_EQ(bend.size() % 4, 0u) << "the far end of a bend has a spoke";
        const float arc = std::numbers::pi_v<float> * (plan.oval.radius + middle) * 2;
        EXPECT_NEAR(static_cast<float>(bend.size()), arc / 12, 2.1f);
    }
}

// [m] of a point from the line along a spoke.
float from_spoke(const Spoke& spoke, glm::vec3 at) {
    const glm::vec2 to = glm::vec2(at.x, at.z) - spoke.foot;
    return std::abs(to.x * spoke.outward.y - to.y * spoke.outward.x);
}

TEST(Aisles, AreLeftFreeBySeatsAndNoWiderThanSeatsMustLeaveThem) {
    constexpr float half_aisle = 0.6f;  // [m]
    for (const std::int64_t people : {std::int64_t{20'000}, std::int64_t{1'000'000}}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const float half_seat = plan.room.width / 2;
        std::map<std::pair<int, int>, std::vector<Seat>> blocks;  // by row and section
        for (const Seat& seat : plan.seats) blocks[{seat.row, seat.section}].push_back(seat);
        for (const auto& [where, seats] : blocks) {
            const Spoke& from = plan.spokes[where.second];
            const Spoke& to = plan.spokes[(where.second + 1) % plan.spokes.size()];
            // Seats are rectangles: at the row's ends their corners are nearest to the spokes, which lean in the bends.
            const float lean = std::cos(turn(from, to) / 2);
            const float first = from_spoke(from, seats.front().position), last = from_spoke(to, seats.back().position);
            ASSERT_GE(first, (half_aisle + half_seat) * lean - rounding);
            ASSERT_GE(last, (half_aisle + half_seat) * lean - rounding);
            ASSERT_NEAR(first, last, rounding) << "seats are not in the middle of their section";
            ASSERT_LT(first, (half_aisle + 2 * half_seat) * lean + rounding) << "room for one more seat";
            for (std::size_t i = 1; i < seats.size(); ++i)
                ASSERT_NEAR(glm::distance(seats[i - 1].position, seats[i].position), plan.room.width, rounding);
        }
    }
}

TEST(Seats, FaceSquarelyAwayFromTheirRow) {
    const StadiumPlan plan = scene::plan_stadium(45'000);
    for (std::size_t i = 1; i < plan.seats.size(); ++i) {
        const Seat &one = plan.seats[i - 1], &next = plan.seats[i];
        if (one.row != next.row || one.section != next.section) continue;
        const glm::vec3 ahead(std::sin(next.yaw), 0, std::cos(next.yaw));
        ASSERT_NEAR(glm::dot(ahead, glm::normalize(next.position - one.position)), 0, 1e-3f);
        const glm::vec2 xz(next.position.x, next.position.z);
        ASSERT_LT(plan.oval.offset_of(xz + glm::vec2(ahead.x, ahead.z)), plan.oval.offset_of(xz));
    }
}

TEST(Seats, HaveRoomForFeetAndBacksOnTheTread) {
    constexpr float hips = 0.61f;  // [m] from the tread's front edge
    for (const scene::Room& room : {scene::Room{}, scene::Room{1.0f, 1.4f, false}}) {
        const StadiumPlan plan = scene::plan_stadium(20'000, room);
        const std::vector<glm::vec3> seats = column_of_seats(plan);
        for (std::size_t row = 0; row < seats.size(); ++row) {
            const float in_tread = seats[row].z - plan.oval.radius - plan.rows[row].offset;
            EXPECT_NEAR(in_tread, room.seats ? hips : room.depth / 2, rounding);
        }
    }
}

// ---- Roof ----

TEST(Roof, CoversTheUpperRowsOfLargeStadiumsOnly) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const bool covered = plan.roof.inner_offset < plan.roof.outer_offset;
        EXPECT_EQ(covered, plan.rows.size() >= 14) << plan.rows.size() << " rows";
        EXPECT_EQ(plan.roof.outer_offset, plan.outer_offset);
        if (covered) {
            const float share = (plan.outer_offset - plan.roof.inner_offset) / (plan.outer_offset - plan.stand_offset);
            EXPECT_NEAR(share, 0.32f, 1e-3f);
        }
    }
    EXPECT_GE(scene::plan_stadium(45'000).rows.size(), 14u);
    EXPECT_LT(scene::plan_stadium(8'000).rows.size(), 14u);
}

TEST(Roof, RisesTowardsThePitch) {
    for (const std::int64_t people : {std::int64_t{45'000}, std::int64_t{1'000'000}}) {
        const scene::Roof roof = scene::plan_stadium(people).roof;
        const float slope = (roof.inner_height - roof.outer_height) / (roof.outer_offset - roof.inner_offset);
        EXPECT_NEAR(slope, 0.08f, 1e-3f);
    }
}

TEST(Roof, LeavesTheLastRowHeadroomAndItsView) {
    constexpr float thickness = 0.6f, headroom = 3.0f;  // [m] arms up
    for (const std::int64_t people : {std::int64_t{45'000}, std::int64_t{1'000'000}}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const scene::Row& last = plan.rows.back();
        EXPECT_GT(plan.roof.outer_height - thickness - last.floor, headroom);
        EXPECT_LT(plan.roof.outer_height - last.floor, 2.5f * headroom) << "a roof that keeps no rain off";
        // The last row sees the opposite stand's last row under the edge.
        const float eye = last.floor + eye_height;
        EXPECT_GT(plan.roof.inner_height - thickness, eye);
    }
}

TEST(Rim, IsTheTopOfRoofOrWall) {
    for (const std::int64_t people : sizes) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const bool covered = plan.roof.inner_offset < plan.roof.outer_offset;
        EXPECT_NEAR(plan.rim_height, covered ? plan.roof.inner_height : plan.rows.back().floor + 1.4f, rounding);
    }
}

}  // namespace
