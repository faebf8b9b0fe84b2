#include "apps/program.h"

#include <charconv>
#include <iostream>
#include <new>

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

void describe(CLI::App& app, const std::string& examples) {
    app.set_version_flag("--version", app.get_name() + " " + GRANDSTAND_VERSION);
    app.footer(examples + "\nExit codes: 0 done, 1 failed, 2 usage.");
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& check,
                const std::function<void()>& body) {
    for (CLI::Option* option : app.get_options())
        if (option->get_items_expected_max() == 1) option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    try {
        app.parse(argc, argv);
        check();
    } catch (const CLI::Success& request) {  // --help and --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        return report_usage(app, error.what());
    } catch (const std::invalid_argument& error) {
        return report_usage(app, error.what());
    }
    try {
        body();
        return 0;
    } catch (const std::bad_alloc&) {
        return report(app, "found too little memory for what was asked, expected enough", exit_failure);
    } catch (const std::exception& error) {
        return report(app, error.what(), exit_failure);
    }
}

}  // namespace apps
