#include "apps/contestants.h"

#include <memory>
#include <sstream>

#include "apps/program.h"
#include "sfsm/controller.h"
#include "sfsm/detail.h"
#include "sfsm/rivals/offline_table.h"
#include "sfsm/rivals/rivals.h"
#include "sfsm/simulate/oracle.h"

namespace apps {
namespace {

namespace sim = sfsm::simulate;
using Controllers = std::unique_ptr<sfsm::Controller>;

// Its table is of the first frame, which is all that can be measured before a run.
Controllers make_offline_table(const sim::Course& course) {
    const sim::Plant& plant = *course.scenario.plant;
    return sfsm::make_offline_table(
        [&](double detail) { return plant.cost_ms(0, sfsm::decision_at(detail, plant.range(0))); });
}

std::vector<sim::Contestant> contestants() {
    std::vector<sim::Contestant> laws;
    laws.push_back({std::string(sim::oracle_name),
                    [](const sim::Course& course) -> Controllers { return std::make_unique<sim::Oracle>(course); },
                    false});
    for (const std::string_view name : sfsm::law_names()) {
        laws.push_back({std::string(name), [=](const sim::Course& course) {
                            return sfsm::make_controller(name, {course.scenario.drawing});
                        }});
    }
    for (const std::string_view name : sfsm::rival_names()) {
        laws.push_back({std::string(name), [=](const sim::Course&) { return sfsm::make_rival(name); }});
    }
    laws.push_back({std::string(sfsm::offline_table_name), make_offline_table});
    return laws;
}

}  // namespace

std::vector<sim::Contestant> chosen_laws(const std::string& option, const std::string& list) {
    if (list == "all") return contestants();
    std::vector<sim::Contestant> chosen;
    std::istringstream names(list);
    for (std::string name; std::getline(names, name, ',');) {
        const std::optional<sim::Contestant> law = find_law(name);
        if (!law) throw wrong_argument(option, "'" + name + "'", "all or some of: " + law_list());
        chosen.push_back(*law);
    }
    if (chosen.empty()) throw wrong_argument(option, "''", "all or names with commas between");
    return chosen;
}

std::optional<sim::Contestant> find_law(const std::string& name) {
    for (const sim::Contestant& law : contestants())
        if (law.name == name) return law;
    return std::nullopt;
}

bool needs_course(const sim::Contestant& law) {
    return law.name == sim::oracle_name || law.name == sfsm::offline_table_name;
}

std::string law_list() {
    std::string list;
    for (const sim::Contestant& law : contestants()) list += (list.empty() ? "" : " ") + law.name;
    return list;
}

}  // namespace apps
