// The replay program as a user meets it: exit codes, messages, files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sfsm/controller.h"
#include "sfsm/replay.h"
#include "sfsm/status_text.h"
#include "sfsm/trace.h"
#include "tests/command.h"
#include "tests/sfsm/rate_scene.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using tests::Directory;
using tests::Outcome;

Outcome replay(const std::string& arguments) {
    return tests::run("replay", arguments);
}

// A run whose work is known, as stadium would have recorded it; made once.
sfsm::Trace recorded() {
    static const std::string text = replay("--simulate camera-cut --laws predictive --seeds 1 --csv -").out;
    std::istringstream in(text);
    sfsm::Trace trace = sfsm::read_trace(in, "camera-cut");
    trace.rows.resize(600);
    return trace;
}

std::string text_of(const sfsm::Trace& trace) {
    std::ostringstream out;
    sfsm::write_trace_header(out, trace.settings);
    for (const sfsm::TraceRow& row : trace.rows) write_trace_row(out, row);
    return out.str();
}

class ReplayProgram : public testing::Test {
protected:
    std::string save(const sfsm::Trace& trace, const std::string& name = "t.csv") const {
        std::ofstream(folder_ / name, std::ios::binary) << text_of(trace);
        return folder_ / name;
    }
    // Two processes, as PresentMon interleaves them.
    std::string capture() const {
        std::ofstream file(folder_ / "game.csv");
        file << "Application,ProcessID,SwapChainAddress,TimeInSeconds,MsBetweenPresents,Dropped\n";
        for (int i = 0; i < 400; ++i) {
            if (i % 3 == 0) file << "dwm.exe,7,0x1," << 0.048 * i << ",48,0\n";
            file << "game.exe,42,0x2," << 0.016 * i << ',' << (i < 200 ? 16 : 32) << ",0\n";
        }
        return folder_ / "game.csv";
    }
    std::string in_folder(const std::string& name) const { return folder_ / name; }
    std::string content(const std::string& name) const { return tests::read_file(folder_ / name); }

    Directory folder_;
};

TEST_F(ReplayProgram, HelpAndVersionSucceed) {
    const Outcome help = replay("--help"), version = replay("--version");
    EXPECT_EQ(help.code, 0);
    for (const char* word :
         {"--verify", "--explain FRAME", "--fit", "--open-loop", "--delay", "--process", "--swap-chain", "--column",
          "--unit", "--target-ms", "--csv", "--json", "--report", "--svg", "--law", "Examples:"}) {
        EXPECT_NE(help.out.find(word), std::string::npos) << word;
    }
    EXPECT_EQ(version.code, 0);
    EXPECT_TRUE(version.out.starts_with("replay ")) << version.out;
}

TEST_F(ReplayProgram, UsageErrorsAreOneLineAndCode2) {
    const std::string trace = save(recorded());
    const std::pair<std::string, const char*> bads[] = {
        {"", "found no RECORDING"},
        {"--nonsense", "--nonsense"},
        {trace + " --nonsense", "--nonsense"},
        {trace + " --law papier", "papier"},
        {trace + " --target-ms nan", "nan"},
        {trace + " --target-ms 10,5@3,4@2", "expected a frame"},
        {trace + " --delay 17", "--delay"},
        {trace + " --unit parsec", "--unit"},
        {trace + " --delay -1", "--delay"},
        {trace + " --csv - --json -", "stdout"},
        {trace + " --report - --svg -", "stdout"},
        {trace + " --csv x.csv --law paper,predictive", "one law"},
        {trace + " --open-loop --law oracle", "oracle"},
        {trace + " --verify --target-ms 5", "--verify"},
        {trace + " --explain x", "--explain"},
        {trace + " --explain 1.5", "--explain"},
        {trace + " --explain 3 --verify", "--explain"},
        {trace + " --explain 3 --delay 1", "--explain"},
        {trace + " --explain 3 --law oracle", "oracle"},
        {"--explain 3", "found no RECORDING"},
        {trace + " --fit --law paper", "--fit"},
        {trace + " --json " + trace, "--json"},
        {trace + " another.csv --law paper", "found 2 recordings, expected one with --law"},
        {trace + " another.csv --verify", "found 2 recordings"},
        {"- -", "found - twice"},
        {trace + " --csv", "--csv"},
    };
    for (const auto& [arguments, named] : bads) {
        const Outcome outcome = replay(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments << ": " << outcome.err;
        EXPECT_NE(outcome.err.find(named), std::string::npos) << arguments << ": " << outcome.err;
        EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
    }
}

TEST_F(ReplayProgram, BadFilesAreOneLineAndCode1) {
    std::ofstream(in_folder("damaged.csv")) << "# law=paper\nhello\n";
    std::ofstream(in_folder("empty.csv"));
    sfsm::Trace unmeasured = recorded();
    for (sfsm::TraceRow& row : unmeasured.rows) row.frame_ms = NAN;
    sfsm::Trace too_slow = recorded();
    for (sfsm::TraceRow& row : too_slow.rows) row.target_ms = 1e7;
    const std::string trace = save(recorded()), folder = fs::path(trace).parent_path();
    fs::create_directory(in_folder("none"));
    const std::pair<std::string, const char*> bads[] = {
        {in_folder("missing.csv"), "missing.csv: No such file"},
        {in_folder("damaged.csv"), "damaged.csv:2: found"},
        {in_folder("empty.csv"), "empty.csv"},
        {in_folder("none"), "none: found no file in the folder"},
        {save(unmeasured, "unmeasured.csv"), "unmeasured.csv: found no time in 600 frames"},
        {save(unmeasured, "unmeasured.csv") + " --fit", "unmeasured.csv: found 0 frames with a time"},
        {save(too_slow, "too_slow.csv") + " --law paper", "too_slow.csv: frame 0: found target 1e+07 ms"},
        {capture() + " --process nobody.exe", "game.exe"},
        {capture() + " --swap-chain 0x9", "game.exe"},
        {capture() + " --verify", "expected a trace of ours"},
        {capture() + " --fit", "expected a trace of ours"},
        {capture() + " --explain 3", "expected a trace of ours"},
        {trace + " --explain 600", "t.csv: found no frame 600, expected one from 0 to 599"},
        {trace + " --explain -1", "t.csv: found no frame -1, expected one from 0 to 599"},
        {trace + " --csv " + in_folder("no/such/folder.csv"), "cannot write"},
        {trace + " --csv " + folder, "found a directory, expected a file"},
        {trace + " --report /dev/full", "cannot write /dev/full: No space left"},
    };
    for (const auto& [arguments, named] : bads) {
        const Outcome outcome = replay(arguments);
        EXPECT_EQ(outcome.code, 1) << arguments << ": " << outcome.err;
        EXPECT_NE(outcome.err.find(named), std::string::npos) << arguments << ": " << outcome.err;
        EXPECT_EQ(outcome.out, "") << arguments;
    }
}

TEST_F(ReplayProgram, VerifiesARecordedRun) {
    const Outcome outcome = replay(save(recorded()) + " --verify");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("all 600 decisions of law predictive reproduced to the bit"), std::string::npos)
        << outcome.out;
}

// The bowl by rate, as a renderer that knows rates would have recorded it.
sfsm::Trace recorded_by_rate() {
    sfsm::Trace trace;
    trace.settings = {{"law", "predictive"}, {"state", "auto"}, {"delay", "0"}, {"target_ms", "14"}};
    const auto law = sfsm::make_controller("predictive");
    for (std::int64_t frame = 0; frame < 200; ++frame) {
        const sfsm::RateScene scene = sfsm::bowl(20'000 + 5'000 * std::sin(0.05 * static_cast<double>(frame)));
        sfsm::TraceRow& row = trace.rows.emplace_back();
        row.frame = frame;
        row.target_ms = 14;
        row.range = sfsm::test_range;
        row.motion = scene.motion;
        row.shapes = scene.shapes;
        row.rates = scene.rates;
        row.decision = law->decide({row.target_ms, row.range, &scene.forecast});
        row.work = scene.work(row.decision);
        row.frame_ms = scene.ms(row.work);
        law->observe({frame, row.frame_ms, row.decision, row.work});
    }
    return trace;
}

TEST_F(ReplayProgram, DecisionsByRateAreReproducedToTheBitAndRerun) {
    const sfsm::Trace trace = recorded_by_rate();
    const std::string saved = save(trace);
    const Outcome verified = replay(saved + " --verify");
    EXPECT_EQ(verified.code, 0) << verified.err;
    EXPECT_NE(verified.out.find("all 200 decisions"), std::string::npos) << verified.out;
    for (const char* loop : {" --law predictive", " --open-loop"}) {
        const Outcome rerun = replay(saved + loop + " --csv -");
        ASSERT_EQ(rerun.code, 0) << rerun.err;
        std::istringstream in(rerun.out);
        const sfsm::Trace again = sfsm::read_trace(in, "again");
        ASSERT_EQ(again.rows.size(), trace.rows.size());
        for (std::size_t i = 0; i < again.rows.size(); ++i) {
            EXPECT_GT(again.rows[i].decision.rate, 0) << i;
            EXPECT_EQ(again.rows[i].rates, trace.rows[i].rates) << i;
        }
    }
}

TEST_F(ReplayProgram, NamesARateThatIsNotReproduced) {
    sfsm::Trace trace = recorded_by_rate();
    trace.rows[57].decision.rate = 0.25;
    const Outcome outcome = replay(save(trace) + " --verify");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("frame 57: found rate 0.25, expected "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("the law has changed since"), std::string::npos) << outcome.err;
    EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
}

TEST_F(ReplayProgram, NamesTheFrameAndFieldThatAreNotReproduced) {
    sfsm::Trace trace = recorded();
    trace.rows[57].decision.splat_size = 31.25;
    const Outcome outcome = replay(save(trace) + " --verify");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("frame 57: found splat_px 31.25"), std::string::npos) << outcome.err;
    EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
}

TEST_F(ReplayProgram, WillNotVerifyWhatWasForcedOrNotSaid) {
    sfsm::Trace forced = recorded();
    forced.settings["state"] = "2";
    Outcome outcome = replay(save(forced) + " --verify");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("found state=2"), std::string::npos) << outcome.err;
    for (const char* key : {"law", "state", "delay"}) {
        sfsm::Trace trace = recorded();
        trace.settings.erase(key);
        outcome = replay(save(trace) + " --verify");
        EXPECT_EQ(outcome.code, 1) << key;
        EXPECT_NE(outcome.err.find("found no setting '" + std::string(key) + "'"), std::string::npos) << outcome.err;
    }
}

// The numbers of a frame to explain are those that a program of one's own would see at it.
TEST_F(ReplayProgram, ExplainsWhatTheLawBelievedAndWhyItDecidedSo) {
    const sfsm::Trace trace = recorded();
    const std::string saved = save(trace);
    const std::span<const sfsm::TraceRow> rows(trace.rows);
    const int delay = sfsm::trace_delay(trace);
    for (const std::size_t frame : {0, 1, 5, 599}) {
        const Outcome outcome = replay(saved + " --explain " + std::to_string(frame));
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto controller = sfsm::make_controller("predictive");
        sfsm::replay(*controller, rows.first(frame + 1), delay);
        const auto holds = [&](const std::string& part) { return outcome.out.find(part) != std::string::npos; };
        EXPECT_TRUE(holds("t.csv: frame " + std::to_string(frame) + ", law predictive\n")) << outcome.out;
        EXPECT_TRUE(holds(sfsm::status_text(controller->status()))) << outcome.out;
        EXPECT_TRUE(holds("asked: " + sfsm::duration_text(rows[frame].target_ms) + ", L ")) << outcome.out;
        EXPECT_TRUE(
            holds("recorded: the same decision; the frame took " + sfsm::duration_text(rows[frame].frame_ms) + "\n"))
            << outcome.out;
        EXPECT_TRUE(holds("foreseen of that:\n")) << outcome.out;
    }
}

// What is said to be foreseen adds up to what is predicted, where forecasts aren't off.
TEST_F(ReplayProgram, ExplainsOfWhatAPredictionIsMadeUp) {
    const Outcome outcome = replay(save(recorded_by_rate()) + " --explain 199");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    double predicted = 0, sum = 0;
    bool is_foreseen = false;
    std::istringstream lines(outcome.out);
    const auto ms_after = [](const std::string& line) {
        std::istringstream words(line.substr(line.find(": ") + 2));
        double value = 0;
        std::string unit;
        words >> value >> unit;
        return value * (unit == "ms" ? 1 : unit == "us" ? 1e-3 : 1e-6);
    };
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("predicted: ")) predicted = ms_after(line);
        if (is_foreseen && line.starts_with("  ") && !line.starts_with("  lost: ")) sum += ms_after(line);
        is_foreseen |= line == "foreseen of that:";
    }
    EXPECT_GT(predicted, 0);
    EXPECT_NEAR(sum, predicted, 0.03 * predicted) << outcome.out;
}

TEST_F(ReplayProgram, ExplainsOtherLawsOnTheRecordedTimes) {
    const Outcome outcome = replay(save(recorded()) + " --explain 300 --law paper,safeguarded,valve");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* law : {"paper", "safeguarded", "valve"})
        EXPECT_NE(outcome.out.find(std::string("frame 300, law ") + law + "\n"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("another decision; with it the frame took"), std::string::npos) << outcome.out;
    EXPECT_EQ(replay(save(recorded()) + " --explain 300 --law all").code, 0);
    sfsm::Trace untold = recorded();
    untold.settings.erase("law");
    EXPECT_EQ(replay(save(untold) + " --explain 3").code, 1);
    EXPECT_EQ(replay(save(untold) + " --explain 3 --law paper").code, 0);
}

TEST_F(ReplayProgram, NamesTheTraceWhoseDelayIsNone) {
    sfsm::Trace trace = recorded();
    trace.settings["delay"] = "99";
    const std::string saved = save(trace);
    for (const char* option : {" --verify", ""}) {
        const Outcome outcome = replay(saved + option);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.err.find(saved + ": found setting delay='99'"), std::string::npos) << outcome.err;
    }
}

TEST_F(ReplayProgram, NamesTheTraceWhoseDrawingIsNone) {
    sfsm::Trace trace = recorded();
    trace.settings["draw"] = "vulkan";
    const std::string saved = save(trace);
    for (const char* option : {" --verify", " --fit", ""}) {
        const Outcome outcome = replay(saved + option);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.err.find(saved + ": found setting draw="), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("expected one of: gl native"), std::string::npos) << outcome.err;
    }
}

// What is believed of prices beforehand is that of what the frames were drawn by, in every use of a trace.
TEST_F(ReplayProgram, TakesTheBeliefsOfWhatDrewTheTrace) {
    sfsm::Trace trace = recorded();
    const std::string unsaid = save(trace, "unsaid.csv");
    trace.settings["draw"] = "gl";
    const std::string gl = save(trace, "gl.csv");
    trace.settings["draw"] = "native";
    const std::string native = save(trace, "native.csv");
    for (const std::string& same : {unsaid, gl}) EXPECT_EQ(replay(same + " --verify").code, 0) << same;
    EXPECT_EQ(replay(native + " --verify").code, 1) << "natively its law would have begun otherwise";
    EXPECT_EQ(replay(unsaid + " --fit --json -").out, replay(gl + " --fit --json -").out);
    for (const char* loop : {" --law predictive", " --open-loop"}) {
        ASSERT_EQ(replay(native + loop + " --csv " + in_folder("out.csv")).code, 0) << loop;
        EXPECT_NE(content("out.csv").find("# draw=native\n"), std::string::npos);
        const Outcome again = replay(in_folder("out.csv") + " --verify");
        EXPECT_EQ(again.code, 0) << loop << again.err;
    }
}

// Of the laws in a list "all" is what a user may say, but no law that a run had.
TEST_F(ReplayProgram, NamesTheTraceWhoseLawIsNone) {
    for (const char* law : {"papier", "all", "paper,predictive", ""}) {
        sfsm::Trace trace = recorded();
        trace.settings["law"] = law;
        const std::string saved = save(trace);
        for (const std::string option : {" --verify", " --open-loop"}) {
            const Outcome outcome = replay(saved + option);
            EXPECT_EQ(outcome.code, 1) << law << option;
            EXPECT_TRUE(
                outcome.err.starts_with("replay: " + saved + ": found setting law='" + law + "', expected one of: "))
                << outcome.err;
            EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
        }
        EXPECT_EQ(replay(saved + " --law paper").code, 0);
        EXPECT_EQ(replay(saved).code, 0) << "no law is asked for";
    }
}

// The first law runs while the file is still being read, on what is its first stream; the others after that.
TEST_F(ReplayProgram, ALawDecidesTheSameWhileTheFileIsRead) {
    const auto stream = [](std::ostream& out, const std::string& id, int from, int to) {
        for (int i = from; i < to; ++i)
            out << "game.exe," << id << ",0x" << id << ',' << 0.016 * i << ',' << 12 + i % 7 + (i % 1000 > 600 ? 9 : 0)
                << ",0\n";
    };
    const auto expect_the_same = [&](const std::string& name, const auto& write) {
        std::ofstream file(in_folder(name));
        file << "Application,ProcessID,SwapChainAddress,TimeInSeconds,MsBetweenPresents,Dropped\n";
        write(file);
        file.close();
        const auto run_of = [&](const std::string& laws, std::size_t place) {
            const Outcome outcome = replay(in_folder(name) + " --open-loop --law " + laws + " --json -");
            EXPECT_EQ(outcome.code, 0) << outcome.err;
            return json::parse(outcome.out).at("runs").at(place).dump();
        };
        EXPECT_EQ(run_of("predictive,paper", 0), run_of("paper,predictive", 1)) << name;
        EXPECT_EQ(run_of("predictive,predictive", 0), run_of("predictive,predictive", 1)) << name;
    };
    expect_the_same("one.csv", [&](std::ostream& out) { stream(out, "1", 0, 9000); });
    expect_the_same("short.csv", [&](std::ostream& out) { stream(out, "1", 0, 900); });
    expect_the_same("second.csv", [&](std::ostream& out) {
        stream(out, "1", 0, 5000);
        stream(out, "2", 1000, 9000);
    });
}

TEST_F(ReplayProgram, TheClairvoyantDecidesInClosedLoopsAlone) {
    const std::string trace = save(recorded());
    ASSERT_EQ(replay(trace + " --law oracle --csv " + in_folder("oracle.csv")).code, 0);
    EXPECT_EQ(replay(in_folder("oracle.csv")).code, 0);
    for (const std::string option : {" --verify", " --open-loop"}) {
        const Outcome outcome = replay(in_folder("oracle.csv") + option);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.err.find("oracle.csv: found setting law='oracle', which knows what frames cost"),
                  std::string::npos)
            << outcome.err;
    }
    const Outcome others = replay(trace + " --open-loop --law all --json -");
    ASSERT_EQ(others.code, 0) << others.err;
    const json runs = json::parse(others.out).at("runs");
    EXPECT_GT(runs.size(), 3u);
    for (const json& run : runs) EXPECT_NE(run.at("law"), "oracle");
}

TEST_F(ReplayProgram, WritesATraceThatVerifiesAgain) {
    const std::string trace = save(recorded());
    for (const std::string loop :
         {" --law predictive", " --open-loop", " --law valve", " --law robust-mpc --open-loop"}) {
        ASSERT_EQ(replay(trace + loop + " --target-ms 20,9@300 --delay 3 --csv " + in_folder("out.csv")).code, 0);
        const Outcome again = replay(in_folder("out.csv") + " --verify");
        EXPECT_EQ(again.code, 0) << again.err;
        EXPECT_NE(content("out.csv").find("# target_ms=20,9@300\n"), std::string::npos);
    }
}

TEST_F(ReplayProgram, AnOpenLoopOfUnchangedInputGivesTheSameDecisions) {
    sfsm::Trace trace = recorded();
    ASSERT_EQ(replay(save(trace) + " --open-loop --csv " + in_folder("out.csv")).code, 0);
    const auto rows_of = [](const std::string& text) { return text.substr(text.find("frame,target_ms")); };
    EXPECT_EQ(rows_of(content("out.csv")), rows_of(text_of(trace)));
}

// What became of the recorded decisions says nothing of others.
TEST_F(ReplayProgram, AnOpenLoopDoesNotKnowWhatBecameOfItsDecisions) {
    sfsm::Trace trace = recorded();
    const std::string unknown = text_of(trace);
    for (sfsm::TraceRow& row : trace.rows) row.drawn_state = sfsm::State::points;
    ASSERT_NE(text_of(trace), unknown);
    ASSERT_EQ(replay(save(trace) + " --open-loop --csv " + in_folder("out.csv")).code, 0);
    std::istringstream in(content("out.csv"));
    for (const sfsm::TraceRow& row : sfsm::read_trace(in, "out.csv").rows) ASSERT_FALSE(row.drawn_state);
}

// The load is the recording's whoever decides, and a law that aims at less takes less.
TEST_F(ReplayProgram, AClosedLoopAnswersToItsDecisions) {
    const std::string trace = save(recorded());
    const json loose = json::parse(replay(trace + " --law predictive --target-ms 20 --json -").out);
    const json tight = json::parse(replay(trace + " --law predictive --target-ms 8 --json -").out);
    EXPECT_EQ(loose["delay"], 2);
    EXPECT_EQ(loose["recorded"]["mean_ms"], tight["recorded"]["mean_ms"]);
    EXPECT_LT(tight["runs"][0]["p50_ms"], 9);
    EXPECT_GT(loose["runs"][0]["p50_ms"], tight["runs"][0]["p50_ms"]);
    EXPECT_LT(tight["runs"][0]["quality"], 1.01);
}

TEST_F(ReplayProgram, SeveralLawsGoIntoOneTableAndOneList) {
    const Outcome outcome = replay(save(recorded()) + " --law oracle,paper,filament --json " + in_folder("runs.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* text : {"  recorded    oracle     paper  filament\n", "\ncontrol rate [%] "})
        EXPECT_NE(outcome.out.find(text), std::string::npos) << outcome.out;
    const json runs = json::parse(content("runs.json")).at("runs");
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[1].at("law"), "paper");
    EXPECT_EQ(runs[1].at("frames"), 600);
}

TEST_F(ReplayProgram, TakesTheBusiestProcessOrTheOneAskedFor) {
    const Outcome busiest = replay(capture() + " --json -");
    ASSERT_EQ(busiest.code, 0) << busiest.err;
    EXPECT_EQ(json::parse(busiest.out).at("process"), "game.exe");
    EXPECT_EQ(json::parse(busiest.out).at("recorded").at("frames"), 400);
    EXPECT_NE(busiest.err.find("dwm.exe"), std::string::npos) << "the others are listed: " << busiest.err;
    const Outcome asked = replay(capture() + " --process dwm.exe --json -");
    ASSERT_EQ(asked.code, 0) << asked.err;
    EXPECT_EQ(json::parse(asked.out).at("recorded").at("frames"), 134);
}

TEST_F(ReplayProgram, WhatTheReaderDidStandsInTheFigures) {
    const json figures = json::parse(replay(capture() + " --open-loop --json -").out);
    ASSERT_EQ(figures.at("notes").size(), 1u);
    EXPECT_NE(figures.at("notes").at(0).get<std::string>().find("2 streams; taken: 'game.exe'"), std::string::npos);
    EXPECT_EQ(figures.at("generated"), 0);
    EXPECT_EQ(json::parse(replay(save(recorded()) + " --json -").out).at("notes"), json::array());
}

TEST_F(ReplayProgram, ReadsStandardInput) {
    const Outcome piped = tests::run("replay", "- --open-loop --json - < " + capture());
    ASSERT_EQ(piped.code, 0) << piped.err;
    json figures = json::parse(piped.out), of_file = json::parse(replay(capture() + " --open-loop --json -").out);
    EXPECT_EQ(figures.at("recording"), "-");
    for (const char* key : {"recording", "name"}) {
        figures.erase(key);
        of_file.erase(key);
    }
    EXPECT_EQ(figures, of_file);
}

TEST_F(ReplayProgram, TakesAColumnThatIsNamed) {
    std::ofstream(in_folder("bench.csv")) << "scene,GPU frame\na,8000\nb,8200\nc,8100\n";
    const Outcome outcome = replay(in_folder("bench.csv") + " --column 'gpu frame' --unit us --open-loop --json -");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NEAR(json::parse(outcome.out).at("recorded").at("mean_ms").get<double>(), 8.1, 1e-9);
    const Outcome unnamed = replay(in_folder("bench.csv"));
    EXPECT_EQ(unnamed.code, 1);
    EXPECT_NE(unnamed.err.find("found columns 'GPU frame', expected one of them named as --column"), std::string::npos)
        << unnamed.err;
}

TEST_F(ReplayProgram, FramesAreCountedAlikeEverywhere) {
    std::ofstream file(in_folder("game.csv"));
    file << "Application,MsBetweenPresents\ngame.exe,NA\n";
    for (int i = 0; i < 10; ++i) file << "game.exe,20\ngame.exe,0\n";
    file.close();
    const json figures = json::parse(replay(in_folder("game.csv") + " --open-loop --json -").out);
    EXPECT_EQ(figures.at("recorded").at("frames"), 10);
    EXPECT_EQ(figures.at("runs").at(0).at("frames"), 10);
    EXPECT_EQ(figures.at("generated"), 10);
    const std::string table = replay(in_folder("game.csv") + " --open-loop").out;
    EXPECT_NE(table.find(", 10 frames and 1 without a time\n"), std::string::npos) << table;
}

// Names are other people's: they can't steer a terminal, nor make two lines of one.
TEST_F(ReplayProgram, StreamsOfAnyNameAreListedOnOneLine) {
    std::ofstream(in_folder("runs.json"))
        << R"({"Info":{"ProcessName":"a\u001b[31m\nb"},"Runs":[{"CaptureData":{"MsBetweenPresents":[16,17]}},)"
        << R"({"CaptureData":{"MsBetweenPresents":[16]}}]})";
    const Outcome outcome = replay(in_folder("runs.json") + " --json -");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("taken: 'a?[31m?b' 'run 1' (2 frames); --process takes another of: 'a?[31m?b' 'run 2' "),
              std::string::npos)
        << outcome.err;
    EXPECT_TRUE(tests::one_line(outcome.err)) << outcome.err;
}

// 16 ms of load are held at 12 as soon as they are known, and 32 are too.
TEST_F(ReplayProgram, HoldsACaptureAtTheTarget) {
    const Outcome outcome = replay(capture() + " --law predictive --target-ms 12 --json -");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json figures = json::parse(outcome.out);
    EXPECT_EQ(figures.at("recorded").at("over_5pct"), 1);
    EXPECT_LT(figures.at("runs").at(0).at("over_5pct"), 0.05);
    EXPECT_GT(figures.at("runs").at(0).at("within_5pct"), 0.9);
}

// No law can miss a target that is out of reach for all: that is no zero to be proud of.
TEST_F(ReplayProgram, WhatNoFrameIsJudgedByIsNoFigure) {
    const json unmet =
        json::parse(replay(capture() + " --law predictive --target-ms 0.01 --json -").out).at("runs").at(0);
    EXPECT_EQ(unmet.at("over_5pct"), 1);
    for (const char* name : {"over_target", "worst_second", "hitch_ms_per_s", "overshoot_pct"})
        EXPECT_TRUE(unmet.at(name).is_null()) << name;
    const json met = json::parse(replay(capture() + " --law predictive --target-ms 12 --json -").out).at("runs").at(0);
    for (const char* name : {"over_target", "worst_second", "hitch_ms_per_s", "overshoot_pct"})
        EXPECT_TRUE(met.at(name).is_number()) << name;
    const Outcome table = replay(capture() + " --law predictive --target-ms 0.01");
    EXPECT_NE(table.out.find("\nlate [ms/s]                          -           -\n"), std::string::npos) << table.out;
}

TEST_F(ReplayProgram, FitsWhatWorkCost) {
    const Outcome outcome = replay(save(recorded()) + " --fit --json " + in_folder("fit.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("R2"), std::string::npos) << outcome.out;
    const json fit = json::parse(content("fit.json"));
    EXPECT_GT(fit.at("r2"), 0.5);
    EXPECT_LE(fit.at("residual").at("p5"), fit.at("residual").at("p95"));
    for (const auto& [name, price] : fit.at("prices_ms").items()) EXPECT_GE(price, 0) << name;
}

TEST_F(ReplayProgram, DrawsReports) {
    const Outcome outcome = replay(save(recorded()) + " --law paper,predictive --report " + in_folder("r.html") +
                                   " --svg " + in_folder("r.svg"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(content("r.html").starts_with("<!DOCTYPE html>")) << content("r.html").substr(0, 100);
    EXPECT_NE(content("r.svg").find("<svg"), std::string::npos);
}

TEST_F(ReplayProgram, TheTableGoesToStandardOutputUnlessAFileDoes) {
    const std::string trace = save(recorded());
    EXPECT_NE(replay(trace).out.find("\ncontrol rate "), std::string::npos);
    EXPECT_EQ(replay(trace + " --csv -").out.find("\ncontrol rate "), std::string::npos);
    EXPECT_NE(replay(trace + " --json " + in_folder("s.json")).out.find("\ncontrol rate "), std::string::npos);
}

// A game's log of frames of one length, but for one that is ten times as long.
void write_log(const std::string& path, double ms, int frames = 300) {
    std::ofstream file(path);
    file << "Application,ProcessID,SwapChainAddress,MsBetweenPresents,MsUntilDisplayed\n";
    for (int i = 0; i < frames; ++i)
        file << "game.exe,1,0x1," << (i == 100 ? 10 * ms : ms + 0.01 * (i % 7)) << ',' << 5 << '\n';
}

TEST_F(ReplayProgram, WithoutALawARecordingIsOnlyLookedAt) {
    write_log(in_folder("game.csv"), 10);
    const Outcome outcome = replay(in_folder("game.csv") + " --json " + in_folder("g.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("control rate"), std::string::npos) << outcome.out;
    const auto parsed = json::parse(content("g.json"));
    EXPECT_EQ(parsed.at("runs"), json::array());
    for (const char* key : {"loop", "delay", "cost model", "target_ms"}) EXPECT_FALSE(parsed.contains(key)) << key;
    EXPECT_FALSE(parsed.at("recorded").contains("control_rate"));
    const auto& figures = parsed.at("recorded").at("figures");
    EXPECT_EQ(figures.at("frames"), 300);
    EXPECT_NEAR(figures.at("average_fps"), 1000 / parsed.at("recorded").at("mean_ms").get<double>(), 1e-9);
    EXPECT_NEAR(figures.at("max_ms"), 100, 1e-9);
    EXPECT_EQ(figures.at("stutter").at("count"), 1);
}

TEST_F(ReplayProgram, ATargetAloneOnlyCountsTheFramesOverIt) {
    write_log(in_folder("game.csv"), 10);
    const auto parsed = json::parse(replay(in_folder("game.csv") + " --target-ms 10.055 --json -").out);
    EXPECT_EQ(parsed.at("runs"), json::array());
    EXPECT_EQ(parsed.at("recorded").at("over_target_frames"), 300 / 7 + 1) << "one in seven, and the long one";
    const auto stepped = json::parse(replay(in_folder("game.csv") + " --target-ms 5,20@200 --json -").out);
    EXPECT_EQ(stepped.at("recorded").at("over_target_frames"), 200);
}

TEST_F(ReplayProgram, SeveralRecordingsAreCompared) {
    fs::create_directories(in_folder("logs/older"));
    write_log(in_folder("logs/a.csv"), 10, 4000);
    write_log(in_folder("logs/b.csv"), 8, 4000);
    write_log(in_folder("logs/older/a.csv"), 10, 4000);
    std::ofstream(in_folder("logs/notes.txt")) << "these are my logs\n";
    const Outcome folder = replay(in_folder("logs") + " --json " + in_folder("f.json"));
    ASSERT_EQ(folder.code, 0) << folder.err;
    EXPECT_NE(folder.err.find("passed over: " + in_folder("logs/notes.txt")), std::string::npos) << folder.err;
    const auto parsed = json::parse(content("f.json"));
    ASSERT_EQ(parsed.at("recordings").size(), 2u);
    EXPECT_EQ(parsed.at("recordings")[1].at("recording"), in_folder("logs/b.csv"));
    ASSERT_EQ(parsed.at("comparisons").size(), 1u);
    const auto& average = parsed.at("comparisons")[0].at("differences")[0];
    EXPECT_NEAR(average.at("change"), 0.25, 0.01);
    EXPECT_GT(average.at("low"), 0);
    const Outcome named = replay(in_folder("logs/a.csv") + " " + in_folder("logs/notes.txt"));
    EXPECT_EQ(named.code, 1) << "a file that is named must be a recording";
    const Outcome alike = replay(in_folder("logs/a.csv") + " " + in_folder("logs/older/a.csv"));
    EXPECT_NE(alike.out.find(" a.csv  a.csv (2)\n"), std::string::npos) << alike.out;
}

// Nor read what this very call is about to write.
TEST_F(ReplayProgram, NeverWritesOverARecordingOfAFolder) {
    fs::create_directories(in_folder("logs"));
    write_log(in_folder("logs/a.csv"), 10);
    const std::string before = content("logs/a.csv");
    const Outcome over = replay(in_folder("logs") + " --csv " + in_folder("logs/a.csv"));
    EXPECT_NE(over.code, 0);
    EXPECT_TRUE(tests::one_line(over.err)) << over.err;
    EXPECT_EQ(content("logs/a.csv"), before);
    const Outcome beside = replay(in_folder("logs") + " --json " + in_folder("logs/b.json"));
    EXPECT_EQ(beside.code, 0);
    EXPECT_EQ(beside.err, "");
}

TEST_F(ReplayProgram, FactsStandInTheFiguresToo) {
    std::ofstream(in_folder("game.csv")) << "//GPU=A fast one\n//Comment=in C:\\Users\\bob\\logs\n//recording=x\n"
                                            "Application,MsBetweenPresents\ngame.exe,10\ngame.exe,11\n";
    const json figures = json::parse(replay(in_folder("game.csv") + " --json -").out);
    EXPECT_EQ(figures.at("facts").at("GPU"), "A fast one");
    EXPECT_EQ(figures.at("facts").dump().find("bob"), std::string::npos);
    EXPECT_EQ(figures.at("recording"), in_folder("game.csv"));
    EXPECT_EQ(figures.at("settings").at("recording"), "x");
}

TEST_F(ReplayProgram, WritesTheFramesAsUnderstood) {
    write_log(in_folder("a.csv"), 10);
    write_log(in_folder("b.csv"), 8, 50);
    ASSERT_EQ(replay(in_folder("a.csv") + " " + in_folder("b.csv") + " --csv " + in_folder("frames.csv")).code, 0);
    const std::string text = content("frames.csv");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 300 + 50);
    EXPECT_NE(text.find("\na.csv,100,"), std::string::npos);
    EXPECT_NE(text.find("\nb.csv,49,"), std::string::npos);
}

TEST_F(ReplayProgram, APageTellsNothingOfTheMachineItWasMadeOn) {
    write_log(in_folder("game.csv"), 10);
    std::ofstream(in_folder("hurt.csv")) << "MsBetweenPresents,MsUntilDisplayed\n10,1\nx,1\n11,2\n12,1\n";
    for (const std::string& arguments :
         {in_folder("game.csv"), in_folder("hurt.csv"), in_folder("game.csv") + " --law paper",
          in_folder("game.csv") + " " + in_folder("hurt.csv")}) {
        ASSERT_EQ(replay(arguments + " --report " + in_folder("p.html") + " --svg " + in_folder("p.svg")).code, 0);
        for (const char* name : {"p.html", "p.svg"}) {
            const std::string text = content(name);
            EXPECT_EQ(text.find(fs::path(in_folder("")).parent_path().string()), std::string::npos) << arguments;
            EXPECT_EQ(text.find("/tmp"), std::string::npos) << arguments;
        }
    }
}

TEST_F(ReplayProgram, NothingHalfWrittenIsLeft) {
    const std::string trace = save(recorded());
    std::ofstream(in_folder("out.csv")) << "older";
    ASSERT_EQ(replay(trace + " --csv " + in_folder("out.csv") + " --json " + in_folder("no/such.json")).code, 1);
    EXPECT_EQ(content("out.csv"), "older");
    EXPECT_EQ(folder_.names().size(), 2u) << "the trace and the output, no temporary file";
    fs::create_symlink(in_folder("out.csv"), in_folder("link.csv"));
    ASSERT_EQ(replay(trace + " --csv " + in_folder("link.csv")).code, 0);
    EXPECT_TRUE(fs::is_symlink(in_folder("link.csv"))) << "a link is written through, not replaced";
    EXPECT_EQ(folder_.names().size(), 3u);
}

// Every run that the project keeps: what it decided is what its law decides today.
TEST(Traces, AreAllReproducedToTheBit) {
    int traces = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(GRANDSTAND_SOURCE) / "traces")) {
        if (entry.path().extension() != ".csv") continue;
        ++traces;
        const Outcome outcome = replay(entry.path().string() + " --verify");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    EXPECT_GT(traces, 0);
}

}  // namespace
