#include "apps/contestants.h"

#include <algorithm>
#include <memory>
#include <sstream>

#include "apps/program.h"
#include "sfsm/controller.h"
#include "sfsm/rivals/rivals.h"
#include "sfsm/simulate/oracle.h"

namespace apps {
namespace {

namespace sim = sfsm::simulate;
using Controllers = std::unique_ptr<sfsm::Controller>;

std::vector<sim::Contestant> contestants() {
    std::vector<sim::Contestant> laws;
    laws.push_back({std::string(sim::oracle_name),
                    [](const sim::Course& course) -> Controllers { return std::make_unique<sim::Oracle>(course); },
                    false});
    for (const std::string_view name : sfsm::law_names()) {
        laws.push_back({std::string(name), [=](const sim::Course&) { return sfsm::make_controller(name); }});
    }
    for (const std::string_view name : sfsm::rival_names()) {
        laws.push_back({std::string(name), [=](const sim::Course&) { return sfsm::make_rival(name); }});
    }
    return laws;
}

}  // namespace

std::vector<sim::Contestant> chosen_laws(const std::string& option, const std::string& list) {
    const std::vector<sim::Contestant> known = contestants();
    if (list == "all") return known;
    std::vector<sim::Contestant> chosen;
    std::istringstream names(list);
    for (std::string name; std::getline(names, name, ',');) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const auto& law) { return law.name == name; });
        if (found == known.end()) {
            std::string expected = "all or some of:";
            for (const sim::Contestant& law : known) expected += " " + law.name;
            throw wrong_argument(option, "'" + name + "'", expected);
        }
        chosen.push_back(*found);
    }
    if (chosen.empty()) throw wrong_argument(option, "''", "all or names with commas between");
    return chosen;
}

}  // namespace apps
