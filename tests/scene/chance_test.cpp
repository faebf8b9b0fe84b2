// What populate draws: how much, how far, and that no two draws have to do with each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "scene/crowd.h"
#include "scene/person.h"
#include "sfsm/random.h"
#include "tests/scene/fake_cast.h"
#include "tests/scene/statistics.h"

namespace {

using scene::Crowd;
using scene::Role;
using scene::Seat;
using scene::StadiumPlan;
using tests::FakeCast;

constexpr float pitch = 0.75f;  // [m] of the grid that people stand in
constexpr double pi = std::numbers::pi;

FakeCast two_kinds_of_sitters() {
    FakeCast cast = tests::sitters();
    tests::add_sitter(cast);
    return cast;
}

double luma(glm::u8vec4 color) {
    return 0.299 * color.x + 0.587 * color.y + 0.114 * color.z;
}

// [rad] from one direction to another, in [-pi, pi].
double turn(double from, double to) {
    return std::remainder(to - from, 2 * pi);
}

// A number of everybody's, by its name.
using Traits = std::map<std::string, std::vector<double>>;

void add_common(Traits& traits, const Crowd& crowd, std::size_t i) {
    traits["height"].push_back(crowd.height[i]);
    traits["character"].push_back(crowd.character[i]);
    traits["upper bits"].push_back(crowd.hash[i] >> 16);
    traits["lower bits"].push_back(crowd.hash[i] & 0xffff);
    traits["skin"].push_back(luma(crowd.palette[i][scene::skin_slot]));
    traits["trousers"].push_back(luma(crowd.palette[i][scene::trousers_slot]));
}

// By where their seat is. Only sitters are exactly above it.
std::map<std::pair<float, float>, Seat> seats_by_place(const StadiumPlan& plan) {
    std::map<std::pair<float, float>, Seat> result;
    for (const Seat& seat : plan.seats) result[{seat.position.x, seat.position.z}] = seat;
    return result;
}

struct Stands {
    FakeCast cast = two_kinds_of_sitters();
    StadiumPlan plan = scene::plan_stadium(20000);
    Crowd crowd;
    std::map<std::pair<float, float>, Seat> seats = seats_by_place(plan);
    explicit Stands(std::uint64_t seed, std::int64_t people = 20000)
        : crowd(scene::populate(plan, {people, cast.members, cast.poses, seed})) {}

    const Seat& seat(std::size_t i) const { return seats.at({crowd.position[i].x, crowd.position[i].z}); }
    double yaw_from_seat(std::size_t i) const { return turn(seat(i).yaw, crowd.yaw[i]); }

    Traits traits() const {
        Traits result;
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            if (crowd.role[i] != Role::spectator) continue;
            add_common(result, crowd, i);
            result["yaw"].push_back(yaw_from_seat(i));
            result["row"].push_back(seat(i).row);
        }
        return result;
    }
};

double to_centre(glm::vec3 position) {
    return std::atan2(-position.x, -position.z);
}

// [m] from the middle of somebody's place in the grid, along x or z.
float off_grid(float at) {
    return at - pitch * (std::floor(at / pitch) + 0.5f);
}

struct Grounds {
    FakeCast cast = two_kinds_of_sitters();
    StadiumPlan plan = scene::plan_stadium(200'000);
    Crowd crowd;
    std::vector<std::size_t> people;  // who stand
    explicit Grounds(std::int64_t count = 200'000, std::uint64_t seed = 1)
        : crowd(scene::populate(plan, {count, cast.members, cast.poses, seed})) {
        for (std::size_t i = 0; i < crowd.size(); ++i)
            if (crowd.role[i] == Role::standing) people.push_back(i);
    }

    float offset(std::size_t i) const { return plan.oval.offset_of({crowd.position[i].x, crowd.position[i].z}); }

    Traits traits() const {
        Traits result;
        for (const std::size_t i : people) {
            add_common(result, crowd, i);
            result["yaw"].push_back(turn(to_centre(crowd.position[i]), crowd.yaw[i]));
            result["x"].push_back(off_grid(crowd.position[i].x));
            result["z"].push_back(off_grid(crowd.position[i].z));
            result["shirt"].push_back(luma(crowd.palette[i][scene::shirt_slot]));
        }
        return result;
    }
};

const Grounds& grounds() {
    static const Grounds result;
    return result;
}

void expect_independent(const Traits& traits) {
    std::map<std::string, std::vector<int>> classes;
    for (const auto& [name, values] : traits) classes[name] = tests::quarters(values);
    for (auto a = classes.begin(); a != classes.end(); ++a) {
        for (auto b = std::next(a); b != classes.end(); ++b) {
            EXPECT_LT(tests::dependence(a->second, b->second), tests::chance) << a->first << " and " << b->first;
        }
    }
}

TEST(Chance, NothingAboutASpectatorTellsAnythingElse) {
    expect_independent(Stands(1).traits());
}

TEST(Chance, NothingAboutWhoStandsTellsAnythingElse) {
    expect_independent(grounds().traits());
}

TEST(Chance, NeighboursAreNotAlike) {
    for (const Traits& traits : {Stands(1).traits(), grounds().traits()}) {
        for (const auto& [name, values] : traits) {
            if (name == "row") continue;
            const std::vector<double> left(values.begin(), values.end() - 1), right(values.begin() + 1, values.end());
            EXPECT_LT(tests::dependence(left, right), tests::chance) << name;
        }
    }
}

TEST(Chance, AnotherSeedDrawsEverythingAnew) {
    const Stands one(1), other(2);
    std::map<std::pair<float, float>, std::size_t> places;
    for (std::size_t i = 0; i < one.crowd.size(); ++i)
        if (one.crowd.role[i] == Role::spectator) places[{one.crowd.position[i].x, one.crowd.position[i].z}] = i;
    Traits before, after;
    for (std::size_t i = 0; i < other.crowd.size(); ++i) {
        const auto found = places.find({other.crowd.position[i].x, other.crowd.position[i].z});
        if (other.crowd.role[i] != Role::spectator || found == places.end()) continue;
        add_common(before, one.crowd, found->second);
        add_common(after, other.crowd, i);
        before["yaw"].push_back(one.yaw_from_seat(found->second));
        after["yaw"].push_back(other.yaw_from_seat(i));
    }
    ASSERT_LT(before["yaw"].size(), 19800u) << "the same seats are taken";
    for (const auto& [name, values] : before) {
        EXPECT_LT(tests::dependence(values, after[name]), tests::chance) << name;
    }
    const Grounds elsewhere(60'000, 2), here(60'000, 1);
    std::set<std::pair<float, float>> taken;
    for (const std::size_t i : here.people) taken.insert({here.crowd.position[i].x, here.crowd.position[i].z});
    for (const std::size_t i : elsewhere.people) {
        EXPECT_FALSE(taken.contains({elsewhere.crowd.position[i].x, elsewhere.crowd.position[i].z}));
    }
    int same_lap = 0;
    for (std::size_t i = 0; i < 200; ++i) same_lap += one.crowd.position[i].z == other.crowd.position[i].z;
    EXPECT_LT(same_lap, 3);
}

TEST(Chance, HardlyAnyTwoShareTheirBits) {
    // 200,000 draws of 32 bits have 4.7 pairs on average.
    constexpr std::size_t pairs = 20;
    const std::vector<std::uint32_t>& hash = grounds().crowd.hash;
    EXPECT_GE(std::set<std::uint32_t>(hash.begin(), hash.end()).size() + pairs, hash.size());
}

// ---- On the stands ----

TEST(Spectators, LookWhereTheirSeatFacesGiveOrTakeAFewDegrees) {
    constexpr double most = 0.12;  // [rad]
    const std::vector<double> yaw = Stands(1).traits()["yaw"];
    const auto [low, high] = std::minmax_element(yaw.begin(), yaw.end());
    EXPECT_GE(*low, -most);
    EXPECT_LE(*high, most);
    EXPECT_LT(*low, -0.9 * most);
    EXPECT_GT(*high, 0.9 * most);
    // Of a triangle's distribution.
    EXPECT_NEAR(tests::deviation(yaw), most / std::sqrt(6.0), 0.002);
    EXPECT_NEAR(tests::mean(yaw), 0, 0.002);
}

TEST(Spectators, LookAtThePitch) {
    const Stands stands(1);
    for (std::size_t i = 0; i < stands.crowd.size(); ++i) {
        if (stands.crowd.role[i] != Role::spectator) continue;
        const glm::vec2 xz(stands.crowd.position[i].x, stands.crowd.position[i].z);
        const glm::vec2 ahead(std::sin(stands.crowd.yaw[i]), std::cos(stands.crowd.yaw[i]));
        // Ten metres on they are nearer to the pitch by nearly as much.
        ASSERT_GT(stands.plan.oval.offset_of(xz) - stands.plan.oval.offset_of(xz + 10.0f * ahead), 9.5f);
    }
}

TEST(Spectators, LeaveSeatsFreeAnywhereAndAtRandom) {
    const Stands stands(1);
    std::vector<std::int64_t> by_row(stands.plan.rows.size(), 0), seats_by_row = by_row;
    std::vector<std::int64_t> by_section(stands.plan.spokes.size(), 0), seats_by_section = by_section;
    for (std::size_t i = 0; i < stands.crowd.size(); ++i) {
        if (stands.crowd.role[i] != Role::spectator) continue;
        ++by_row[stands.seat(i).row];
        ++by_section[stands.seat(i).section];
    }
    for (const Seat& seat : stands.plan.seats) {
        ++seats_by_row[seat.row];
        ++seats_by_section[seat.section];
    }
    const double share = 19800.0 / static_cast<double>(stands.plan.seats.size());
    ASSERT_LT(share, 0.99);
    const auto surprise = [&](const std::vector<std::int64_t>& taken, const std::vector<std::int64_t>& of) {
        double chi_square = 0;
        for (std::size_t k = 0; k < of.size(); ++k) {
            const double expected = share * static_cast<double>(of[k]);
            const double miss = static_cast<double>(taken[k]) - expected;
            chi_square += miss * miss / (expected * (1 - share));
        }
        return tests::deviations(chi_square, static_cast<double>(of.size()) - 1);
    };
    EXPECT_LT(surprise(by_row, seats_by_row), tests::chance);
    EXPECT_LT(surprise(by_section, seats_by_section), tests::chance);
}

TEST(Spectators, NoTwoShareASeat) {
    const Stands stands(1);
    std::set<std::pair<float, float>> taken;
    for (std::size_t i = 0; i < stands.crowd.size(); ++i) {
        if (stands.crowd.role[i] != Role::spectator) continue;
        EXPECT_TRUE(taken.insert({stands.crowd.position[i].x, stands.crowd.position[i].z}).second);
    }
}

TEST(Spectators, FewSitAroundTheMiddleOfTheMainStandWithSomeSeatsFree) {
    constexpr std::int64_t people = 1500;
    const Stands stands(3, people);
    std::set<std::pair<float, float>> taken;
    glm::vec3 middle(0);
    for (std::size_t i = 0; i < stands.crowd.size(); ++i) {
        if (stands.crowd.role[i] != Role::spectator) continue;
        taken.insert({stands.crowd.position[i].x, stands.crowd.position[i].z});
        middle += stands.seat(i).position;
    }
    const double count = static_cast<double>(taken.size());
    middle /= static_cast<float>(count);
    EXPECT_NEAR(middle.x, 0.0f, 1.0f);
    EXPECT_GT(middle.z, stands.plan.oval.radius + stands.plan.stand_offset);
    // Around a place a third of the way up the rows, nobody is out of a circle in which nearly every seat is taken.
    const scene::Row& row = stands.plan.rows[stands.plan.rows.size() / 3];
    const glm::vec3 focus(0, row.floor, stands.plan.oval.radius + row.offset);
    float radius = 0;
    for (const Seat& seat : stands.plan.seats)
        if (taken.contains({seat.position.x, seat.position.z}))
            radius = std::max(radius, glm::distance(seat.position, focus));
    double within = 0;
    for (const Seat& seat : stands.plan.seats) within += glm::distance(seat.position, focus) <= radius;
    EXPECT_NEAR(count / within, 0.92, 0.01);
}

// ---- On the ground ----

TEST(Standing, EverybodyFacesTheCentreMoreOrLess) {
    constexpr double most = 0.6;  // [rad]
    const std::vector<double> yaw = grounds().traits()["yaw"];
    const auto [low, high] = std::minmax_element(yaw.begin(), yaw.end());
    EXPECT_GE(*low, -most - 1e-5);
    EXPECT_LE(*high, most + 1e-5);
    EXPECT_NEAR(tests::deviation(yaw), most / std::sqrt(6.0), 0.005);
    EXPECT_NEAR(tests::mean(yaw), 0, 0.005);
}

TEST(Standing, NobodyTurnsTheirBackOnThePitch) {
    for (const std::size_t i : grounds().people) {
        const glm::vec3 position = grounds().crowd.position[i];
        const glm::vec2 inward = -glm::normalize(glm::vec2(position.x, position.z));
        const float yaw = grounds().crowd.yaw[i];
        ASSERT_GT(glm::dot(inward, glm::vec2(std::sin(yaw), std::cos(yaw))), 0.8f);
    }
}

TEST(Standing, NobodyStandsInARankOrAFile) {
    constexpr double most = 0.15;  // [m] each way and axis
    const Traits traits = grounds().traits();
    for (const char* axis : {"x", "z"}) {
        const std::vector<double>& off = traits.at(axis);
        const auto [low, high] = std::minmax_element(off.begin(), off.end());
        constexpr double rounding = 1e-3;  // [m] of floats some hundred metres out
        EXPECT_GE(*low, -most - rounding);
        EXPECT_LE(*high, most + rounding);
        EXPECT_NEAR(tests::deviation(off), most / std::sqrt(3.0), 0.002);
        EXPECT_NEAR(tests::mean(off), 0, 0.002);
    }
}

TEST(Standing, FourInFivePlacesAreTaken) {
    constexpr double margin = 1.5;  // [m] inside the track
    const StadiumPlan& plan = grounds().plan;
    const double radius = static_cast<double>(plan.oval.radius) - margin;
    const double area = pi * radius * radius + 4 * static_cast<double>(plan.oval.half_straight) * radius;
    double infield = 0;
    for (const std::size_t i : grounds().people) infield += grounds().offset(i) < 0;
    EXPECT_NEAR(infield * pitch * pitch / area, 0.8, 0.02);
}

TEST(Standing, KeepsOffTheTrackAndTheWall) {
    for (const std::size_t i : grounds().people) {
        const float offset = grounds().offset(i);
        ASSERT_TRUE(offset < -1.49f || offset > grounds().plan.outer_offset + 2.4f) << offset;
    }
    const auto near = [&](float from, float to) {
        return std::count_if(grounds().people.begin(), grounds().people.end(),
                             [&](std::size_t i) { return grounds().offset(i) > from && grounds().offset(i) < to; });
    };
    EXPECT_GT(near(-2.0f, -1.5f), 50) << "nobody stands at the track";
    EXPECT_GT(near(grounds().plan.outer_offset + 2.5f, grounds().plan.outer_offset + 3.0f), 50);
    EXPECT_GT(near(-36.5f, -34.0f), 50) << "nobody stands in the middle";
}

// Share of the grid's places taken in square windows of the infield.
struct Window {
    double share;
    int x, z;
};

std::vector<Window> infield_windows(int places) {
    const auto index = [&](float at) {
        return static_cast<int>(std::floor(at / (pitch * static_cast<float>(places))));
    };
    std::map<std::pair<int, int>, int> counts;
    for (const std::size_t i : grounds().people) {
        const glm::vec3 at = grounds().crowd.position[i];
        if (grounds().offset(i) < 0) ++counts[{index(at.x), index(at.z)}];
    }
    std::vector<Window> result;
    for (const auto& [where, count] : counts) {
        const float low_x = static_cast<float>(where.first * places) * pitch;
        const float low_z = static_cast<float>(where.second * places) * pitch;
        float offset = -100;
        for (const float dx : {0.0f, 1.0f})
            for (const float dz : {0.0f, 1.0f})
                offset =
                    std::max(offset, grounds().plan.oval.offset_of({low_x + dx * pitch * static_cast<float>(places),
                                                                    low_z + dz * pitch * static_cast<float>(places)}));
        if (offset < -2) result.push_back({static_cast<double>(count) / (places * places), where.first, where.second});
    }
    return result;
}

// Correlation of the shares of windows `dx`, `dz` apart, of those that `asked` picks.
double alike(
    const std::vector<Window>& windows, int dx, int dz,
    const std::function<bool(const Window&)>& asked = [](const Window&) { return true; }) {
    std::map<std::pair<int, int>, double> shares;
    for (const Window& window : windows) shares[{window.x, window.z}] = window.share;
    std::vector<double> here, there;
    for (const Window& window : windows) {
        const auto found = shares.find({window.x + dx, window.z + dz});
        if (found == shares.end() || !asked(window)) continue;
        here.push_back(window.share);
        there.push_back(found->second);
    }
    return tests::correlation(here, there);
}

TEST(Standing, PeopleClusterOverSomeMetres) {
    constexpr int places = 6;  // 4.5 m
    const std::vector<Window> windows = infield_windows(places);
    ASSERT_GT(windows.size(), 300u);
    std::vector<double> shares;
    for (const Window& window : windows) shares.push_back(window.share);
    // Independent places would differ by the root of 0.8 * 0.2 / 36 = 0.067.
    EXPECT_GT(tests::deviation(shares), 0.085);
    const double most = *std::max_element(shares.begin(), shares.end());
    const double least = *std::min_element(shares.begin(), shares.end());
    EXPECT_GT(most, 0.95);
    EXPECT_LT(least, 0.65);
    EXPECT_GT(least, 0.4) << "a hole in the crowd";
    // Next to a cluster is the rest of it, whichever way; 27 m on is another.
    EXPECT_GT(alike(windows, 1, 0), 0.2);
    EXPECT_GT(alike(windows, 0, 1), 0.2);
    // ... smoothly, also where the noise's cells of 9 m meet.
    EXPECT_GT(alike(windows, 1, 0, [](const Window& window) { return window.x % 2 != 0; }), 0.35);
    EXPECT_GT(alike(windows, 0, 1, [](const Window& window) { return window.z % 2 != 0; }), 0.35);
    EXPECT_LT(std::abs(alike(windows, 6, 0)), 0.2);
    EXPECT_LT(std::abs(alike(windows, 0, 6)), 0.2);
}

TEST(Standing, ThoseWhoComeFirstTakeTheInnermostPlaces) {
    constexpr float ring = 0.26f;  // [m] within which order doesn't show
    const StadiumPlan plan = scene::plan_stadium(200'000);
    const FakeCast cast = tests::sitters();
    const auto standing = [&](std::int64_t people) {
        std::map<std::pair<float, float>, float> offsets;
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            const glm::vec3 at = crowd.position[i];
            if (crowd.role[i] == Role::standing) offsets[{at.x, at.z}] = plan.oval.offset_of({at.x, at.z});
        }
        return offsets;
    };
    const auto seats = static_cast<std::int64_t>(plan.seats.size());
    const auto all = standing(200'000);
    for (const std::int64_t wanted : {40, 3000, 30'000}) {
        const auto few = standing(seats + 200 + wanted);
        EXPECT_EQ(few.size(), static_cast<std::size_t>(wanted));
        float outermost = -100;
        for (const auto& [where, offset] : few) {
            EXPECT_TRUE(all.contains(where));
            outermost = std::max(outermost, offset);
        }
        for (const auto& [where, offset] : all) {
            if (offset < outermost - ring) {
                ASSERT_TRUE(few.contains(where)) << wanted << " stand";
            }
        }
    }
}

TEST(Standing, ReachesAboutAsFarAsThePlanSays) {
    constexpr float tolerance = 3.0f;  // [m] densities are known on average only
    const FakeCast cast = tests::sitters();
    for (const std::int64_t people : {std::int64_t{120'000}, std::int64_t{400'000}, std::int64_t{1'000'000}}) {
        const StadiumPlan plan = scene::plan_stadium(people);
        const Crowd crowd = scene::populate(plan, {people, cast.members, cast.poses, 1});
        float outermost = -100;
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            if (crowd.role[i] != Role::standing) continue;
            outermost = std::max(outermost, plan.oval.offset_of({crowd.position[i].x, crowd.position[i].z}));
        }
        EXPECT_NEAR(outermost, plan.crowd_offset, tolerance) << people << " people";
    }
    const StadiumPlan full = scene::plan_stadium(20000);
    EXPECT_EQ(full.crowd_offset, full.outer_offset) << "nobody stands outside";
}

TEST(Standing, WideCharactersStandFurtherApart) {
    tests::FakeCast cast;
    tests::add_stander(cast);
    cast.poses[0].clip_boxes[0] = {{-0.7f, 0, -1.0f}, {0.7f, 1.75f, 1.0f}};
    const scene::Room room = scene::room_for(cast.members, cast.poses);
    const Crowd crowd = scene::populate(scene::plan_stadium(60'000, room), {60'000, cast.members, cast.poses, 1});
    const float apart = (room.width + room.depth) / 2;
    std::set<std::pair<int, int>> taken;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (crowd.role[i] != Role::standing) continue;
        const auto cell = [&](float at) { return static_cast<int>(std::floor(at / apart)); };
        EXPECT_TRUE(taken.insert({cell(crowd.position[i].x), cell(crowd.position[i].z)}).second);
    }
    EXPECT_GT(taken.size(), 1000u);
}

// ---- On the track ----

constexpr float lane_width = 1.22f;  // [m]

struct Runner {
    float lane_offset, arc, height;
    std::uint8_t character;
    Role role;
};

// By their distance from the inner line: a file runs behind one another.
std::map<float, std::vector<Runner>> files_of(const Crowd& crowd) {
    std::map<float, std::vector<Runner>> files;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (crowd.role[i] != Role::walker && crowd.role[i] != Role::runner) continue;
        const glm::vec3 at = crowd.position[i];
        files[at.x].push_back({at.x, at.z, crowd.height[i], crowd.character[i], crowd.role[i]});
    }
    for (auto& [offset, file] : files)
        std::sort(file.begin(), file.end(), [](const Runner& a, const Runner& b) { return a.arc < b.arc; });
    return files;
}

TEST(Athletes, RunTwoAbreastInEachLaneClearOfItsLines) {
    constexpr float from_line = 0.3f, abreast = 0.5f;  // [m] half a pair of shoulders, and a whole one
    const FakeCast cast = two_kinds_of_sitters();
    const auto files = files_of(tests::populate(cast, 20000));
    ASSERT_EQ(files.size(), 16u);
    float previous = -1;
    for (const auto& [offset, file] : files) {
        const float in_lane = offset - lane_width * std::floor(offset / lane_width);
        EXPECT_GT(in_lane, from_line);
        EXPECT_LT(in_lane, lane_width - from_line);
        EXPECT_GT(offset - previous, abreast);
        previous = offset;
    }
}

TEST(Athletes, AFileIsOfOneKindSoThatNobodyCatchesUp) {
    const FakeCast cast = two_kinds_of_sitters();
    std::set<float> heights;
    std::set<int> characters;
    int runner_files = 0;
    for (const auto& [offset, file] : files_of(tests::populate(cast, 20000))) {
        for (const Runner& runner : file) {
            EXPECT_EQ(runner.height, file[0].height);
            EXPECT_EQ(runner.character, file[0].character);
            EXPECT_EQ(runner.role, file[0].role);
        }
        heights.insert(file[0].height);
        characters.insert(file[0].character);
        runner_files += file[0].role == Role::runner;
    }
    EXPECT_EQ(heights.size(), 16u) << "files look alike";
    EXPECT_EQ(characters.size(), 2u);
    EXPECT_EQ(runner_files, 10);
}

TEST(Athletes, KeepTheirDistanceInTheFileAllAround) {
    constexpr float clear = 0.3f, rounding = 0.01f;  // of the mean distance; [m]
    const FakeCast cast = two_kinds_of_sitters();
    for (const std::int64_t people : {1600, 5000, 9900, 20000}) {
        const Crowd crowd = tests::populate(cast, people);
        for (const auto& [offset, file] : files_of(crowd)) {
            const float lap = crowd.path->length(offset), mean = lap / static_cast<float>(file.size());
            for (std::size_t i = 0; i < file.size(); ++i) {
                ASSERT_GE(file[i].arc, 0.0f);
                ASSERT_LT(file[i].arc, lap);
                const float to_next =
                    i + 1 < file.size() ? file[i + 1].arc - file[i].arc : file[0].arc + lap - file[i].arc;
                EXPECT_GE(to_next, clear * mean - rounding) << people << " people";
                EXPECT_LE(to_next, (2 - clear) * mean + rounding) << people << " people";
            }
        }
    }
}

TEST(Athletes, AreSpreadOverFilesAndLanesEvenIfFew) {
    const FakeCast cast = two_kinds_of_sitters();
    const auto few = files_of(tests::populate(cast, 1600)), some = files_of(tests::populate(cast, 20000));
    EXPECT_EQ(few.size(), 16u) << "sixteen athletes share a file";
    for (const auto& [offset, file] : some) EXPECT_NEAR(static_cast<double>(file.size()), 200.0 / 16, 1.0);
    std::set<int> lanes;
    for (const auto& [offset, file] : files_of(tests::populate(cast, 400)))
        lanes.insert(static_cast<int>(offset / lane_width));
    EXPECT_EQ(lanes.size(), 4u) << "four athletes share a lane";
}

TEST(Athletes, ArePlacedAtRandomAroundTheLap) {
    const FakeCast cast = two_kinds_of_sitters();
    std::vector<std::int64_t> eighths(8, 0);
    std::vector<double> gaps;
    std::set<int> starts;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Crowd crowd = tests::populate(cast, 20000, seed);
        for (const auto& [offset, file] : files_of(crowd)) {
            const double lap = crowd.path->length(offset), mean = lap / static_cast<double>(file.size());
            starts.insert(static_cast<int>(8 * file[0].arc / mean));
            for (std::size_t i = 0; i < file.size(); ++i) {
                ++eighths[static_cast<std::size_t>(8 * file[i].arc / lap)];
                if (i > 0) gaps.push_back((file[i].arc - file[i - 1].arc) / mean);
            }
        }
    }
    EXPECT_LT(tests::unevenness(eighths), tests::chance);
    // The difference of two even draws from 0.7 of a distance.
    EXPECT_NEAR(tests::deviation(gaps), 0.7 / std::sqrt(6.0), 0.03);
    EXPECT_GE(starts.size(), 8u) << "files start level";
}

// ---- Boxes ----

// All that somebody may touch at a tick, from the corners of their character's box.
motion::Bounds touched(const Crowd& crowd, const FakeCast& cast, std::size_t person, std::int64_t tick) {
    const motion::PoseTable& table = cast.poses[crowd.character[person]];
    const scene::Placement at = scene::place(crowd, person, cast.members[crowd.character[person]], tick);
    const float scale = crowd.height[person] / table.rest_height;
    const glm::vec3 ahead(std::sin(at.yaw), 0, std::cos(at.yaw)), left(std::cos(at.yaw), 0, -std::sin(at.yaw));
    std::vector<glm::vec3> corners;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 local(corner & 1 ? table.box.max.x : table.box.min.x,
                              corner & 2 ? table.box.max.y : table.box.min.y,
                              corner & 4 ? table.box.max.z : table.box.min.z);
        corners.push_back(at.position + scale * (local.x * left + local.z * ahead + glm::vec3(0, local.y, 0)));
    }
    return motion::bounds_of(corners);
}

TEST(Blocks, BoxesOfThoseWhoStayFitWithinTwoCentimetres) {
    constexpr float loose = 0.02f, rounding = 0.005f;  // [m] room for a shader that turns and scales in another order
    const FakeCast cast = tests::sitters_and_standers();
    const Crowd crowd = tests::populate(cast, 100'000);
    for (const scene::CrowdBlock& block : crowd.blocks) {
        if (crowd.role[block.first] == Role::walker || crowd.role[block.first] == Role::runner) continue;
        motion::Bounds all = touched(crowd, cast, block.first, 0);
        for (std::uint32_t i = block.first; i < block.first + block.count; ++i) {
            const motion::Bounds one = touched(crowd, cast, i, 0);
            all = {glm::min(all.min, one.min), glm::max(all.max, one.max)};
        }
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LE(block.box.min[axis], all.min[axis] - rounding);
            ASSERT_GE(block.box.max[axis], all.max[axis] + rounding);
            ASSERT_GE(block.box.min[axis], all.min[axis] - loose);
            ASSERT_LE(block.box.max[axis], all.max[axis] + loose);
        }
    }
}

TEST(Blocks, BoxesOfAthletesHoldWholeLapsAndLittleMore) {
    constexpr float loose = 0.6f;  // [m] somebody turned any way
    const FakeCast cast = tests::sitters_and_standers();
    const Crowd crowd = tests::populate(cast, 20000);
    int blocks = 0;
    for (const scene::CrowdBlock& block : crowd.blocks) {
        if (crowd.role[block.first] != Role::walker && crowd.role[block.first] != Role::runner) continue;
        ++blocks;
        motion::Bounds all = touched(crowd, cast, block.first, 0);
        for (std::uint32_t i = block.first; i < block.first + block.count; ++i) {
            for (std::int64_t tick = 0; tick < 8 * 3600; tick += 20) {
                const motion::Bounds one = touched(crowd, cast, i, tick);
                all = {glm::min(all.min, one.min), glm::max(all.max, one.max)};
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LE(block.box.min[axis], all.min[axis]);
            ASSERT_GE(block.box.max[axis], all.max[axis]);
            ASSERT_GE(block.box.min[axis], all.min[axis] - (axis == 1 ? 0.02f : loose));
            ASSERT_LE(block.box.max[axis], all.max[axis] + (axis == 1 ? 0.02f : loose));
        }
    }
    EXPECT_EQ(blocks, 2);
}

bool is_red(glm::u8vec4 shirt) {
    return shirt.x > 170 && shirt.y < 80 && shirt.z < 80;
}

bool is_yellow(glm::u8vec4 shirt) {
    return shirt.x > 220 && shirt.y > 180 && shirt.z < 110;
}

TEST(Fans, FillTheirEnds) {
    const Stands stands(1);
    int red = 0, home_end = 0, yellow = 0, away_end = 0, yellow_at_home = 0;
    for (std::size_t i = 0; i < stands.crowd.size(); ++i) {
        if (stands.crowd.role[i] != Role::spectator) continue;
        const glm::vec3 at = stands.crowd.position[i];
        const glm::u8vec4 shirt = stands.crowd.palette[i][scene::shirt_slot];
        if (at.x > stands.plan.oval.half_straight) {
            ++home_end;
            red += is_red(shirt);
            yellow_at_home += is_yellow(shirt);
        } else if (at.x < -stands.plan.oval.half_straight && at.z < 0) {
            ++away_end;
            yellow += is_yellow(shirt);
        }
    }
    EXPECT_GT(red, home_end / 2);
    EXPECT_LT(yellow_at_home, home_end / 20);
    EXPECT_GT(yellow, away_end / 2);
}

TEST(Fans, MixOnTheGroundAndOnTheTrack) {
    // Three in four of a team's shirts are red or yellow, and one in sixteen of all others is yellow too.
    constexpr double worn = 0.75, others = 1.0 / 16;
    double red = 0, yellow = 0;
    for (const std::size_t i : grounds().people) {
        red += is_red(grounds().crowd.palette[i][scene::shirt_slot]);
        yellow += is_yellow(grounds().crowd.palette[i][scene::shirt_slot]);
    }
    const double standing = static_cast<double>(grounds().people.size());
    EXPECT_NEAR(red / standing, worn * 0.3, 0.01);
    EXPECT_NEAR(yellow / standing, worn * 0.1 + others * 0.6, 0.01);
    const FakeCast cast = tests::sitters();
    double athletes = 0;
    red = yellow = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Crowd crowd = tests::populate(cast, 20000, seed);
        for (std::size_t i = 0; i < 200; ++i, ++athletes) {
            red += is_red(crowd.palette[i][scene::shirt_slot]);
            yellow += is_yellow(crowd.palette[i][scene::shirt_slot]);
        }
    }
    EXPECT_NEAR(red / athletes, worn * 0.4, 0.04) << "the home team's";
    EXPECT_NEAR(yellow / athletes, worn * 0.4 + others * 0.2, 0.04) << "the guests'";
}

}  // namespace
