// A run of the comparison: step by step of a plan, each kept as it comes.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/front/measure.h"
#include "tests/bench/front/plan.h"
#include "tests/bench/front/row.h"

namespace bench::front {

struct RunOptions {
    Size size{};
    bool with_opengl = true;
    Effort effort = usual_effort;
    std::filesystem::path references{};  // folder
    std::filesystem::path crops{};       // folder; empty: none
};

// The rows of `steps`, in their order. `known` are taken as they are; `keep` gets each of the others as soon as it is
// measured, with the share of the work that is done. Crowds are made one after the other, and only those that a row is
// missing of. Throws apps::Interrupted between steps.
std::vector<Row> run(std::span<const Step> steps, const RunOptions& options, const std::vector<Row>& known,
                     const std::function<void(const Row& row, double share_done)>& keep);

// What rows depend on beside what they name: the pictures that this build draws, their size, and the machine.
std::string about(const RunOptions& options, const Machine& machine);

// This one. `opengl`: the driver's name and version; empty: none.
Machine this_machine(const std::string& opengl);

}  // namespace bench::front
