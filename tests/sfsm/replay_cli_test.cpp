// The replay program as a user meets it: exit codes, messages, files.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "sfsm/paper.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {
namespace {

namespace fs = std::filesystem;

struct Outcome {
    int code = -1;
    std::string text;  // both streams
};

Outcome replay(const std::string& arguments) {
    const std::string command = std::string("'") + GRANDSTAND_BIN + "/replay' " + arguments + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    Outcome outcome;
    std::array<char, 4096> buffer;
    for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) outcome.text.append(buffer.data(), n);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

bool is_one_line(const std::string& text) {
    return text.find('\n') + 1 == text.size();
}

class ReplayProgram : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() /
                  ("grandstand_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
                   std::to_string(::getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string content(const std::string& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }

    Trace recorded() const {
        PaperLaw law;
        const Target target = [](std::int64_t frame) { return frame < 30 ? 1000.0 : 300.0; };
        Trace trace;
        trace.rows = run(law, {exact({600, 300, 35, 600}), target, 100, 2});
        trace.settings = {{"law", "paper"}, {"state", "auto"}, {"delay", "2"}, {"seed", "1"}, {"people", "20000"}};
        return trace;
    }
    std::string save(const Trace& trace, const std::string& name = "t.csv") const {
        std::ofstream out(path(name), std::ios::binary);
        write_trace_header(out, trace.settings);
        for (const TraceRow& row : trace.rows) write_trace_row(out, row);
        return path(name);
    }

    fs::path folder_;
};

TEST_F(ReplayProgram, HelpAndVersionSucceed) {
    const Outcome help = replay("--help"), version = replay("--version");
    EXPECT_EQ(help.code, 0);
    for (const char* word : {"--verify", "--target-ms", "--csv", "--summary", "--law", "Examples:"}) {
        EXPECT_NE(help.text.find(word), std::string::npos) << word;
    }
    EXPECT_EQ(version.code, 0);
    EXPECT_TRUE(version.text.starts_with("replay ")) << version.text;
}

TEST_F(ReplayProgram, UsageErrorsAreOneLineAndCode2) {
    const std::string trace = save(recorded());
    const std::pair<std::string, const char*> bads[] = {
        {"", "found no TRACE"},
        {"--nonsense", "--nonsense"},
        {trace + " --nonsense", "--nonsense"},
        {trace + " --law papier", "papier"},
        {trace + " --target-ms nan", "nan"},
        {trace + " --target-ms 10,5@3,4@2", "expected a frame"},
        {trace + " --csv - --summary -", "at most one"},
        {trace + " --verify --target-ms 5", "--verify"},
        {trace + " another.csv", "another.csv"},
        {trace + " --csv", "--csv"},
    };
    for (const auto& [arguments, named] : bads) {
        const Outcome outcome = replay(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments << ": " << outcome.text;
        EXPECT_NE(outcome.text.find(named), std::string::npos) << arguments << ": " << outcome.text;
        EXPECT_TRUE(is_one_line(outcome.text)) << outcome.text;
    }
}

TEST_F(ReplayProgram, BadFilesAreOneLineAndCode1) {
    std::ofstream(path("damaged.csv")) << "# law=paper\nhello\n";
    const std::string trace = save(recorded());
    const std::pair<std::string, const char*> bads[] = {
        {path("missing.csv"), "missing.csv: No such file"},
        {path("damaged.csv"), "damaged.csv:2: found 0 columns 'frame', expected"},
        {folder_.string(), "expected"},
        {trace + " --csv " + path("no/such/folder.csv"), "cannot write"},
        {trace + " --csv " + folder_.string(), "found a directory, expected a file"},
        {trace + " --csv /dev/full", "cannot write /dev/full: No space left"},
    };
    for (const auto& [arguments, named] : bads) {
        const Outcome outcome = replay(arguments);
        EXPECT_EQ(outcome.code, 1) << arguments << ": " << outcome.text;
        EXPECT_NE(outcome.text.find(named), std::string::npos) << arguments << ": " << outcome.text;
        EXPECT_TRUE(is_one_line(outcome.text)) << outcome.text;
    }
}

TEST_F(ReplayProgram, VerifiesARecordedRun) {
    const Outcome outcome = replay(save(recorded()) + " --verify");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("all 100 decisions of law paper reproduced to the bit"), std::string::npos)
        << outcome.text;
}

TEST_F(ReplayProgram, NamesTheFrameAndFieldThatAreNotReproduced) {
    Trace trace = recorded();
    trace.rows[57].decision.splat_size += 0.25;
    const Outcome outcome = replay(save(trace) + " --verify");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.text.find("frame 57: found splat_px"), std::string::npos) << outcome.text;
    EXPECT_TRUE(is_one_line(outcome.text)) << outcome.text;
}

TEST_F(ReplayProgram, WillNotVerifyWhatWasForcedOrNotSaid) {
    Trace forced = recorded();
    forced.settings["state"] = "2";
    Outcome outcome = replay(save(forced) + " --verify");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.text.find("found state=2"), std::string::npos) << outcome.text;
    for (const char* key : {"law", "state", "delay"}) {
        Trace trace = recorded();
        trace.settings.erase(key);
        outcome = replay(save(trace) + " --verify");
        EXPECT_EQ(outcome.code, 1) << key;
        EXPECT_NE(outcome.text.find("found no setting '" + std::string(key) + "'"), std::string::npos) << outcome.text;
    }
}

TEST_F(ReplayProgram, NamesTheTraceWhoseDelayIsNone) {
    Trace trace = recorded();
    trace.settings["delay"] = "99";
    const std::string saved = save(trace);
    for (const char* option : {" --verify", ""}) {
        const Outcome outcome = replay(saved + option);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.text.find(saved + ": found setting delay=99"), std::string::npos) << outcome.text;
    }
}

TEST_F(ReplayProgram, WritesATraceThatVerifiesAgain) {
    const std::string trace = save(recorded());
    ASSERT_EQ(replay(trace + " --target-ms 200,50@40 --csv " + path("out.csv")).code, 0);
    const Outcome again = replay(path("out.csv") + " --verify");
    EXPECT_EQ(again.code, 0) << again.text;
    EXPECT_NE(content("out.csv").find("# target_ms=200,50@40\n"), std::string::npos);
}

TEST_F(ReplayProgram, UnchangedInputGivesTheSameDecisions) {
    const std::string trace = save(recorded());
    ASSERT_EQ(replay(trace + " --csv " + path("out.csv")).code, 0);
    const auto rows_of = [](const std::string& text) { return text.substr(text.find("frame,target_ms")); };
    EXPECT_EQ(rows_of(content("out.csv")), rows_of(content("t.csv")));
}

TEST_F(ReplayProgram, SummaryGoesToStandardOutputUnlessTheTraceDoes) {
    const std::string trace = save(recorded());
    EXPECT_NE(replay(trace).text.find("\"control_rate\""), std::string::npos);
    EXPECT_EQ(replay(trace + " --csv -").text.find("\"control_rate\""), std::string::npos);
    EXPECT_EQ(replay(trace + " --summary " + path("s.json")).text, "");
    EXPECT_NE(content("s.json").find("\"people\": 20000"), std::string::npos);
}

TEST_F(ReplayProgram, NothingHalfWrittenIsLeft) {
    const std::string trace = save(recorded());
    std::ofstream(path("out.csv")) << "older";
    ASSERT_EQ(replay(trace + " --csv " + path("out.csv") + " --summary " + path("no/such.json")).code, 1);
    EXPECT_EQ(content("out.csv"), "older");
    EXPECT_EQ(files(), 2u) << "the trace and the output, no temporary file";
    fs::create_symlink(path("out.csv"), path("link.csv"));
    ASSERT_EQ(replay(trace + " --csv " + path("link.csv")).code, 0);
    EXPECT_TRUE(fs::is_symlink(path("link.csv"))) << "a link is written through, not replaced";
    EXPECT_EQ(files(), 3u);
}

}  // namespace
}  // namespace sfsm
