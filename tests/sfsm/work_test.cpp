#include "sfsm/work.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "sfsm/prices.h"

namespace sfsm {
namespace {

TEST(WorkTable, NamesAndColumnsAreEachKindsOwn) {
    std::set<std::string_view> names, columns;
    for (const WorkEntry& entry : work_table) {
        names.insert(entry.name);
        columns.insert(entry.column);
    }
    EXPECT_EQ(names.size(), work_kinds);
    EXPECT_EQ(columns.size(), work_kinds);
}

TEST(WorkTable, EveryKindIsOnOneAxisAndPriorsAreInRange) {
    EXPECT_EQ(work_on<WorkAxis::frame>.size() + work_on<WorkAxis::motion>.size() + work_on<WorkAxis::shape>.size(),
              work_kinds);
    for (const WorkEntry& entry : work_table) {
        EXPECT_EQ(&entry_of(entry.kind), &entry);
        for (const WorkPrior& prior : entry.priors) {
            EXPECT_GT(prior.pieces, 0) << entry.name;
            EXPECT_GT(prior.spread, 0) << entry.name;
            EXPECT_TRUE(prior.least >= 0 && prior.least < 1) << entry.name;
            EXPECT_GT(prior.fit_pieces, 0) << entry.name;
            EXPECT_GT(prior.fit_spread, 0) << entry.name;
        }
    }
    for (const WorkPrior& prior : entry_of(WorkKind::triangle).priors)
        EXPECT_EQ(prior.pieces, 1) << "a piece is a triangle of the same drawing";
}

TEST(Drawing, HasANameOfItsOwnAndIsFoundByIt) {
    for (const Drawing drawing : {Drawing::opengl, Drawing::native})
        EXPECT_EQ(drawing_named(name_of(drawing)), drawing) << name_of(drawing);
    for (const std::string_view other : {"", "GL", "native ", "vulkan"}) EXPECT_FALSE(drawing_named(other)) << other;
}

TEST(Work, AddsUpAndMultipliesKindByKind) {
    Work work{1, 20, 300, 4000};
    work += Work{5, 6, 7, 8, 9};
    EXPECT_EQ(work, (Work{6, 26, 307, 4008, 9}));
    EXPECT_EQ(work * 2, (Work{12, 52, 614, 8016, 18}));
    EXPECT_EQ(work[WorkKind::motion_update], 4008);
}

TEST(Work, OfAnAxisIsItsKindsAlone) {
    const Work work{1, 20, 300, 4000, 50000, 600000};
    EXPECT_EQ(only_on<WorkAxis::frame>(work), (Work{1, 0, 0, 0, 50000, 600000}));
    EXPECT_EQ(only_on<WorkAxis::shape>(work), (Work{0, 20, 300}));
    EXPECT_EQ(only_on<WorkAxis::motion>(work), (Work{0, 0, 0, 4000}));
}

TEST(Counted, IsWithinWhatAFrameCanDraw) {
    EXPECT_EQ(counted(-1), 0);
    EXPECT_EQ(counted(1234567), 1234567);
    EXPECT_EQ(counted(std::numeric_limits<std::int64_t>::max()), 1e15);
    EXPECT_EQ(counted(std::numeric_limits<std::int64_t>::min()), 0);
}

TEST(Prices, TimesCountsAreTheCost) {
    const Prices prices{10, {1, 0.5, 0.25, 2}};
    EXPECT_EQ(cost_of({}, prices), 10);
    EXPECT_EQ(cost_of({3, 4, 8, 1}, prices), 10 + 3 + 2 + 2 + 2);
    EXPECT_EQ(cost_of({3, 4, 8, 1}, 2.0 * prices), 38);
}

}  // namespace
}  // namespace sfsm
