// The default law where work is foreseen wrongly: all of it, each kind otherwise, or each view.
#include <gtest/gtest.h>

#include <cmath>

#include "sfsm/simulate/catalogue.h"
#include "sfsm/simulate/work_scenarios.h"
#include "tests/simulate/default_row.h"

namespace sfsm::simulate {
namespace {

Foresight all_by(double factor) {
    return {factor, factor, factor, factor};
}

Row foreseen(const Foresight& of_wide, const Foresight& of_block, const Foresight& of_bend) {
    View views[] = {wide, block, bend};
    views[0].foresight = of_wide;
    views[1].foresight = of_block;
    views[2].foresight = of_bend;
    return row_of(cutting("", {views[0], views[1], views[2]}));
}

TEST(DefaultLaw, HoldsAForecastThatIsOffByAConstantAsAnHonestOne) {
    const Row honest = row_of(make_scenario("camera-cut"));
    for (const double factor : {0.5, 0.62, 0.8, 0.93, 1.09, 1.3, 1.6, 2.0}) {
        const Row row = foreseen(all_by(factor), all_by(factor), all_by(factor));
        EXPECT_NEAR(row.median.over_5pct, honest.median.over_5pct, 0.02) << factor;
        EXPECT_NEAR(row.median.quality, honest.median.quality, 0.02) << factor;
    }
}

TEST(DefaultLaw, HoldsAForecastThatIsOffByKind) {
    for (const double factor : {0.4, 0.7, 1.5, 2.5}) {
        const Foresight triangles{.person = 1.2, .triangle = factor, .point = 1 / factor, .update = 1};
        const Foresight updates{.person = 1 / factor, .triangle = 1, .point = 0.8, .update = factor};
        for (const Foresight& foresight : {triangles, updates}) {
            const Row row = foreseen(foresight, foresight, foresight);
            EXPECT_LE(row.worst.over_5pct, 0.1) << factor << " of triangles, of points " << foresight.point;
            EXPECT_GE(row.worst.quality, 0.96) << factor;
        }
    }
}

TEST(DefaultLaw, HoldsAForecastThatIsOffByView) {
    for (const double factor : {0.4, 0.7, 1.5, 2.5}) {
        const Row row = foreseen(all_by(factor), all_by(1 / factor), all_by(1));
        EXPECT_LE(row.worst.over_5pct, 0.1) << factor;
        EXPECT_GE(row.worst.quality, 0.96) << factor;
    }
}

}  // namespace
}  // namespace sfsm::simulate
