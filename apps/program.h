// What the programs share at the command line: how arguments are checked, and how a run ends.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace apps {

inline constexpr int exit_failure = 1;
inline constexpr int exit_usage = 2;
inline constexpr int exit_interrupted = 130;  // as shells report SIGINT

// For arguments that are wrong in ways the options' own checks can't see.
inline std::invalid_argument wrong_argument(const std::string& option, const std::string& found,
                                            const std::string& expected) {
    return std::invalid_argument(option + ": found " + found + ", expected " + expected);
}

// A whole number from `low` to `high`; a finite number over `low` and at most `high`.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);
CLI::Validator number_over(double low, double high);

// One of `names`, which are static; --help lists them.
CLI::Validator one_of(std::span<const std::string_view> names);

// Adds --version and the examples, of which the last lines say the exit codes, to `app`.
void describe(CLI::App& app, const std::string& examples);

// Parses the arguments, calls `check`, then `body`, and gives the exit code: 0; exit_usage if the arguments or `check`
// (throws std::invalid_argument) are wrong; exit_interrupted if `body` throws Interrupted; exit_failure if it throws
// anything else, or if what was printed did not reach standard output. What went wrong is one line on stderr.
// An option given twice holds its last value. Half-written files are removed when a signal ends the program.
int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& check,
                const std::function<void()>& body);

}  // namespace apps
