// What a law reaches on a scenario, on fewer seeds than the scorecard has.
#pragma once

#include <string>
#include <utility>

#include "sfsm/simulate/scorecard.h"

namespace sfsm::simulate {

inline constexpr int some_seeds = 9;

inline Contestant contestant(const std::string& law) {
    return {law, [=](const Course&) { return make_controller(law); }, false};
}

inline Contestant the_default() {
    return contestant(std::string(law_names().front()));
}

inline Row row_of(Scenario scenario, int seeds = some_seeds, const Contestant& law = the_default()) {
    ScorecardOptions options;
    options.scenarios = {std::move(scenario)};
    options.laws = {law};
    options.reference = law;
    options.seeds = seeds;
    return scorecard(options).front();
}

inline Row row_of(const char* scenario, int seeds = some_seeds) {
    return row_of(make_scenario(scenario), seeds);
}

}  // namespace sfsm::simulate
