// Several characters in one crowd: each is chosen and priced as if theirs were the only one, whatever the units of
// their models.
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>
#include <tuple>

#include "render/select.h"
#include "tests/render/drawn_points.h"
#include "tests/render/lone_person.h"

namespace {

using render::Selector;
using sfsm::Decision;
using sfsm::State;

constexpr int rows = 60;
constexpr float row_pitch = 3.0f;  // [m]

// The same character from a file whose units are `per_metre` to a metre.
model::Character in_units(model::Character character, float per_metre) {
    for (glm::vec3& position : character.mesh.positions) position *= per_metre;
    for (float& value : character.clips[0].channels[0].values) value *= per_metre;
    return character;
}

// Somebody every few metres, `aside` of the others; all columns reach equally far.
tests::LonePeople column(model::Character character, float aside, std::size_t point_count, float gait_speed) {
    std::vector<glm::vec3> places;
    for (int i = 0; i < rows; ++i) places.emplace_back(aside, 0, -4.0f - row_pitch * static_cast<float>(i));
    tests::LonePeople people(std::move(character), places, point_count);
    people.cast[0].gait_speed[static_cast<int>(scene::Role::walker)] = gait_speed;
    return people;
}

// Alike in nothing: size, speed, length of the clip, triangles, points, units.
std::vector<tests::LonePeople> columns() {
    std::vector<tests::LonePeople> all;
    all.push_back(column(tests::make_lift(0.25f, 0.8f, 4, 8), -0.7f, 300, 1.4f));
    all.push_back(column(in_units(tests::make_lift(0.15f, 0.3f, 2.5, 3), 100), 0, 40, 1.1f));
    all.push_back(column(tests::make_lift(0.4f, 1.5f, 7, 12), 0.9f, 600, 3.0f));
    return all;
}

struct Together {
    scene::Crowd crowd;
    std::vector<scene::CastMember> cast;
    std::vector<figures::Figure> figures;

    explicit Together(const std::vector<tests::LonePeople>& parts) {
        crowd.path = parts[0].crowd.path;
        for (const tests::LonePeople& part : parts) {
            const auto character = static_cast<std::uint8_t>(figures.size());
            cast.push_back(part.cast[0]);
            figures.push_back(part.figures()[0]);
            for (std::size_t i = 0; i < part.crowd.size(); ++i) {
                crowd.blocks.push_back({static_cast<std::uint32_t>(crowd.size()), 1, part.crowd.blocks[i].box});
                crowd.position.push_back(part.crowd.position[i]);
                crowd.yaw.push_back(part.crowd.yaw[i]);
                crowd.height.push_back(part.crowd.height[i]);
                crowd.character.push_back(character);
                crowd.role.push_back(part.crowd.role[i]);
                crowd.hash.push_back(part.crowd.hash[i]);
                crowd.around.push_back(part.crowd.around[i]);
                crowd.palette.push_back(part.crowd.palette[i]);
            }
        }
    }
};

using Drawn = std::multiset<std::tuple<std::size_t, std::uint32_t, std::uint32_t, std::string>>;

void add(Drawn& drawn, std::size_t first_character, const render::Frame& selection) {
    for (const render::Person& person : selection.people) {
        std::string bytes(sizeof person.instance, '\0');
        std::memcpy(bytes.data(), &person.instance, bytes.size());
        drawn.insert({first_character + person.character, person.pose, tests::points_of(person), bytes});
    }
}

render::View along_the_columns() {
    return render::make_view({{0, 0.9, 0}, {0, 0.9, -1}, 0.9}, 640, 360);
}

TEST(Several, AreDrawnAsEachWouldBeAlone) {
    std::vector<tests::LonePeople> parts = columns();
    for (tests::LonePeople& part : parts) {
        for (std::size_t i = 0; i < part.crowd.size(); i += 3) {
            part.crowd.role[i] = scene::Role::walker;
            part.crowd.position[i] = {1, 0, 2 * static_cast<float>(i)};  // the lane's offset, and the arc
            part.crowd.blocks[i].box = {glm::vec3(-200), glm::vec3(200)};
        }
    }
    const Together all(parts);
    Selector selector(all.crowd, all.cast, all.figures);
    const render::View view = render::make_view({{-30, 30, 100}, {-27, 22, 70}, 1.2}, 640, 360);
    for (const Decision& decision : {Decision{}, Decision{State::slowed, 10, 0}, Decision{State::points, 10, 1},
                                     Decision{State::points, 40, 4}, Decision{State::points, 40, 20}}) {
        selector.survey(view, 777);
        const render::Frame& together = selector.select(decision, 776);
        Drawn drawn, expected;
        sfsm::Work work;
        add(drawn, 0, together);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            Selector alone(parts[i].crowd, parts[i].cast, parts[i].figures());
            alone.survey(view, 777);
            const render::Frame& selection = alone.select(decision, 776);
            EXPECT_GT(selection.work[sfsm::WorkKind::person], rows / 2);
            add(expected, i, selection);
            work += selection.work;
        }
        EXPECT_EQ(drawn, expected);
        EXPECT_EQ(together.work, work);
    }
}

TEST(Several, AreForecastAsEachWouldBeAlone) {
    const std::vector<tests::LonePeople> parts = columns();
    const Together all(parts);
    Selector selector(all.crowd, all.cast, all.figures);
    const sfsm::Forecast together = selector.survey(along_the_columns(), 100).forecast;
    std::vector<sfsm::Step> splats(together.shapes.size());
    std::vector<sfsm::Step> motion(together.motion.size());
    for (const tests::LonePeople& part : parts) {
        Selector alone(part.crowd, part.cast, part.figures());
        const sfsm::Forecast forecast = alone.survey(along_the_columns(), 100).forecast;
        ASSERT_EQ(forecast.frame[sfsm::WorkKind::person], rows);
        const double share = 1.0 / static_cast<double>(parts.size());  // there are as many of each
        for (std::size_t i = 0; i < splats.size(); ++i) {
            splats[i].work[sfsm::WorkKind::triangle] += forecast.shapes[i].work[sfsm::WorkKind::triangle];
            splats[i].work[sfsm::WorkKind::point] += forecast.shapes[i].work[sfsm::WorkKind::point];
            splats[i].loss_px += share * forecast.shapes[i].loss_px;
        }
        for (std::size_t i = 0; i < motion.size(); ++i) {
            motion[i].work[sfsm::WorkKind::motion_update] += forecast.motion[i].work[sfsm::WorkKind::motion_update];
            motion[i].loss_px += share * forecast.motion[i].loss_px;
        }
    }
    for (std::size_t i = 0; i < splats.size(); ++i) {
        EXPECT_EQ(together.shapes[i].work[sfsm::WorkKind::triangle], splats[i].work[sfsm::WorkKind::triangle])
            << "S = " << together.shapes[i].setting;
        EXPECT_EQ(together.shapes[i].work[sfsm::WorkKind::point], splats[i].work[sfsm::WorkKind::point])
            << "S = " << together.shapes[i].setting;
        EXPECT_NEAR(together.shapes[i].loss_px, splats[i].loss_px, 1e-9) << "S = " << together.shapes[i].setting;
    }
    constexpr double rounding = 2;  // each forecast's updates are whole
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const auto updates = static_cast<double>(together.motion[i].work[sfsm::WorkKind::motion_update]);
        EXPECT_NEAR(updates, static_cast<double>(motion[i].work[sfsm::WorkKind::motion_update]), rounding)
            << "D = " << together.motion[i].setting;
        EXPECT_NEAR(together.motion[i].loss_px, motion[i].loss_px, 1e-9) << "D = " << together.motion[i].setting;
    }
}

TEST(Units, OfAModelChangeNothingThatIsSeen) {
    constexpr double bin_edge = 0.01;  // somebody may be counted in the next bin
    const auto lift = tests::make_lift(0.25f, 0.8f, 4, 10);
    const tests::LonePeople metres = column(lift, 0, 500, 1.4f);
    for (const float per_metre : {0.04f, 100.0f}) {
        const tests::LonePeople other = column(in_units(lift, per_metre), 0, 500, 1.4f);
        Selector one(metres.crowd, metres.cast, metres.figures()), two(other.crowd, other.cast, other.figures());
        const sfsm::Forecast expected = one.survey(along_the_columns(), 100).forecast,
                             found = two.survey(along_the_columns(), 100).forecast;
        EXPECT_EQ(found.frame, expected.frame);
        for (std::size_t i = 0; i < expected.shapes.size(); ++i) {
            const auto points = static_cast<double>(expected.shapes[i].work[sfsm::WorkKind::point]),
                       triangles = static_cast<double>(expected.shapes[i].work[sfsm::WorkKind::triangle]);
            const double either = bin_edge * (points + triangles);
            EXPECT_NEAR(static_cast<double>(found.shapes[i].work[sfsm::WorkKind::point]), points, either) << per_metre;
            EXPECT_NEAR(static_cast<double>(found.shapes[i].work[sfsm::WorkKind::triangle]), triangles, either)
                << per_metre;
            EXPECT_NEAR(found.shapes[i].loss_px, expected.shapes[i].loss_px,
                        bin_edge * (1 + expected.shapes[i].setting));
        }
        for (std::size_t i = 0; i < expected.motion.size(); ++i)
            EXPECT_NEAR(found.motion[i].loss_px, expected.motion[i].loss_px, bin_edge * expected.motion[i].loss_px);
        const render::Frame &fine = one.select({}, 99), &same = two.select({}, 99);
        ASSERT_EQ(same.people.size(), fine.people.size());
        for (std::size_t i = 0; i < fine.people.size(); ++i) EXPECT_EQ(same.people[i].pose, fine.people[i].pose);
    }
}

// Past the side of the picture, above and below it, by hand's breadths: a model's unit must not decide who is seen.
TEST(Units, OfAModelDoNotDecideWhoIsSeen) {
    const auto lift = tests::make_lift(0.25f, 0, 0.5, 1);
    const glm::vec3 feet(0, 0, 0);
    const tests::LonePeople metres(lift, {&feet, 1});
    for (const float per_metre : {0.04f, 100.0f}) {
        const tests::LonePeople other(in_units(lift, per_metre), {&feet, 1});
        Selector one(metres.crowd, metres.cast, metres.figures()), two(other.crowd, other.cast, other.figures());
        int seen = 0, looks = 0;
        for (double up = -1; up < 1; up += 0.0137) {
            const render::View view = render::make_view({{0, 0.9, 6}, {0, 0.9 + 6 * up, 0}, 0.5}, 640, 360);
            const std::int64_t people = one.survey(view, 0).forecast.frame[sfsm::WorkKind::person];
            EXPECT_EQ(two.survey(view, 0).forecast.frame[sfsm::WorkKind::person], people) << "up " << up;
            seen += people == 1;
            ++looks;
        }
        EXPECT_GT(seen, looks / 4);
        EXPECT_LT(seen, looks / 2 + looks / 4);
    }
}

}  // namespace
