#include "sfsm/simulate/recorded.h"

#include <stdexcept>

namespace sfsm::simulate {

CostFit fit_costs(std::span<const TraceRow>) {
    throw std::runtime_error("found rows, expected a fit");
}

Scenario recorded_scenario(std::span<const TraceRow>, const RecordedOptions&) {
    throw std::runtime_error("found rows, expected a scenario");
}

}  // namespace sfsm::simulate
