#include "apps/warm_up.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace {

// A million people by their triangles took a minute of llvmpipe before the first frame.
TEST(WarmUp, DrawsOneOfEachCharacterAndRepresentationWhoeverIsThere) {
    render::Frame everybody;
    everybody.splat_size = 2;
    everybody.batch_numbers = 77;
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        render::Person person{};
        person.character = i % 3;
        person.representation = i > 50'000 ? 1 : 0;
        person.batch = i % 77;
        everybody.people.push_back(person);
    }
    const render::Frame frame = apps::one_of_each(everybody);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> drawn;
    for (const render::Person& person : frame.people) ++drawn[{person.character, person.representation}];
    EXPECT_EQ(drawn.size(), 6u);
    EXPECT_EQ(frame.people.size(), 6u);
    EXPECT_EQ(frame.splat_size, everybody.splat_size);
    EXPECT_EQ(frame.batch_numbers, everybody.batch_numbers);
    EXPECT_TRUE(apps::one_of_each(render::Frame{}).people.empty());
}

}  // namespace
