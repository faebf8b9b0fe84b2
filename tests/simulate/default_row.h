// What the default law reaches on a scenario, on fewer seeds than the scorecard has.
#pragma once

#include <string>
#include <utility>

#include "sfsm/simulate/scorecard.h"

namespace sfsm::simulate {

inline constexpr int some_seeds = 9;

inline Contestant the_default() {
    const std::string name(law_names().front());
    return {name, [=](const Course&) { return make_controller(name); }, false};
}

inline Row row_of(Scenario scenario, int seeds = some_seeds) {
    ScorecardOptions options;
    options.scenarios = {std::move(scenario)};
    options.laws = {the_default()};
    options.reference = the_default();
    options.seeds = seeds;
    return scorecard(options).front();
}

inline Row row_of(const char* scenario, int seeds = some_seeds) {
    return row_of(make_scenario(scenario), seeds);
}

}  // namespace sfsm::simulate
