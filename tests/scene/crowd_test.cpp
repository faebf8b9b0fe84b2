#include "scene/crowd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sfsm/random.h"
#include "tests/scene/fake_cast.h"
#include "tests/scene/spacing.h"

namespace {

using scene::Crowd;
using scene::CrowdBlock;
using scene::Role;
using tests::FakeCast;

constexpr std::int64_t sizes[] = {1, 2, 99, 100, 5000, 20000, 70000, 200000};
constexpr float track_width = 8 * 1.22f;  // [m]
constexpr float seat_shift = 0.43f;       // [m] from a seat's middle to who stands in front of it

bool is_athlete(Role role) {
    return role == Role::walker || role == Role::runner;
}

// FNV-1a over everything that is kept of a person.
std::uint64_t fingerprint(const Crowd& crowd) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](const auto& values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (std::size_t i = 0; i < values.size() * sizeof(values[0]); ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    };
    add(crowd.position);
    add(crowd.yaw);
    add(crowd.height);
    add(crowd.character);
    add(crowd.role);
    add(crowd.around);
    add(crowd.hash);
    add(crowd.palette);
    return hash;
}

std::vector<glm::vec3> places(const Crowd& crowd, const FakeCast& cast, std::int64_t tick) {
    std::vector<glm::vec3> result;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        result.push_back(scene::place(crowd, i, cast.members[crowd.character[i]], tick).position);
    }
    return result;
}

TEST(Populate, MakesExactlyAsManyAsAsked) {
    const FakeCast cast = tests::sitters_and_standers();
    for (const std::int64_t people : sizes) {
        const Crowd crowd = tests::populate(cast, people);
        const std::size_t count = static_cast<std::size_t>(people);
        EXPECT_EQ(crowd.size(), count);
        EXPECT_EQ(crowd.yaw.size(), count);
        EXPECT_EQ(crowd.height.size(), count);
        EXPECT_EQ(crowd.character.size(), count);
        EXPECT_EQ(crowd.role.size(), count);
        EXPECT_EQ(crowd.around.size(), count);
        EXPECT_EQ(crowd.hash.size(), count);
        EXPECT_EQ(crowd.palette.size(), count);
    }
}

TEST(Populate, EveryNumberOfPeopleFindsPlaces) {
    const FakeCast cast = tests::sitters();
    for (std::int64_t people = 1; people < 400'000; people = people * 3 / 2 + 1) {
        EXPECT_EQ(tests::populate(cast, people).size(), static_cast<std::size_t>(people));
    }
}

TEST(Populate, DependsOnTheSeedAlone) {
    const FakeCast cast = tests::sitters_and_standers();
    for (const std::int64_t people : {std::int64_t{100}, std::int64_t{20000}, std::int64_t{100000}}) {
        EXPECT_EQ(fingerprint(tests::populate(cast, people, 7)), fingerprint(tests::populate(cast, people, 7)));
        EXPECT_NE(fingerprint(tests::populate(cast, people, 7)), fingerprint(tests::populate(cast, people, 8)));
    }
}

TEST(Populate, BlocksPartitionThePeople) {
    constexpr std::uint32_t largest = 512;
    const FakeCast cast = tests::sitters();
    for (const std::int64_t people : sizes) {
        const Crowd crowd = tests::populate(cast, people);
        std::uint32_t next = 0;
        for (const CrowdBlock& block : crowd.blocks) {
            ASSERT_EQ(block.first, next);
            ASSERT_GT(block.count, 0u);
            ASSERT_LE(block.count, largest);
            next += block.count;
        }
        EXPECT_EQ(next, crowd.size());
    }
}

TEST(Populate, BlocksAreLargeAndCompactEnoughToBeWorthSkipping) {
    constexpr double mean_count = 128;
    constexpr float widest = 40.0f;  // [m]
    const FakeCast cast = tests::sitters();
    for (const std::int64_t people : {std::int64_t{20000}, std::int64_t{200000}}) {
        const Crowd crowd = tests::populate(cast, people);
        EXPECT_GE(static_cast<double>(people) / static_cast<double>(crowd.blocks.size()), mean_count);
        for (const CrowdBlock& block : crowd.blocks) {
            if (!is_athlete(crowd.role[block.first])) {
                ASSERT_LT(glm::length(block.box.size()), widest);
            }
        }
    }
}

TEST(Populate, BlocksHoldAllThatTheirPeopleTouchAtAnyTick) {
    const FakeCast cast = tests::sitters_and_standers();
    const Crowd crowd = tests::populate(cast, 100'000);
    std::uint64_t bits = 3;
    for (const CrowdBlock& block : crowd.blocks) {
        for (int trial = 0; trial < 50; ++trial) {
            bits = sfsm::mix(bits);
            const std::size_t person = block.first + sfsm::below(bits, block.count);
            const std::int64_t tick = sfsm::below(sfsm::mix(bits), 1'000'000);
            const motion::PoseTable& table = cast.poses[crowd.character[person]];
            const scene::Placement at = scene::place(crowd, person, cast.members[crowd.character[person]], tick);
            const float scale = crowd.height[person] / table.rest_height;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 local = scale * glm::vec3(corner & 1 ? table.box.max.x : table.box.min.x,
                                                          corner & 2 ? table.box.max.y : table.box.min.y,
                                                          corner & 4 ? table.box.max.z : table.box.min.z);
                const float c = std::cos(at.yaw), s = std::sin(at.yaw);
                const glm::vec3 world =
                    at.position + glm::vec3(c * local.x + s * local.z, local.y, c * local.z - s * local.x);
                ASSERT_EQ(glm::clamp(world, block.box.min, block.box.max), world) << "person " << person;
            }
        }
    }
}

TEST(Populate, NobodyOverlapsEver) {
    constexpr float least = 0.449f;  // [m] shoulders
    for (const FakeCast& cast : {tests::sitters(), tests::sitters_and_standers()}) {
        for (const std::int64_t people : {std::int64_t{20000}, std::int64_t{200000}}) {
            const Crowd crowd = tests::populate(cast, people);
            for (const std::int64_t tick : {std::int64_t{0}, std::int64_t{10'007}, std::int64_t{100'000'000}}) {
                EXPECT_GE(tests::least_distance(places(crowd, cast, tick), 1.0f), least);
            }
        }
    }
}

TEST(Populate, OnlyAthletesUseTheTrack) {
    const FakeCast cast = tests::sitters_and_standers();
    for (const std::int64_t people : sizes) {
        const Crowd crowd = tests::populate(cast, people);
        for (const std::int64_t tick : {std::int64_t{0}, std::int64_t{77'777}}) {
            const std::vector<glm::vec3> at = places(crowd, cast, tick);
            for (std::size_t i = 0; i < crowd.size(); ++i) {
                const float offset = scene::Oval().offset_of({at[i].x, at[i].z});
                ASSERT_EQ(is_athlete(crowd.role[i]), offset > -0.5f && offset < track_width + 0.5f);
                if (is_athlete(crowd.role[i])) {
                    ASSERT_TRUE(offset > 0.2f && offset < track_width - 0.2f);
                }
            }
        }
    }
}

TEST(Populate, RunnersHaveTheInnerLanes) {
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 20000);
    float outermost_runner = 0, innermost_walker = track_width;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (crowd.role[i] == Role::runner) outermost_runner = std::max(outermost_runner, crowd.position[i].x);
        if (crowd.role[i] == Role::walker) innermost_walker = std::min(innermost_walker, crowd.position[i].x);
    }
    EXPECT_GT(outermost_runner, 0.0f);
    EXPECT_LT(outermost_runner, innermost_walker);
}

TEST(Populate, OneInAHundredIsAnAthleteAndAtMostTwoHundred) {
    const FakeCast cast = tests::sitters();
    for (const auto& [people, athletes] : {std::pair{99, 0}, {100, 1}, {5000, 50}, {20000, 200}, {200000, 200}}) {
        const Crowd crowd = tests::populate(cast, people);
        EXPECT_EQ(std::count_if(crowd.role.begin(), crowd.role.end(), is_athlete), athletes);
    }
}

TEST(Populate, SpectatorsTakeSeatsAndRestOnThemWhateverTheirSize) {
    constexpr float tolerance = 1e-3f, seat_height = 0.45f;  // [m]
    constexpr std::size_t tried = 2000;                      // each is compared with every seat
    const FakeCast cast = tests::sitters_and_standers();
    const scene::StadiumPlan plan = scene::plan_stadium(20000);
    const Crowd crowd = scene::populate(plan, {20000, cast.members, cast.poses, 5});
    for (std::size_t i = 0; i < tried; ++i) {
        if (crowd.role[i] != Role::spectator) continue;
        const bool sits = cast.members[crowd.character[i]].sits;
        const float scale = crowd.height[i] / cast.poses[crowd.character[i]].rest_height;
        float least = 1.0f;
        for (const scene::Seat& seat : plan.seats) {
            const glm::vec3 forward(std::sin(seat.yaw), 0, std::cos(seat.yaw));
            const glm::vec3 seated = crowd.position[i] + glm::vec3(0, seat_height * scale - seat_height, 0);
            const glm::vec3 standing = crowd.position[i] - seat_shift * forward;
            least = std::min(least, glm::distance(seat.position, sits ? seated : standing));
        }
        ASSERT_LT(least, tolerance) << "person " << i;
    }
}

TEST(Populate, ASmallCrowdSitsTogether) {
    constexpr float radius = 8.0f;  // [m]
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 100);
    glm::vec3 middle(0);
    int spectators = 0;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (crowd.role[i] != Role::spectator) continue;
        middle += crowd.position[i];
        ++spectators;
    }
    middle /= static_cast<float>(spectators);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (crowd.role[i] == Role::spectator) {
            EXPECT_LT(glm::distance(crowd.position[i], middle), radius);
        }
    }
}

TEST(Populate, HeightsAreThoseOfAdults) {
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 20000);
    double sum = 0, squares = 0;
    for (const float height : crowd.height) {
        ASSERT_GE(height, 1.5f);
        ASSERT_LE(height, 2.0f);
        sum += height;
        squares += static_cast<double>(height) * height;
    }
    const double count = static_cast<double>(crowd.size()), mean = sum / count;
    EXPECT_NEAR(mean, 1.70, 0.005);
    EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.09, 0.005);
}

TEST(Populate, EveryCharacterOfTheCastAppears) {
    const FakeCast cast = tests::sitters_and_standers();
    const Crowd crowd = tests::populate(cast, 20000);
    const double standers = static_cast<double>(std::count(crowd.character.begin(), crowd.character.end(), 1));
    EXPECT_NEAR(standers / 20000, 0.5, 0.02);
}

TEST(Place, AthletesRunAtTheirSpeedInClosedForm) {
    constexpr std::int64_t hours = 10, tick = hours * 3600 * 60;
    constexpr float tolerance = 2e-3f;  // [m] an arc of some hundred metres in float
    const FakeCast cast = tests::sitters_and_standers();
    const Crowd crowd = tests::populate(cast, 20000);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (!is_athlete(crowd.role[i])) continue;
        const scene::CastMember& member = cast.members[crowd.character[i]];
        const double speed = static_cast<double>(member.gait_speed[static_cast<std::size_t>(crowd.role[i])]) *
                             static_cast<double>(crowd.height[i]) / 1.75;
        const double arc = static_cast<double>(crowd.position[i].z) + speed * hours * 3600;
        const double lap = crowd.path->length(crowd.position[i].x);
        const glm::vec2 expected =
            crowd.path->position(static_cast<float>(arc - lap * std::floor(arc / lap)), crowd.position[i].x);
        const scene::Placement at = scene::place(crowd, i, member, tick);
        EXPECT_LT(glm::distance(glm::vec2(at.position.x, at.position.z), expected), tolerance);
        EXPECT_EQ(at.position.y, 0.0f);
    }
}

TEST(Place, AthletesLookWhereTheyRun) {
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 20000);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        if (!is_athlete(crowd.role[i])) continue;
        const scene::Placement before = scene::place(crowd, i, cast.members[0], 1000);
        const scene::Placement after = scene::place(crowd, i, cast.members[0], 1006);
        const glm::vec3 step = glm::normalize(after.position - before.position);
        EXPECT_GT(glm::dot(step, glm::vec3(std::sin(before.yaw), 0, std::cos(before.yaw))), 0.999f);
    }
}

TEST(Place, OthersStayWhereTheyAre) {
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 100'000);
    for (std::size_t i = 0; i < crowd.size(); i += 37) {
        if (is_athlete(crowd.role[i])) continue;
        const scene::Placement at = scene::place(crowd, i, cast.members[0], 123'456);
        EXPECT_EQ(at.position, crowd.position[i]);
        EXPECT_EQ(at.yaw, crowd.yaw[i]);
    }
}

// Two waves and the time around them.
constexpr std::int64_t watched_ticks = 2 * 45 * 60 + 1500;

TEST(Act, ClipTickIsWithinTheClip) {
    const FakeCast cast = tests::sitters_and_standers();
    const Crowd crowd = tests::populate(cast, 80'000);
    std::uint64_t bits = 1;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        const std::uint8_t character = crowd.character[i];
        bits = sfsm::mix(bits);
        for (const std::int64_t tick : {std::int64_t{0}, static_cast<std::int64_t>(bits >> 40), std::int64_t{-5000}}) {
            const scene::Action action = scene::act(crowd, i, cast.members[character], cast.poses[character], tick);
            ASSERT_LT(action.clip, cast.poses[character].clips.size());
            ASSERT_GE(action.clip_tick, 0);
            ASSERT_LT(action.clip_tick, cast.poses[character].clips[action.clip].ticks());
        }
    }
}

TEST(Act, ChangesOnlyWhereClipsMeet) {
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 20000);
    for (std::size_t i = 0; i < crowd.size(); i += 53) {
        if (is_athlete(crowd.role[i])) continue;
        scene::Action previous = scene::act(crowd, i, cast.members[0], cast.poses[0], 0);
        for (std::int64_t tick = 1; tick < watched_ticks; ++tick) {
            const scene::Action next = scene::act(crowd, i, cast.members[0], cast.poses[0], tick);
            const bool goes_on = next.clip == previous.clip && next.clip_tick == previous.clip_tick + 1;
            const bool at_the_seam = previous.clip_tick == 0 || previous.clip_tick == tests::seated_ticks - 1;
            ASSERT_TRUE(goes_on || (at_the_seam && next.clip_tick == 0)) << "person " << i << " at tick " << tick;
            previous = next;
        }
    }
}

TEST(Act, ClipsOfDifferentLengthsAreKeptForEver) {
    FakeCast cast;
    tests::add_stander(cast);
    const Crowd crowd = tests::populate(cast, 20000);
    for (std::size_t i = 0; i < crowd.size(); i += 53) {
        const scene::Action first = scene::act(crowd, i, cast.members[0], cast.poses[0], 0);
        const int length = cast.poses[0].clips[first.clip].ticks();
        for (std::int64_t tick = 1; tick < watched_ticks; tick += 7) {
            const scene::Action action = scene::act(crowd, i, cast.members[0], cast.poses[0], tick);
            ASSERT_EQ(action.clip, first.clip);
            ASSERT_EQ(action.clip_tick, (first.clip_tick + tick) % length);
        }
    }
}

TEST(Act, DependsOnNothingButItsArguments) {
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 20000), again = tests::populate(cast, 20000);
    for (std::size_t i = crowd.size(); i-- > 0;) {
        const std::int64_t tick = static_cast<std::int64_t>(i) * 31 % watched_ticks;
        const scene::Action a = scene::act(crowd, i, cast.members[0], cast.poses[0], tick);
        const scene::Action b = scene::act(again, i, cast.members[0], cast.poses[0], tick);
        ASSERT_EQ(a.clip, b.clip);
        ASSERT_EQ(a.clip_tick, b.clip_tick);
    }
}

// The share of `people` that cheers at `tick`, in step with each other to a second.
double share_cheering(const Crowd& crowd, const FakeCast& cast, const std::vector<std::size_t>& people,
                      std::int64_t tick) {
    int cheering = 0;
    for (const std::size_t i : people) {
        if (scene::act(crowd, i, cast.members[0], cast.poses[0], tick).clip == tests::clip_cheer) ++cheering;
    }
    return static_cast<double>(cheering) / static_cast<double>(people.size());
}

TEST(Act, AWaveGoesAroundTheStadiumInOrder) {
    constexpr int parts = 8;
    constexpr float window = 5.0f;  // [m] of each part that is watched
    constexpr double most = 0.7;
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 20000);
    constexpr float offset = 25.0f;
    std::vector<double> arrivals;
    for (int part = 0; part < parts; ++part) {
        const float arc = crowd.path->length(offset) * (static_cast<float>(part) + 0.5f) / parts;
        const glm::vec2 post = crowd.path->position(arc, offset);
        std::vector<std::size_t> people;
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            if (crowd.role[i] != Role::spectator) continue;
            if (glm::distance(post, glm::vec2(crowd.position[i].x, crowd.position[i].z)) < window) people.push_back(i);
        }
        ASSERT_GT(people.size(), 30u);
        std::vector<std::int64_t> high;
        for (std::int64_t tick = 45 * 60; tick < 2 * 45 * 60; tick += 5) {
            if (share_cheering(crowd, cast, people, tick) > most) high.push_back(tick);
        }
        ASSERT_FALSE(high.empty()) << "part " << part;
        arrivals.push_back(static_cast<double>(std::accumulate(high.begin(), high.end(), std::int64_t{0})) /
                           static_cast<double>(high.size()));
    }
    for (int part = 1; part < parts; ++part) {
        const double delay =
            (arrivals[static_cast<std::size_t>(part)] - arrivals[static_cast<std::size_t>(part - 1)]) / 60;
        EXPECT_GT(delay, 1.0) << "s, part " << part;
        EXPECT_LT(delay, 5.0) << "s, part " << part;
    }
}

TEST(Act, MostAreCalmBetweenWaves) {
    const FakeCast cast = tests::sitters();
    const Crowd crowd = tests::populate(cast, 20000);
    constexpr std::int64_t quiet = 40 * 60;  // after one wave and before the next
    int excited = 0, all = 0;
    for (std::int64_t wave = 0; wave < 20; ++wave) {
        for (std::size_t i = 0; i < crowd.size(); i += 29) {
            if (crowd.role[i] != Role::spectator) continue;
            const scene::Action action = scene::act(crowd, i, cast.members[0], cast.poses[0], wave * 45 * 60 + quiet);
            excited += action.clip != tests::clip_sit;
            ++all;
        }
    }
    EXPECT_GT(excited, all / 20);
    EXPECT_LT(excited, all / 2);
}

TEST(Arrival, GrowsEvenlyFromNobodyToEverybodyAndNobodyLeaves) {
    const FakeCast cast = tests::sitters();
    Crowd crowd = tests::populate(cast, 20000);
    crowd.filled_tick = 1000;
    std::vector<bool> there(crowd.size(), false);
    for (std::int64_t tick = 0; tick <= 1000; tick += 50) {
        std::int64_t count = 0;
        for (std::size_t person = 0; person < crowd.size(); ++person) {
            const bool is_there = scene::has_arrived(crowd, person, tick);
            EXPECT_TRUE(is_there || !there[person]);
            there[person] = is_there;
            count += is_there;
        }
        constexpr double five_sigma = 5 * 71;  // of a binomial count at a half
        EXPECT_NEAR(static_cast<double>(count), 20.0 * static_cast<double>(tick), five_sigma);
        EXPECT_TRUE(tick > 0 || count == 0);
        EXPECT_TRUE(tick < 1000 || count == 20000);
    }
}

// How many there are of each character.
std::vector<double> shares(const Crowd& crowd, std::size_t characters) {
    std::vector<double> shares(characters, 0.0);
    for (const std::uint8_t character : crowd.character)
        shares.at(character) += 1.0 / static_cast<double>(crowd.size());
    return shares;
}

TEST(Crowd, MixesItsCharactersByWeight) {
    tests::FakeCast cast = tests::sitters_and_standers();
    tests::add_sitter(cast);
    const scene::StadiumPlan plan = scene::plan_stadium(20'000);
    const auto mixed = [&](const std::vector<double>& weights) {
        return scene::populate(plan, {20'000, cast.members, cast.poses, 1, {}, weights});
    };
    const std::vector<double> weights{3, 0.5, 1.5};
    const std::vector<double> found = shares(mixed(weights), 3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], weights[i] / 5, 0.02) << i;
    EXPECT_NEAR(shares(mixed({1, 1e6, 1}), 3)[1], 1, 1e-3);
    const std::vector<std::uint8_t> even = mixed({}).character;
    EXPECT_EQ(mixed({2, 2, 2}).character, even) << "equal weights are none";
    for (const double share : shares(mixed({}), 3)) EXPECT_NEAR(share, 1.0 / 3, 0.02);
}

}  // namespace
