// replay: how any recorded run went; any law over it: what the law would have made of it, or only decided, or whether
// it decided so; what the frames of a trace cost; and what laws are worth on simulated renderers.
#include "sfsm/replay.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/contestants.h"
#include "apps/explain.h"
#include "apps/output.h"
#include "apps/program.h"
#include "apps/replay_options.h"
#include "apps/rerun_text.h"
#include "apps/review.h"
#include "apps/session.h"
#include "apps/simulate.h"
#include "sfsm/number_text.h"
#include "sfsm/simulate/recorded.h"

namespace apps {
namespace {

using Json = nlohmann::ordered_json;

// The setting, which a check of the run cannot do without.
const std::string& required(const sfsm::Trace& trace, const std::string& path, const char* key) {
    const auto found = trace.settings.find(key);
    if (found != trace.settings.end()) return found->second;
    throw std::runtime_error(path + ": found no setting '" + key + "', expected a line '# " + key + "=...'");
}

void verify(const std::string& path) {
    const sfsm::Trace trace = read_own_trace(path);
    const std::string& state = required(trace, path, "state");
    if (state != "auto") {
        throw std::runtime_error(path + ": found state=" + state +
                                 ", decisions that were forced, expected state=auto: nothing to verify");
    }
    required(trace, path, "delay");
    required(trace, path, "law");
    const auto law = make_law(law_of(trace, false), sfsm::trace_drawing(trace));
    const std::vector<sfsm::Replayed> replayed = sfsm::replay(*law, trace.rows, sfsm::trace_delay(trace));
    const auto difference = sfsm::first_difference(trace.rows, replayed);
    if (difference) {
        throw std::runtime_error(path + ": frame " + std::to_string(difference->frame) + ": found " +
                                 difference->field + " " + sfsm::number_text(difference->recorded) + ", expected " +
                                 sfsm::number_text(difference->decided) + " of law " + trace.settings.at("law") +
                                 ": the trace is damaged, or the law has changed since");
    }
    std::cout << path << ": all " << replayed.size() << " decisions of law " << trace.settings.at("law")
              << " reproduced to the bit\n";
}

void explain(const ReplayOptions& options) {
    const sfsm::Trace trace = read_own_trace(options.recordings.front());
    if (options.laws.empty()) {
        required(trace, options.recordings.front(), "law");
        return write_explanation(std::cout, trace, *options.explained, law_of(trace, false));
    }
    std::string gap;
    for (const sfsm::simulate::Contestant& law : chosen_laws("--law", options.laws)) {
        if (needs_course(law)) continue;
        std::cout << std::exchange(gap, "\n");
        write_explanation(std::cout, trace, *options.explained, law);
    }
}

void fit(const ReplayOptions& options) {
    std::optional<OutputFile> json;
    if (!options.json.empty()) json.emplace(options.json);
    const sfsm::Trace trace = read_own_trace(options.recordings.front());
    const auto fitted = made_of(options.recordings.front(),
                                [&] { return sfsm::simulate::fit_costs(trace.rows, sfsm::trace_drawing(trace)); });
    if (json) {
        json->stream() << fit_json(fitted).dump(2) << '\n';
        json->commit();
    }
    if (options.json != "-") write_fit(std::cout, fitted);
}

void run(const ReplayOptions& options) {
    if (!options.simulated.scenario.empty()) return simulate(options.simulated);
    if (options.verify) return verify(options.recordings.front());
    if (options.explained) return explain(options);
    if (options.fit) return fit(options);
    review(options);
}

}  // namespace
}  // namespace apps

int main(int argc, char** argv) {
    CLI::App app("Says how recorded runs went, and what control laws would have made of a recorded or a simulated one.",
                 "replay");
    apps::ReplayOptions options;
    apps::add_replay_options(app, options);
    return apps::run_program(
        app, argc, argv, [&] { check(options); }, [&] { apps::run(options); });
}
