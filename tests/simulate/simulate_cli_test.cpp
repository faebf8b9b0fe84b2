// The simulate mode of the replay program as a user meets it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/command.h"

namespace {

using tests::Directory;
using tests::Outcome;
using tests::run;

TEST(Simulate, PrintsATableWithTheLawsAskedFor) {
    const Outcome outcome = run("replay", "--simulate quiet --laws paper,filament --seeds 2");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("quiet: ")) << outcome.out;
    EXPECT_NE(outcome.out.find("\npaper "), std::string::npos);
    EXPECT_NE(outcome.out.find("\nfilament "), std::string::npos);
    EXPECT_EQ(outcome.out.find("\nintel "), std::string::npos);
}

TEST(Simulate, JsonOnStandardOutputComesWithoutTheTable) {
    const Outcome outcome = run("replay", "--simulate quiet --laws oracle,paper --seeds 1 --json -");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(json.at("rows").size(), 3u);
    EXPECT_EQ(json["rows"][1]["scenario"], "quiet");
    EXPECT_EQ(json["rows"][1]["law"], "paper");
    EXPECT_GT(json["rows"][1]["us_per_frame"], 0);
}

TEST(Simulate, AllLawsTakePart) {
    const Outcome outcome = run("replay", "--simulate quiet --laws all --seeds 1");
    for (const char* law : {"oracle", "predictive", "paper", "filament", "robust-mpc", "offline-table"}) {
        EXPECT_NE(outcome.out.find("\n" + std::string(law) + " "), std::string::npos) << law;
    }
}

TEST(Simulate, ItsTraceIsReproducedToTheBit) {
    const Directory folder;
    // Without forecast, with one, and with times that are none.
    for (const char* run_of : {"toy --laws paper", "camera-cut --laws predictive", "pause --laws predictive"}) {
        const Outcome made = run("replay", std::string("--simulate ") + run_of + " --seeds 1 --csv " +
                                               (folder / "run.csv") + " --json " + (folder / "card.json"));
        ASSERT_EQ(made.code, 0) << made.err;
        const Outcome verified = run("replay", (folder / "run.csv") + " --verify");
        EXPECT_EQ(verified.code, 0) << run_of << ": " << verified.err;
        EXPECT_NE(verified.out.find("reproduced to the bit"), std::string::npos) << verified.out;
        EXPECT_TRUE(nlohmann::json::accept(tests::read_file(folder / "card.json")));
    }
}

TEST(Simulate, ALongRunIsPrintedInStretches) {
    const Outcome outcome = run("replay", "--simulate quiet --laws paper,predictive --frames 40000");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("quiet, paper:\n")) << outcome.out;
    EXPECT_NE(outcome.out.find("quiet, predictive:\n"), std::string::npos);
    EXPECT_NE(outcome.out.find("\n       2000 "), std::string::npos) << "twenty of them";
    EXPECT_NE(outcome.out.find("\n      40000 "), std::string::npos);
}

TEST(Simulate, UsageErrorsAreOneLineAndCode2) {
    const std::pair<const char*, const char*> bads[] = {
        {"--simulate bogus", "paper-1"},
        {"--simulate toy --laws bogus", "filament"},
        {"--simulate toy --seeds 0", "--seeds"},
        {"--simulate toy --seeds many", "--seeds"},
        {"--simulate toy trace.csv", "RECORDING"},
        {"--simulate toy --law paper", "--law"},
        {"--simulate toy --verify", "--verify"},
        {"--simulate toy --frames 0", "--frames"},
        {"--simulate toy --laws paper --frames 9 --json out.json", "--frames"},
        {"--frames 9", "--simulate"},
        {"--simulate toy --csv run.csv", "one scenario and one law"},
        {"--simulate all --laws paper --csv run.csv", "one scenario and one law"},
        {"--simulate toy --laws paper --csv - --json -", "at most one"},
        {"--json -", "--simulate"},
        {"--laws paper", "--simulate"},
    };
    for (const auto& [arguments, named] : bads) {
        const Outcome outcome = run("replay", arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
        EXPECT_NE(outcome.err.find(named), std::string::npos) << arguments << ": " << outcome.err;
        EXPECT_EQ(outcome.out, "") << arguments;
    }
}

TEST(Simulate, NothingIsRunWhereTheResultCannotBeWritten) {
    const Directory folder;
    const Outcome outcome = run("replay", "--simulate all --json " + (folder / "no/such/card.json"));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
    EXPECT_NE(outcome.err.find("cannot write"), std::string::npos);
}

TEST(Simulate, HelpShowsHow) {
    const Outcome outcome = run("replay", "--help");
    EXPECT_EQ(outcome.code, 0);
    for (const char* word : {"--simulate", "--laws", "--seeds", "--json", "replay --simulate toy"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
    }
}

}  // namespace
