// The parts of a static picture, one below the other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sfsm/report/report.h"

namespace sfsm::report {

// Each draws from `top` [px] on and returns where it ends.
double draw_recordings(std::string& out, const Report& report, double top);
double draw_laws(std::string& out, const Report& report, double top);

// Definitions that draw_laws needs, within the <svg>.
extern const char* const law_patterns;

// Of runs and of recordings.
template <class Run>
std::vector<std::string> names_of(const std::vector<Run>& runs) {
    std::vector<std::string> names;
    for (const Run& run : runs) names.push_back(run.name);
    return names;
}

}  // namespace sfsm::report
