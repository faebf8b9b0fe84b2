// Reruns and cost fits to read: for people, for programs, and as runs of a report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "apps/rerun.h"
#include "sfsm/report/report.h"
#include "sfsm/simulate/recorded.h"

namespace apps {

// Runs of one table: with the scores of a closed loop where any has metrics, without values where it has none itself.
std::vector<sfsm::ReportRun> report_runs(std::span<const Rerun> reruns);

// A table of the runs' scores, a line a figure and a column a run.
void write_scores(std::ostream& out, std::span<const sfsm::ReportRun> runs);

// The summary's figures, then the metrics' where there are any; null for what is no number.
nlohmann::ordered_json rerun_json(const Rerun& rerun);

void write_fit(std::ostream& out, const sfsm::simulate::CostFit& fit);
nlohmann::ordered_json fit_json(const sfsm::simulate::CostFit& fit);

}  // namespace apps
