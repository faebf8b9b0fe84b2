#include "apps/program.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <optional>

#include "apps/interrupt.h"

namespace apps {

namespace {

template <typename Number>
bool read_all(const std::string& text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

// CLI11 may spread a message over lines; ours is one.
int report(const CLI::App& app, std::string message, int code) {
    while (!message.empty() && message.back() == '\n') message.pop_back();
    for (char& c : message) c = c == '\n' ? ' ' : c;
    std::cerr << app.get_name() << ": " << message << '\n';
    return code;
}

int report_usage(const CLI::App& app, const std::string& message) {
    return report(app, message + " (see " + app.get_name() + " --help)", exit_usage);
}

// A file opened while descriptor 1 is closed would get that number, and then what is printed. Whoever started us so
// gets an error instead when something is written.
void hold_standard_descriptors() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        const bool closed = ::fcntl(descriptor, F_GETFD) < 0;
        // The lowest free number is the one just found; not closed again, as it is the program's to the end.
        if (closed && ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) != descriptor) return;
    }
}

// CLI11 gives an option whatever comes next, so that a forgotten value would swallow an option.
void refuse_options_as_values(CLI::App& app) {
    const auto check = [](const std::string& text) {
        return text.starts_with("--") ? "found the option " + text + ", expected a value" : std::string();
    };
    for (CLI::Option* option : app.get_options())
        if (!option->get_positional() && option->get_items_expected_max() > 0) option->check(CLI::Validator(check, ""));
}

// The exit code, if there is nothing to run.
std::optional<int> read_arguments(CLI::App& app, int argc, char** argv, const std::function<void()>& check) {
    refuse_options_as_values(app);
    for (CLI::Option* option : app.get_options())
        if (option->get_items_expected_max() == 1) option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    try {
        app.parse(argc, argv);
        check();
        return std::nullopt;
    } catch (const CLI::Success& request) {  // --help and --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        return report_usage(app, error.what());
    } catch (const std::invalid_argument& error) {
        return report_usage(app, error.what());
    }
}

int run_body(const CLI::App& app, const std::function<void()>& body) {
    try {
        body();
        return 0;
    } catch (const Interrupted& error) {
        return report(app, error.what(), exit_interrupted);
    } catch (const std::bad_alloc&) {
        return report(app, "found too little memory for what was asked, expected enough", exit_failure);
    } catch (const std::exception& error) {
        return report(app, error.what(), exit_failure);
    }
}

// What was printed may wait in a buffer: only what has arrived counts as done.
int flush_stdout(const CLI::App& app) {
    errno = 0;
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    if (flushed && std::cout && !std::ferror(stdout)) return 0;
    const std::string reason = errno != 0 ? std::strerror(errno) : "an earlier write failed";
    return report(app, "cannot write standard output: " + reason, exit_failure);
}

}  // namespace

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
    const std::string range = std::to_string(low) + " to " + std::to_string(high);
    const auto check = [=](const std::string& text) -> std::string {
        std::uint64_t number = 0;
        if (read_all(text, number) && number >= low && number <= high) return {};
        return "found '" + text + "', expected a whole number from " + range;
    };
    return CLI::Validator(check, "[" + std::to_string(low) + " - " + std::to_string(high) + "]");
}

CLI::Validator number_over(double low, double high) {
    const std::string range = "over " + CLI::detail::to_string(low) + " and at most " + CLI::detail::to_string(high);
    const auto check = [=](const std::string& text) -> std::string {
        double number = 0;
        if (read_all(text, number) && number > low && number <= high) return {};
        return "found '" + text + "', expected a number " + range;
    };
    return CLI::Validator(check, "(" + range + ")");
}

CLI::Validator one_of(std::span<const std::string_view> names) {
    std::string list;
    for (const std::string_view name : names) list.append(list.empty() ? "" : ", ").append(name);
    const auto check = [=](const std::string& text) -> std::string {
        if (std::find(names.begin(), names.end(), text) != names.end()) return {};
        return "found '" + text + "', expected one of: " + list;
    };
    return CLI::Validator(check, "{" + list + "}");
}

void describe(CLI::App& app, const std::string& examples) {
    app.set_version_flag("--version", app.get_name() + " " + GRANDSTAND_VERSION);
    app.footer(examples + "\nExit codes: 0 done, 1 failed, 2 usage, 130 interrupted.");
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& check,
                const std::function<void()>& body) {
    hold_standard_descriptors();
    watch_signals();
    const std::optional<int> answered = read_arguments(app, argc, argv, check);
    const int code = answered ? *answered : run_body(app, body);
    return code == 0 ? flush_stdout(app) : code;
}

}  // namespace apps
