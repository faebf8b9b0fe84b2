// What the programs share at the command line: which arguments are taken, and how a run ends.
#include "apps/program.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

#include "apps/interrupt.h"

namespace apps {
namespace {

bool takes(const CLI::Validator& validator, const std::string& text) {
    std::string value = text;
    return validator(value).empty();
}

TEST(ProgramArguments, WholeNumbersAreTakenFromTheLeastToTheMost) {
    const CLI::Validator validator = whole_number(3, 70);
    for (const char* good : {"3", "4", "69", "70"}) EXPECT_TRUE(takes(validator, good)) << good;
    for (const char* bad :
         {"2", "71", "-3", "+3", "3.0", "3 ", " 3", "0x10", "", "three", "1e1", "99999999999999999999"}) {
        EXPECT_FALSE(takes(validator, bad)) << bad;
    }
    EXPECT_TRUE(takes(whole_number(0, ~std::uint64_t{0}), "18446744073709551615"));
}

TEST(ProgramArguments, NumbersAreTakenOverTheLeastAndUpToTheMost) {
    const CLI::Validator validator = number_over(0.5, 32);
    for (const char* good : {"0.5000001", "1", "3.2e1", "32"}) EXPECT_TRUE(takes(validator, good)) << good;
    for (const char* bad : {"0.5", "0", "-1", "32.001", "nan", "inf", "-inf", "", "1x", "1 "}) {
        EXPECT_FALSE(takes(validator, bad)) << bad;
    }
}

TEST(ProgramArguments, NamesAreTakenAsTheyStand) {
    static constexpr std::array<std::string_view, 2> names = {"paper", "safeguarded"};
    const CLI::Validator validator = one_of(names);
    for (const std::string_view name : names) EXPECT_TRUE(takes(validator, std::string(name))) << name;
    for (const char* bad : {"", "pape", "papers", "Paper", "paper,safeguarded"}) EXPECT_FALSE(takes(validator, bad));
    std::string text = "none";
    EXPECT_EQ(validator(text), "found 'none', expected one of: paper, safeguarded");
}

// The exit code of a run with these arguments, of which `--number` is kept.
struct Program {
    std::optional<int> number;
    bool has_run = false;

    int with(
        std::vector<std::string> arguments, const std::function<void()>& check = [] {},
        const std::function<void()>& body = [] {}) {
        CLI::App app("A test.", "program");
        app.add_option("--number", number, "A number")->check(whole_number(1, 9));
        describe(app, "Examples: none.");
        arguments.insert(arguments.begin(), "program");
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        const auto run = [&] {
            has_run = true;
            body();
        };
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = run_program(app, static_cast<int>(pointers.size()), pointers.data(), check, run);
        out = testing::internal::GetCapturedStdout();
        err = testing::internal::GetCapturedStderr();
        return code;
    }

    std::string out, err;
};

TEST(ProgramRuns, EndWithACodeForWhatHappened) {
    EXPECT_EQ(Program().with({}), 0);
    EXPECT_EQ(Program().with({"--number", "0"}), exit_usage);
    EXPECT_EQ(Program().with({"--no-such"}), exit_usage);
    EXPECT_EQ(Program().with({}, [] { throw std::invalid_argument("rule"); }), exit_usage);
    EXPECT_EQ(Program().with(
                  {}, [] {}, [] { throw std::runtime_error("disk"); }),
              exit_failure);
    EXPECT_EQ(Program().with(
                  {}, [] {}, [] { throw std::invalid_argument("late"); }),
              exit_failure);
    EXPECT_EQ(Program().with(
                  {}, [] {}, [] { throw std::bad_alloc(); }),
              exit_failure);
    EXPECT_EQ(Program().with(
                  {}, [] {}, [] { throw Interrupted(); }),
              exit_interrupted);
}

TEST(ProgramRuns, NothingRunsWhereArgumentsAreWrongOrHelpIsAsked) {
    for (const char* argument : {"--help", "--version", "--number=0", "surplus"}) {
        Program program;
        program.with(
            {argument}, [] {}, [] {});
        EXPECT_FALSE(program.has_run) << argument;
    }
    Program program;
    program.with({}, [] { throw std::invalid_argument("rule"); });
    EXPECT_FALSE(program.has_run);
    program.with({"--number", "5"});
    EXPECT_TRUE(program.has_run);
}

TEST(ProgramRuns, SayWhatWentWrongInOneLineOfStderr) {
    Program program;
    program.with(
        {}, [] {}, [] { throw std::runtime_error("found a\nbroken\nline\n"); });
    EXPECT_EQ(program.err, "program: found a broken line\n");
    EXPECT_EQ(program.out, "");
    program.with({"--number", "x"});
    EXPECT_TRUE(program.err.starts_with("program: ") && program.err.ends_with(" (see program --help)\n"))
        << program.err;
    program.with(
        {}, [] {}, [] { throw Interrupted(); });
    EXPECT_EQ(program.err, "program: interrupted\n");
    program.with({"--version"});
    EXPECT_EQ(program.out, "program " GRANDSTAND_VERSION "\n");
    EXPECT_EQ(program.err, "");
}

TEST(ProgramRuns, AnOptionGivenTwiceHoldsItsLastValue) {
    Program program;
    EXPECT_EQ(program.with({"--number", "3", "--number", "4"}), 0);
    EXPECT_EQ(program.number, 4);
}

}  // namespace
}  // namespace apps
