#include "apps/warm_up.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "tests/render/small_scene.h"

namespace {

// A million people by their triangles took a minute of llvmpipe before the first frame, and a list of them 70 MB.
TEST(WarmUp, DrawsOneOfEachCharacterAndRepresentationHoweverManyAreThere) {
    const tests::SmallScene scene(600);
    const render::View view = render::make_view({{0, 40, 200}, {0, 0, 0}, 0.8}, 64, 36);
    for (const figures::Way* way : {&figures::by_opengl(), &figures::natively()}) {
        const std::vector<figures::Figure> known = scene.figures();
        // A second character whom half of them are of, and a third whom nobody is of.
        const std::vector<figures::Figure> figures{known[0], known[0], known[0]};
        scene::Crowd crowd = scene.crowd;
        for (std::size_t person = 0; person < crowd.size(); person += 2) crowd.character[person] = 1;
        const render::Frame frame = apps::one_of_each(view, crowd, figures, *way);
        std::set<std::tuple<std::uint32_t, std::uint32_t>> drawn;
        std::set<std::uint32_t> batches;
        for (const render::Person& person : frame.people) {
            drawn.insert({person.character, person.representation});
            batches.insert(person.batch);
            EXPECT_LT(person.batch, frame.batch_numbers);
            EXPECT_GT(person.count, 0u);
            EXPECT_FALSE(way->representations[person.representation].is_by_block);
        }
        const std::set<std::tuple<std::uint32_t, std::uint32_t>> expected{{0, 0}, {0, 1}, {1, 0}, {1, 1}};
        EXPECT_EQ(drawn, expected);
        EXPECT_EQ(frame.people.size(), 4u);
        EXPECT_EQ(batches.size(), 4u) << "they are not alike";
    }
    EXPECT_TRUE(apps::one_of_each(view, scene::Crowd{}, {}, figures::natively()).people.empty());
}

}  // namespace
