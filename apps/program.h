// What the programs share at the command line: how arguments are checked, and how a run ends.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace apps {

inline constexpr int exit_failure = 1;
inline constexpr int exit_usage = 2;

// For arguments that are wrong in ways the options' own checks can't see.
inline std::invalid_argument wrong_argument(const std::string& option, const std::string& found,
                                            const std::string& expected) {
    return std::invalid_argument(option + ": found " + found + ", expected " + expected);
}

// A whole number from `low` to `high`; a finite number over `low` and at most `high`.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);
CLI::Validator number_over(double low, double high);

// Adds --version and the examples, of which the last lines say the exit codes, to `app`.
void describe(CLI::App& app, const std::string& examples);

// Parses the arguments, calls `check`, then `body`, and gives the exit code: 0; exit_usage if the arguments or `check`
// (throws std::invalid_argument) are wrong; exit_failure if `body` throws. What went wrong is one line on stderr.
// An option given twice holds its last value.
int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& check,
                const std::function<void()>& body);

}  // namespace apps
