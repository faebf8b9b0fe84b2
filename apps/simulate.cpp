#include "apps/simulate.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "apps/output.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "sfsm/controller.h"
#include "sfsm/rivals/rivals.h"
#include "sfsm/simulate/oracle.h"
#include "sfsm/simulate/scorecard.h"
#include "sfsm/simulate/scorecard_text.h"
#include "sfsm/trace.h"

namespace apps {
namespace {

namespace sim = sfsm::simulate;
using Controllers = std::unique_ptr<sfsm::Controller>;

constexpr const char* all = "all";
constexpr int most_seeds = 1000;

// The clairvoyant, our laws, and those that ship elsewhere.
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

std::vector<sim::Contestant> chosen_laws(const std::string& list) {
    const std::vector<sim::Contestant> known = contestants();
    if (list == all) return known;
    std::vector<sim::Contestant> chosen;
    std::istringstream names(list);
    for (std::string name; std::getline(names, name, ',');) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const auto& law) { return law.name == name; });
        if (found == known.end()) {
            std::string expected = "all or some of:";
            for (const sim::Contestant& law : known) expected += " " + law.name;
            throw wrong_argument("--laws", "'" + name + "'", expected);
        }
        chosen.push_back(*found);
    }
    if (chosen.empty()) throw wrong_argument("--laws", "''", "all or names with commas between");
    return chosen;
}

std::vector<sim::Scenario> chosen_scenarios(const std::string& name) {
    std::vector<sim::Scenario> scenarios;
    for (const std::string_view known : sim::scenario_names()) {
        if (name == all || name == known) scenarios.push_back(sim::make_scenario(known));
    }
    if (scenarios.empty()) {
        std::string expected = "all or one of:";
        for (const std::string_view known : sim::scenario_names()) expected.append(" ").append(known);
        throw wrong_argument("--simulate", "'" + name + "'", expected);
    }
    return scenarios;
}

double now_us() {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::map<std::string, std::string> trace_settings(const sim::Scenario& scenario, const std::string& law) {
    return {{"scenario", scenario.name},
            {"law", law},
            {"state", "auto"},
            {"seed", "1"},
            {"delay", std::to_string(scenario.delay)},
            {"target_ms", scenario.target.text()},
            {"version", GRANDSTAND_VERSION}};
}

sfsm::TraceRow trace_row(const sim::Plant& plant, std::int64_t frame, const sim::Outcome& outcome) {
    sfsm::TraceRow row;
    row.frame = frame;
    row.target_ms = outcome.target_ms;
    row.frame_ms = outcome.ms;
    row.cpu_ms = row.gpu_ms = std::numeric_limits<double>::quiet_NaN();
    row.decision = outcome.decision;
    row.range = plant.range(frame);
    row.work = plant.work(frame, row.decision);
    row.predicted_ms = outcome.predicted_ms;
    if (const sfsm::Forecast* forecast = plant.forecast(frame)) {
        row.motion.assign(forecast->motion.begin(), forecast->motion.end());
        row.splats.assign(forecast->splats.begin(), forecast->splats.end());
    }
    return row;
}

void write_run(std::ostream& out, const sim::Course& course, const sim::Contestant& law) {
    std::vector<sim::Outcome> outcomes;
    sim::run(course, *law.make(course), {}, outcomes);
    sfsm::write_trace_header(out, trace_settings(course.scenario, law.name));
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        sfsm::write_trace_row(out, trace_row(*course.scenario.plant, static_cast<std::int64_t>(i), outcomes[i]));
    }
}

sim::ScorecardOptions scorecard_options(const SimulateOptions& options) {
    sim::ScorecardOptions card;
    card.scenarios = chosen_scenarios(options.scenario);
    card.laws = chosen_laws(options.laws);
    card.reference = chosen_laws(std::string(sfsm::law_names().front())).front();
    card.seeds = options.seeds;
    card.now_us = now_us;
    return card;
}

std::vector<sim::Row> scorecard(sim::ScorecardOptions& card) {
    ProgressBar bar("simulating");
    card.progress = [&](double share) { bar(share); };
    return sim::scorecard(card);
}

}  // namespace

CLI::Option* add_simulate_options(CLI::App& app, SimulateOptions& options) {
    auto* simulate = app.add_option("--simulate", options.scenario, "Not a trace but a simulated renderer, or all");
    app.add_option("--laws", options.laws, "Laws to put through it, LAW[,LAW ...], or all")
        ->needs(simulate)
        ->capture_default_str();
    app.add_option("--seeds", options.seeds, "Runs of each, with noise of their own")
        ->needs(simulate)
        ->check(whole_number(1, most_seeds))
        ->capture_default_str();
    app.add_option("--json", options.json, "Write the scorecard as JSON (- = stdout, instead of the table)")
        ->needs(simulate);
    return simulate;
}

void check(const SimulateOptions& options) {
    const std::size_t scenarios = chosen_scenarios(options.scenario).size();
    const std::size_t laws = chosen_laws(options.laws).size();
    if (options.csv.empty()) return;
    if (scenarios != 1 || laws != 1) {
        throw wrong_argument("--csv", std::to_string(scenarios * laws) + " runs", "one scenario and one law with it");
    }
    if (options.csv == "-" && options.json == "-") {
        throw wrong_argument("--csv", "- and --json -", "at most one of them on standard output");
    }
}

void simulate(const SimulateOptions& options) {
    sim::ScorecardOptions card = scorecard_options(options);
    // All are opened before any is written: a place that cannot be written leaves none.
    std::optional<OutputFile> csv, json;
    if (!options.csv.empty()) csv.emplace(options.csv);
    if (!options.json.empty()) json.emplace(options.json);
    const std::vector<sim::Row> rows = scorecard(card);
    if (csv) {
        write_run(csv->stream(), sim::make_course(card.scenarios.front()), card.laws.front());
        csv->commit();
    }
    if (json) {
        sim::write_scorecard_json(json->stream(), card, rows);
        json->commit();
    }
    if (options.csv == "-" || options.json == "-") return;
    OutputFile table("-");
    sim::write_scorecard_table(table.stream(), card, rows);
    table.commit();
}

}  // namespace apps
