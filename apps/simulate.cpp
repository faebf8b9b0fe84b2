#include "apps/simulate.h"

#include <chrono>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>
#include <vector>

#include "apps/contestants.h"
#include "apps/output.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/rerun.h"
#include "sfsm/controller.h"
#include "sfsm/simulate/endurance.h"
#include "sfsm/simulate/scorecard.h"
#include "sfsm/simulate/scorecard_text.h"
#include "sfsm/trace.h"

namespace apps {
namespace {

namespace sim = sfsm::simulate;

constexpr const char* all = "all";
constexpr int most_seeds = 1000;
constexpr int most_frames = 1'000'000'000;
constexpr int stretches = 20;

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

void write_run(std::ostream& out, const sim::Course& course, const sim::Contestant& law) {
    const Rerun run = rerun_closed(law, course);
    sfsm::write_trace_header(out, trace_settings(course.scenario, law.name));
    std::int64_t frame = 0;
    for (const RerunFrame& rerun : run.frames)
        sfsm::write_trace_row(out, trace_row(*course.scenario.plant, frame++, rerun));
}

sim::ScorecardOptions scorecard_options(const SimulateOptions& options) {
    sim::ScorecardOptions card;
    card.scenarios = chosen_scenarios(options.scenario);
    card.laws = chosen_laws("--laws", options.laws);
    card.reference = chosen_laws("--laws", std::string(sfsm::law_names().front())).front();
    card.seeds = options.seeds;
    card.now_us = now_us;
    return card;
}

std::vector<sim::Row> scorecard(sim::ScorecardOptions& card) {
    ProgressBar bar("simulating");
    card.progress = [&](double share) { bar(share); };
    return sim::scorecard(card);
}

// The scenario over and over with the first seed.
void print_long_run(std::ostream& out, const sim::Course& course, const sim::Contestant& law, int frames) {
    out << course.scenario.name << ", " << law.name << ":\n   to frame    gain  over %  quality\n";
    for (const sim::Stretch& stretch : sim::endure(course, *law.make(course), 1, frames, stretches)) {
        out << std::setw(11) << stretch.end << std::fixed << std::setprecision(3) << std::setw(8) << stretch.gain
            << std::setprecision(2) << std::setw(8) << 100 * stretch.over_5pct << std::setprecision(3) << std::setw(9)
            << stretch.quality << '\n';
    }
}

void print_long_runs(const sim::ScorecardOptions& card, int frames) {
    OutputFile table("-");
    for (const sim::Scenario& scenario : card.scenarios) {
        const sim::Course course = sim::make_course(scenario);
        for (const sim::Contestant& law : card.laws) print_long_run(table.stream(), course, law, frames);
    }
    table.commit();
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
    app.add_option("--frames", options.frames,
                   "No scorecard, but one run of so many frames, the scenario over and over")
        ->needs(simulate)
        ->check(whole_number(1, most_frames));
    return simulate;
}

void check(const SimulateOptions& options) {
    const std::size_t scenarios = chosen_scenarios(options.scenario).size();
    const std::size_t laws = chosen_laws("--laws", options.laws).size();
    if (options.frames > 0 && !(options.csv.empty() && options.json.empty()))
        throw wrong_argument("--frames", "--csv or --json with it", "neither: a long run is only printed");
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
    if (options.frames > 0) return print_long_runs(card, options.frames);
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
