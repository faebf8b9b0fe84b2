// What people do: phases, moods and waves, each against the chances and times that the crowd is promised.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>

#include "scene/crowd.h"
#include "tests/scene/fake_cast.h"
#include "tests/scene/statistics.h"

namespace {

using scene::Action;
using scene::Crowd;
using scene::Role;
using tests::FakeCast;

enum Clip : std::uint8_t { sit, fidget, cheer, clap, wave, walk, run };
constexpr std::int64_t clip_ticks = 240, second = 60;

// Two ways to be calm and three to be excited, all of one length.
FakeCast fans(int ticks = clip_ticks) {
    FakeCast cast = tests::sitters();
    for (const Role role : {Role::spectator, Role::standing})
        cast.members[0].acts[static_cast<int>(role)] = {{sit, fidget}, {cheer, clap, wave}};
    cast.members[0].acts[static_cast<int>(Role::walker)].calm = {walk};
    cast.members[0].acts[static_cast<int>(Role::runner)].calm = {run};
    cast.poses = {tests::fake_poses({ticks, ticks, ticks, ticks, ticks, 62, 44})};
    return cast;
}

bool is_excited(const Action& action) {
    return action.clip == cheer || action.clip == clap || action.clip == wave;
}

struct Watched {
    FakeCast cast;
    Crowd crowd;
    explicit Watched(FakeCast of = fans(), std::int64_t people = 20000)
        : cast(std::move(of)), crowd(tests::populate(cast, people)) {}

    Action at(std::size_t i, std::int64_t tick) const {
        return scene::act(crowd, i, cast.members[0], cast.poses[0], tick);
    }
    std::vector<std::size_t> people(Role role) const {
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < crowd.size(); ++i)
            if (crowd.role[i] == role) result.push_back(i);
        return result;
    }
};

const Watched& stands() {
    static const Watched result;
    return result;
}

// More than the stands hold, so that many stand, who know no waves.
const Watched& standing() {
    static const Watched result(fans(), 80'000);
    return result;
}

// How far around the stadium somebody sits, in [0, 1): along the parallel that goes through the middle of the stands.
double lap_of(glm::vec3 position) {
    const scene::Oval oval;
    const double half_straight = oval.half_straight, radius = static_cast<double>(oval.radius) + 28;
    const double half_lap = 2 * half_straight + std::numbers::pi * radius;
    const double x = position.x, z = position.z;
    double arc = 0;
    if (x > half_straight) {
        arc = 2 * half_straight + radius * std::atan2(x - half_straight, z);
    } else if (x < -half_straight) {
        arc = half_lap + 2 * half_straight + radius * std::atan2(-x - half_straight, -z);
    } else {
        arc = z > 0 ? half_straight + x : half_lap + half_straight - x;
    }
    return arc / (2 * half_lap);
}

// ---- Choices and phases ----

TEST(Acts, ThoseOfAMoodArePlayedEquallyOften) {
    std::vector<std::int64_t> counts(5, 0);
    for (const std::size_t i : standing().people(Role::standing))
        for (std::int64_t tick = 0; tick < 40 * clip_ticks; tick += 4 * clip_ticks)
            ++counts[standing().at(i, tick).clip];
    EXPECT_LT(tests::unevenness({counts[sit], counts[fidget]}), tests::chance);
    EXPECT_LT(tests::unevenness({counts[cheer], counts[clap], counts[wave]}), tests::chance);
}

TEST(Acts, PhasesAreSpreadEvenlyOverTheClip) {
    for (const std::int64_t tick : {std::int64_t{0}, std::int64_t{1234}, std::int64_t{777'777}}) {
        std::vector<std::int64_t> counts(24, 0);
        for (const std::size_t i : standing().people(Role::standing))
            ++counts[static_cast<std::size_t>(standing().at(i, tick).clip_tick * 24 / clip_ticks)];
        EXPECT_LT(tests::unevenness(counts), tests::chance);
    }
}

TEST(Acts, AthletesAreOutOfStep) {
    std::vector<std::int64_t> counts(4, 0);
    for (const std::size_t i : stands().people(Role::runner)) {
        const Action action = stands().at(i, 500);
        ASSERT_EQ(action.clip, run);
        ++counts[static_cast<std::size_t>(action.clip_tick * 4 / 44)];
    }
    for (const std::size_t i : stands().people(Role::walker)) {
        const Action action = stands().at(i, 500);
        ASSERT_EQ(action.clip, walk);
        ++counts[static_cast<std::size_t>(action.clip_tick * 4 / 62)];
    }
    EXPECT_LT(tests::unevenness(counts), tests::chance);
}

TEST(Acts, AQuarterOfThoseWhoKeepTheirActIsExcitedWhateverTheirPhase) {
    FakeCast cast = fans();
    cast.poses = {tests::fake_poses({240, 200, 160, 120, 80, 62, 44})};  // of different lengths: nobody changes
    const Watched crowd(cast);
    std::vector<std::int64_t> counts(5, 0);
    std::vector<double> excited, phase;
    for (const std::size_t i : crowd.people(Role::spectator)) {
        const Action action = crowd.at(i, 0);
        ++counts[action.clip];
        excited.push_back(is_excited(action));
        phase.push_back(static_cast<double>(action.clip_tick) / crowd.cast.poses[0].clips[action.clip].ticks());
    }
    EXPECT_NEAR(tests::mean(excited), 0.25, 0.016);
    EXPECT_LT(tests::dependence(excited, phase), tests::chance);
    EXPECT_NEAR(tests::mean(phase), 0.5, 0.015);
    EXPECT_LT(tests::unevenness({counts[sit], counts[fidget]}), tests::chance);
    EXPECT_LT(tests::unevenness({counts[cheer], counts[clap], counts[wave]}), tests::chance);
}

TEST(Acts, AreKeptForEverIfAnyOneTakesLongerThanTheRest) {
    for (std::size_t longer = sit; longer <= wave; ++longer) {
        std::vector<int> ticks{240, 240, 240, 240, 240, 62, 44};
        ticks[longer] = 300;
        FakeCast cast = fans();
        cast.poses = {tests::fake_poses(ticks)};
        const Watched crowd(cast, 9000);
        for (std::size_t i = 0; i < crowd.crowd.size(); i += 101) {
            const Action first = crowd.at(i, 0);
            const std::int64_t length = ticks[first.clip];
            for (std::int64_t tick = 1; tick < 20 * clip_ticks; tick += 31) {
                const Action action = crowd.at(i, tick);
                ASSERT_EQ(action.clip, first.clip);
                ASSERT_EQ(action.clip_tick, (first.clip_tick + tick) % length);
            }
        }
    }
}

TEST(Acts, GoOnAcrossTheStartOfTime) {
    for (std::size_t i = 0; i < stands().crowd.size(); i += 97) {
        if (stands().crowd.role[i] != Role::spectator) continue;
        Action previous = stands().at(i, -4000);
        for (std::int64_t tick = -3999; tick < 300; ++tick) {
            const Action next = stands().at(i, tick);
            const bool goes_on = next.clip == previous.clip && next.clip_tick == previous.clip_tick + 1;
            const bool at_the_seam = previous.clip_tick == 0 || previous.clip_tick == clip_ticks - 1;
            ASSERT_TRUE(goes_on || (at_the_seam && next.clip_tick == 0)) << "person " << i << " at tick " << tick;
            previous = next;
        }
    }
}

TEST(Acts, NobodyHoldsStillForLongerThanAClip) {
    for (std::size_t i = 0; i < stands().crowd.size(); i += 97) {
        if (stands().crowd.role[i] != Role::spectator) continue;
        std::int64_t held = 0, longest = 0;
        for (std::int64_t tick = 0; tick < 140 * second; ++tick) {
            held = stands().at(i, tick).clip_tick == 0 ? held + 1 : 0;
            longest = std::max(longest, held);
        }
        EXPECT_LE(longest, clip_ticks + 1) << "person " << i;
    }
}

// ---- Moods ----

constexpr int parts = 20;  // of the stands, each with moods of its own
constexpr std::int64_t wave_interval = 45 * second;

// When all are out of one wave, and before the next; the last period of everybody then began in one mood.
std::int64_t quiet(int wave) {
    return wave * wave_interval + 40 * second;
}

// People by part, without those so near to a border that they might be counted to the other side.
std::vector<std::vector<std::size_t>> by_part(const Watched& watched) {
    constexpr double border = 0.16;  // of a part
    std::vector<std::vector<std::size_t>> result(parts);
    for (const std::size_t i : watched.people(Role::spectator)) {
        const double at = parts * lap_of(watched.crowd.position[i]);
        if (std::abs(at - std::round(at)) > border) result[static_cast<std::size_t>(at)].push_back(i);
    }
    return result;
}

double share_excited(const std::vector<std::size_t>& people, std::int64_t tick) {
    const auto excited = [&](std::size_t i) { return is_excited(stands().at(i, tick)); };
    return static_cast<double>(std::count_if(people.begin(), people.end(), excited)) /
           static_cast<double>(people.size());
}

// [part][time]
std::vector<std::vector<double>> moods() {
    constexpr int times = 30;
    std::vector<std::vector<double>> result;
    for (const auto& people : by_part(stands())) {
        result.emplace_back();
        for (int time = 0; time < times; ++time) result.back().push_back(share_excited(people, quiet(time)));
    }
    return result;
}

TEST(Moods, AreMostlyCalmAndSometimesWild) {
    std::vector<double> all;
    for (const auto& part : moods()) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    EXPECT_GT(all.front(), 0.01);
    EXPECT_LT(all.front(), 0.06);
    EXPECT_LT(all[all.size() / 2], 0.2);
    EXPECT_GT(all.back(), 0.6);
    EXPECT_LT(all.back(), 0.8);
}

TEST(Moods, EachPartHasItsOwn) {
    std::vector<double> here, next, opposite;
    const auto levels = moods();
    for (std::size_t time = 0; time < levels[0].size(); ++time) {
        std::vector<double> around;
        for (std::size_t part = 0; part < parts; ++part) {
            around.push_back(levels[part][time]);
            here.push_back(levels[part][time]);
            next.push_back(levels[(part + 1) % parts][time]);
            opposite.push_back(levels[(part + parts / 2) % parts][time]);
        }
        EXPECT_GT(tests::deviation(around), 0.08) << "one mood for all stands";
    }
    EXPECT_LT(std::abs(tests::correlation(here, next)), 0.2);
    EXPECT_LT(std::abs(tests::correlation(here, opposite)), 0.2);
}

TEST(Moods, ChangeWithTime) {
    std::vector<double> before, after;
    for (const auto& part : moods()) {
        EXPECT_GT(tests::deviation(part), 0.08) << "one mood for ever";
        before.insert(before.end(), part.begin(), part.end() - 1);
        after.insert(after.end(), part.begin() + 1, part.end());
    }
    EXPECT_LT(std::abs(tests::correlation(before, after)), 0.2);
}

TEST(Moods, LastAQuarterOfAMinute) {
    // Half of those in a period 8 s before are in the mood of now. 16 s before is another mood's.
    std::vector<double> now, shortly, before;
    for (const auto& people : by_part(stands())) {
        for (int time = 1; time < 30; ++time) {
            now.push_back(share_excited(people, quiet(time)));
            shortly.push_back(share_excited(people, quiet(time) - 6 * second));
            before.push_back(share_excited(people, quiet(time) - 16 * second + wave_interval));
        }
    }
    EXPECT_GT(tests::correlation(now, shortly), 0.9);
    EXPECT_LT(std::abs(tests::correlation(now, before)), 0.2);
}

TEST(Moods, AreNotAlwaysTheSamePeoples) {
    double expected = 0, both = 0;
    for (const auto& people : by_part(stands())) {
        for (int time = 0; time < 20; ++time) {
            const std::int64_t later = quiet(time), sooner = later - clip_ticks;
            expected +=
                share_excited(people, later) * share_excited(people, sooner) * static_cast<double>(people.size());
            for (const std::size_t i : people)
                both += is_excited(stands().at(i, later)) && is_excited(stands().at(i, sooner));
        }
    }
    EXPECT_NEAR(both / expected, 1.0, 0.05);
}

// ---- Waves ----

constexpr std::int64_t first_wave = 6 * second, wave_lap = 20 * second;
constexpr double straightness = 12;  // [ticks] by which the wave's front may be out of true in the bends

double front_tick(const Watched& watched, std::size_t i, int number) {
    return static_cast<double>(number * wave_interval + first_wave) +
           lap_of(watched.crowd.position[i]) * static_cast<double>(wave_lap);
}

// The tick at which somebody jumps up around the time that the wave comes by.
std::optional<std::int64_t> jump(const Watched& watched, std::size_t i, int number) {
    const auto front = static_cast<std::int64_t>(front_tick(watched, i, number));
    for (std::int64_t tick = front - 20; tick < front + 40; ++tick) {
        const Action action = watched.at(i, tick);
        if (action.clip == cheer && action.clip_tick == 0) return tick;
    }
    return std::nullopt;
}

std::vector<std::size_t> some_spectators() {
    std::vector<std::size_t> result;
    const std::vector<std::size_t> all = stands().people(Role::spectator);
    for (std::size_t k = 0; k < all.size(); k += 5) result.push_back(all[k]);
    return result;
}

TEST(Waves, TakeMostAlongButNotAlwaysTheSame) {
    int one = 0, other = 0, both = 0;
    const std::vector<std::size_t> people = some_spectators();
    for (const std::size_t i : people) {
        const bool in_one = jump(stands(), i, 0).has_value(), in_other = jump(stands(), i, 3).has_value();
        one += in_one;
        other += in_other;
        both += in_one && in_other;
    }
    const double count = static_cast<double>(people.size());
    EXPECT_NEAR(one / count, 0.85, 0.03);
    EXPECT_NEAR(other / count, 0.85, 0.03);
    EXPECT_NEAR(both / count, 0.85 * 0.85, 0.035);
}

TEST(Waves, GoOnceAroundIn20SecondsAtAnEvenPace) {
    constexpr double reaction = 15;  // [ticks] a quarter of a second at most
    int early = 0, late = 0, all = 0;
    std::map<int, std::vector<double>> delays;  // by sixteenth of the lap
    for (const std::size_t i : some_spectators()) {
        const auto tick = jump(stands(), i, 1);
        if (!tick) continue;
        const double delay = static_cast<double>(*tick) - front_tick(stands(), i, 1);
        ++all;
        early += delay < -straightness;
        late += delay > straightness + reaction;
        delays[static_cast<int>(16 * lap_of(stands().crowd.position[i]))].push_back(delay);
    }
    // Some of those who take no part cheer of their own accord in that second.
    EXPECT_LT(early + late, all / 100);
    ASSERT_EQ(delays.size(), 16u);
    for (const auto& [part, some] : delays) EXPECT_NEAR(tests::mean(some), reaction / 2, straightness) << part;
}

TEST(Waves, ReactionTakesUpToAQuarterOfASecond) {
    std::vector<std::int64_t> counts(15, 0);
    for (const std::size_t i : stands().people(Role::spectator)) {
        // On the straights, where the front's place is exact.
        if (std::abs(stands().crowd.position[i].x) > scene::Oval().half_straight) continue;
        const auto tick = jump(stands(), i, 1);
        if (!tick) continue;
        const double delay = static_cast<double>(*tick) - std::floor(front_tick(stands(), i, 1) + 1e-2);
        if (delay >= 0 && delay < 15) ++counts[static_cast<std::size_t>(delay)];
    }
    // Rounding of the front's tick moves a few by one.
    for (const std::int64_t count : counts)
        EXPECT_NEAR(static_cast<double>(count) * 15 /
                        static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0})),
                    1.0, 0.25);
}

TEST(Waves, ComeEvery45SecondsToEachOfThoseWhoTakePart) {
    int same = 0, both = 0;
    for (const std::size_t i : some_spectators()) {
        const auto one = jump(stands(), i, 1), next = jump(stands(), i, 2);
        if (!one || !next) continue;
        ++both;
        same += *next - *one == wave_interval;
    }
    EXPECT_GT(same, both * 97 / 100);
}

TEST(Waves, AreShownToTheEnd) {
    for (const std::size_t i : some_spectators()) {
        const auto start = jump(stands(), i, 1);
        if (!start) continue;
        for (std::int64_t k = 0; k < clip_ticks; k += 7) {
            const Action action = stands().at(i, *start + k);
            ASSERT_EQ(action.clip, cheer);
            ASSERT_EQ(action.clip_tick, k);
        }
    }
}

TEST(Waves, AreForSpectatorsOnly) {
    int jumped = 0, all = 0;
    for (const std::size_t i : standing().people(Role::standing)) {
        if (i % 7 != 0) continue;
        ++all;
        jumped += jump(standing(), i, 1).has_value();
    }
    ASSERT_GT(all, 300);
    EXPECT_LT(jumped, all / 10);
}

TEST(Waves, AreLeftOutWhereClipsAreTooLongForThem) {
    const Watched slow(fans(901));  // three take longer than the time between two waves
    const Watched quick(fans(890));
    int slow_jumps = 0, quick_jumps = 0, all = 0;
    for (std::size_t i = 0; i < slow.crowd.size(); i += 11) {
        if (slow.crowd.role[i] != Role::spectator) continue;
        ++all;
        slow_jumps += jump(slow, i, 1).has_value();
        quick_jumps += jump(quick, i, 1).has_value();
    }
    EXPECT_LT(slow_jumps, all / 10);
    EXPECT_GT(quick_jumps, all * 3 / 4);
}

// ---- Arrival ----

TEST(Arrival, HasNothingToDoWithWhatElseChanceDecides) {
    Crowd crowd = standing().crowd;
    crowd.filled_tick = 1000;
    FakeCast keeping = fans();
    keeping.poses = {tests::fake_poses({240, 200, 160, 120, 80, 62, 44})};
    std::map<std::string, std::vector<double>> traits;
    for (const std::size_t i : standing().people(Role::standing)) {
        const Action kept = scene::act(crowd, i, keeping.members[0], keeping.poses[0], 0);
        double arrival = 0;
        for (std::int64_t tick = 0; tick < 1000; tick += 50) arrival += !scene::has_arrived(crowd, i, tick);
        traits["arrival"].push_back(arrival);
        traits["phase"].push_back(static_cast<double>(standing().at(i, 0).clip_tick));
        traits["kept act"].push_back(is_excited(kept));
        traits["act"].push_back(is_excited(standing().at(i, 3000)));
        traits["height"].push_back(crowd.height[i]);
        traits["stagger"].push_back(crowd.hash[i] % 32);
    }
    for (auto a = traits.begin(); a != traits.end(); ++a) {
        for (auto b = std::next(a); b != traits.end(); ++b) {
            EXPECT_LT(tests::dependence(a->second, b->second), tests::chance) << a->first << " and " << b->first;
        }
    }
    std::vector<double> reaction, arrival;
    for (const std::size_t i : some_spectators()) {
        const auto tick = jump(stands(), i, 1);
        if (!tick || std::abs(stands().crowd.position[i].x) > scene::Oval().half_straight) continue;
        Crowd filling = {};
        filling.hash = {stands().crowd.hash[i]};
        filling.filled_tick = 1000;
        double later = 0;
        for (std::int64_t at = 0; at < 1000; at += 50) later += !scene::has_arrived(filling, 0, at);
        reaction.push_back(static_cast<double>(*tick) - front_tick(stands(), i, 1));
        arrival.push_back(later);
    }
    EXPECT_LT(tests::dependence(reaction, arrival), tests::chance);
}

}  // namespace
