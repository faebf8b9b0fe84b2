// Every format that is read, from what its tool writes.
#include <cmath>
#include <functional>

#include "sfsm/trace_columns.h"
#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

// The three frames of tables.h, and three of every format.
void expect_three_frames(const Recording& recording, bool has_cpu, bool has_gpu) {
    ASSERT_EQ(recording.frames.size(), 3u);
    EXPECT_TRUE(recording.trace.rows.empty());
    for (int i = 0; i < 3; ++i) {
        const FrameRecord& row = recording.frames[static_cast<std::size_t>(i)];
        const double rounding = 1e-9;  // of FRAPS's differences
        EXPECT_NEAR(row.frame_ms, 16.1 + 0.1 * i, rounding);
        if (has_cpu) {
            EXPECT_NEAR(row.cpu_ms, 5.1 + 0.1 * i, rounding);
        } else {
            EXPECT_TRUE(std::isnan(row.cpu_ms));
        }
        if (has_gpu) {
            EXPECT_NEAR(row.gpu_ms, 3.1 + 0.1 * i, rounding);
        } else {
            EXPECT_TRUE(std::isnan(row.gpu_ms));
        }
    }
    EXPECT_FALSE(recording.has_work());
    EXPECT_EQ(recording.trace.name, "r.csv");
    EXPECT_EQ(recording.trace.settings.at("format"), recording.format);
    EXPECT_EQ(recording.streams.at(recording.chosen).frames, 3);
    EXPECT_NEAR(recording.streams.at(recording.chosen).seconds, 0.0486, 1e-12);
}

void expect_application(const Recording& recording) {
    const Stream& stream = recording.streams.at(recording.chosen);
    EXPECT_EQ(stream.process, "a.exe");
    EXPECT_EQ(stream.process_id, "12");
    EXPECT_EQ(stream.swap_chain, "0xA0");
    EXPECT_EQ(recording.trace.settings.at("process"), "a.exe");
    EXPECT_EQ(recording.trace.settings.at("process_id"), "12");
    EXPECT_EQ(recording.trace.settings.at("swap_chain"), "0xA0");
}

TEST(Formats, PresentMon1) {
    const Recording recording = read(presentmon_1().text());
    EXPECT_EQ(recording.format, "PresentMon 1.x");
    expect_three_frames(recording, false, true);
    expect_application(recording);
    EXPECT_TRUE(has_note(recording, "1 frame dropped, never shown (in line 3)"));
}

TEST(Formats, PresentMon2) {
    const Recording recording = read(presentmon_2().text());
    EXPECT_EQ(recording.format, "PresentMon 2.x");
    expect_three_frames(recording, true, true);
    expect_application(recording);
    EXPECT_TRUE(has_note(recording, "1 frame dropped, never shown (in line 3)"));
}

TEST(Formats, PresentMonCurrent) {
    const Recording recording = read(presentmon_current().text());
    EXPECT_EQ(recording.format, "PresentMon current");
    expect_three_frames(recording, true, true);
    expect_application(recording);
    EXPECT_TRUE(has_note(recording, "1 frame dropped, never shown (in line 3)"));
}

TEST(Formats, OcatWithHardwareInItsFirstRowOnly) {
    Table table = presentmon_1();
    table.columns.insert(table.columns.end(), {"Motherboard", "OS", "Comment"});
    table.rows[0].insert(table.rows[0].end(), {"\"MPG Z390, \"\"GAMING\"\"\"", "\"Windows 10, 1809\"", "Test"});
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.format, "OCAT");
    expect_three_frames(recording, false, true);
    expect_application(recording);
}

TEST(Formats, CapFrameXCsvWithItsPreamble) {
    Table table = presentmon_1();
    table.preamble = {"//GameName=Far Cry", "//GPU #=1", "//Comment=a = b"};
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.format, "CapFrameX CSV");
    expect_three_frames(recording, false, true);
    expect_application(recording);
    EXPECT_EQ(recording.trace.settings.at("GameName"), "Far Cry");
    EXPECT_EQ(recording.trace.settings.at("GPU #"), "1");
    EXPECT_EQ(recording.trace.settings.at("Comment"), "a = b");
}

TEST(Formats, FrameView) {
    Table table = presentmon_1();
    table.columns.insert(table.columns.begin() + 1, {"GPU", "CPU", "Resolution"});
    for (std::vector<std::string>& row : table.rows) row.insert(row.begin() + 1, {"RTX 4090", "i9", "3840x2160"});
    table.columns.push_back("MsPCLatency");
    for (std::vector<std::string>& row : table.rows) row.push_back("NA");
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.format, "FrameView");
    expect_three_frames(recording, false, true);
    expect_application(recording);
}

TEST(Formats, MangoHudOfEveryFrame) {
    const Recording recording = read(mangohud().text());
    EXPECT_EQ(recording.format, "MangoHud");
    expect_three_frames(recording, false, false);
    EXPECT_EQ(recording.trace.settings.at("gpu"), "RX 6800");
    EXPECT_TRUE(recording.notes.empty());
}

TEST(Formats, MangoHudWithAVersionedLog) {
    Table table = mangohud();
    table.preamble = {"v1",
                      "0.7.1",
                      "---------------------SYSTEM INFO---------------------",
                      table.preamble[0],
                      table.preamble[1],
                      "--------------------FRAME METRICS--------------------"};
    const Recording recording = read(table.text());
    expect_three_frames(recording, false, false);
    EXPECT_EQ(recording.trace.settings.at("kernel"), "6.1");
    const Recording twice = read(table.text() + table.text());
    EXPECT_EQ(twice.frames.size(), 6u);
    EXPECT_TRUE(has_note(twice, "header found again in line 17"));
}

TEST(Formats, MangoHudInMicrosecondsAsItWasOnce) {
    Table table = mangohud();
    table.rows = {{"62.1118", "16100", "20", "90", "16100000"},
                  {"61.7284", "16200", "21", "91", "32300000"},
                  {"61.3497", "16300", "22", "92", "48600000"}};
    expect_three_frames(read(table.text()), false, false);
}

TEST(Formats, MangoHudSampledStandsForTheFramesThatFit) {
    Table table = mangohud();
    table.rows.clear();
    for (int i = 0; i < 50; ++i)
        table.rows.push_back({"50", "20", "20", "90", std::to_string(100'000'000LL * (i + 1))});
    for (int i = 0; i < 10; ++i)  // 100 ms hold two frames of 40 ms and a half: the halves are carried on
        table.rows.push_back({"25", "40", "20", "90", std::to_string(5'000'000'000LL + 100'000'000LL * (i + 1))});
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.frames.size(), 49u * 5 + 25) << "the first row begins the clock";
    EXPECT_NEAR(recording.streams[0].seconds, 4.9 + 1, 1e-9);
    EXPECT_TRUE(has_note(recording, "sampled: 60 rows stand for 270 frames"));
}

TEST(Formats, MangoHudSampledMoreOftenThanItsFrames) {
    Table table = mangohud();
    table.rows.clear();
    for (int i = 0; i < 100; ++i) table.rows.push_back({"50", "20", "20", "90", std::to_string(5'000'000LL * i)});
    const Recording recording = read(table.text());
    EXPECT_NEAR(recording.streams[0].seconds, 0.5, 0.03);
}

TEST(Formats, MangoHudsPausesStandForAUsualStep) {
    Table table = mangohud();
    table.rows.clear();
    for (int i = 0; i < 50; ++i) table.rows.push_back({"50", "20", "1", "9", std::to_string(100'000'000LL * (i + 1))});
    table.rows.push_back({"50", "20", "1", "9", "9000000000000"});
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.frames.size(), 49u * 5 + 5);
    EXPECT_TRUE(has_note(recording, "pauses left out: 1"));
}

// A file has one unit: the one in which most of its times are the inverse of the rate beside them.
TEST(Formats, MangoHudsUnitIsTheOneThatAgreesWithItsRates) {
    struct Row {
        const char *fps, *told;
        double ms;
    };
    for (const Row& row : {Row{"50", "20000", 20},
                           {"56", "20000.5", 20.0005},
                           {"30", "20000", 20},
                           {"50", "20", 20},
                           {"1000", "1", 1},
                           {"1000", "1000", 1},
                           {"0", "20", 20},
                           {"nan", "20000", 20}}) {
        Table table = mangohud();
        table.columns = {"fps", "frametime"};
        table.rows = {{row.fps, row.told}};
        EXPECT_NEAR(read(table.text()).frames.at(0).frame_ms, row.ms, 1e-9) << row.told << " at " << row.fps << " fps";
    }
}

TEST(Formats, MangoHudsRowsOfAnotherUnitAreNamed) {
    Table table = mangohud();
    table.columns = {"fps", "frametime"};
    table.rows.assign(9, {"50", "20000"});
    table.rows[4] = {"50", "20"};
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.frames[4].frame_ms, 0.02);
    EXPECT_TRUE(has_note(recording, "1 rows with a time of another unit by their fps (the first in line 8)"));
}

TEST(Formats, APauseBetweenMangoHudsFramesMakesThemNoSamples) {
    Table table = mangohud();
    table.rows.clear();
    for (int i = 0; i < 50; ++i)
        table.rows.push_back(
            {"50", "20", "1", "9", std::to_string(20'000'000LL * i + (i < 25 ? 0 : 60'000'000'000LL))});
    EXPECT_EQ(read(table.text()).frames.size(), 50u);
}

// A sample a frame may be off its clock by half; beyond that rows are samples.
TEST(Formats, MangoHudsRowsAreSamplesWhereTheirClockSaysSo) {
    const auto frames = [](double interval_ms) {
        Table table = mangohud();
        table.rows.clear();
        for (int i = 0; i < 100; ++i) {
            table.rows.push_back({"50", "20", "20", "90", std::to_string(std::llround(interval_ms * 1e6) * i)});
        }
        return static_cast<int>(read(table.text()).frames.size());
    };
    for (const double interval : {14.0, 20.0, 29.0}) EXPECT_EQ(frames(interval), 100) << interval << " ms";
    EXPECT_NEAR(frames(31), 99 * 31 / 20, 1);
    EXPECT_NEAR(frames(13), 99 * 13 / 20, 1);
    EXPECT_EQ(frames(200), 99 * 10);
}

TEST(Formats, MangoHudsClockThatRunsBackIsASampleOfOneFrame) {
    Table table = mangohud();
    table.rows.clear();
    for (int i = 0; i < 20; ++i) table.rows.push_back({"50", "20", "20", "90", std::to_string(100'000'000LL * i)});
    table.rows.push_back({"50", "20", "20", "90", "0"});  // a log begun anew
    table.rows.push_back({"50", "20", "20", "90", "100000000"});
    EXPECT_EQ(read(table.text()).frames.size(), 19u * 5 + 1 + 5);
}

TEST(Formats, FrapsClockGivesAFrameLess) {
    const Recording recording = read(fraps().text());
    EXPECT_EQ(recording.format, "FRAPS");
    expect_three_frames(recording, false, false);
    EXPECT_EQ(recording.streams.size(), 1u);
    EXPECT_EQ(recording.streams[0].process, "");
}

TEST(Formats, FrapsPutTogetherBeginsItsClockAgain) {
    const Recording recording = read(fraps().text() + fraps().text());
    EXPECT_EQ(recording.frames.size(), 6u);
    EXPECT_NEAR(recording.streams[0].seconds, 2 * 0.0486, 1e-12);
}

std::string capframex_json(const std::string& runs) {
    return "{\"Hash\":\"x\",\"Info\":{\"AppVersion\":\"1.7.3\",\"ProcessName\":\"a.exe\",\"GPU\":\"RTX\"},\"Runs\":[" +
           runs + "]}";
}

std::string json_run(const std::string& times, const std::string& more = "") {
    return "{\"Hash\":\"y\",\"CaptureData\":{\"TimeInSeconds\":[0,1,2],\"MsBetweenPresents\":[" + times + "]" + more +
           "},\"SensorData2\":{\"GpuUsage\":{\"Values\":[1,2]}}}";
}

TEST(Formats, CapFrameXJson) {
    const Recording recording = read(
        capframex_json(json_run("16.1,16.2,16.3",
                                ",\"Dropped\":[false,true,false],\"GpuActive\":[3.1,3.2,3.3],\"CpuActive\":[5.1,5.2,"
                                "5.3]")));
    EXPECT_EQ(recording.format, "CapFrameX JSON");
    expect_three_frames(recording, true, true);
    EXPECT_EQ(recording.trace.settings.at("GPU"), "RTX");
    EXPECT_EQ(recording.streams[0].process, "a.exe");
    EXPECT_TRUE(has_note(recording, "1 frame dropped, never shown (in entry 2)"));
}

TEST(Formats, CapFrameXJsonOfSeveralRunsHasAStreamEach) {
    const std::string text = "\xEF\xBB\xBF" + capframex_json(json_run("1,2") + ",\r\n" + json_run("16.1,16.2,16.3"));
    const Recording busiest = read(text);
    expect_three_frames(busiest, false, false);
    ASSERT_EQ(busiest.streams.size(), 2u);
    EXPECT_EQ(busiest.streams[0].swap_chain, "run 2");
    EXPECT_EQ(frame_times(read(text, {"run 1"})), (std::vector<double>{1, 2}));
}

TEST(Formats, CapFrameXJsonKeepsWhatItCouldNotMeasureAsNaN) {
    const Recording recording =
        read(capframex_json(json_run("16.1,\"NaN\",null,-1.5,NaN,\"Infinity\",-Infinity,\"-Infinity\",Infinity")));
    ASSERT_EQ(recording.frames.size(), 9u);
    EXPECT_EQ(recording.frames[0].frame_ms, 16.1);
    for (std::size_t i = 1; i < 9; ++i) EXPECT_TRUE(std::isnan(recording.frames[i].frame_ms)) << i;
    EXPECT_TRUE(has_note(recording, "7 frames without a time (the first in entry 2)"));
}

TEST(Formats, WordsInJsonTextAreNoNumbers) {
    const std::string text = R"({"Info":{"Comment":"NaN, -Infinity, \"NaN","GPU":"\\"},"Runs":[{"CaptureData":)"
                             R"({"MsBetweenPresents":[16.1,-Infinity]}}]})";
    const Recording recording = read(text);
    EXPECT_EQ(recording.trace.settings.at("Comment"), "NaN, -Infinity, \"NaN");
    EXPECT_EQ(recording.frames.size(), 2u);
}

TEST(Formats, CapFrameXJsonHasTwoNamesForATime) {
    for (const char* cpu : {"CpuActive", "MsCPUBusy"}) {
        for (const char* gpu : {"GpuActive", "MsGPUBusy"}) {
            const std::string more = std::string(",\"") + cpu + "\":[5.1,5.2,5.3],\"" + gpu + "\":[3.1,3.2,3.3]";
            expect_three_frames(read(capframex_json(json_run("16.1,16.2,16.3", more))), true, true);
        }
    }
}

// The same names stand elsewhere in these files too.
TEST(Formats, CapFrameXJsonReadsOnlyTheDataOfItsRuns) {
    const std::string decoy = R"({"MsBetweenPresents":[1,2,3,4],"CaptureData":{"MsBetweenPresents":[5]}})";
    const std::string run = "{\"SensorData\":" + decoy + ",\"MsBetweenPresents\":[9]," +
                            json_run("16.1,16.2,16.3", ",\"Nested\":" + decoy).substr(1);
    const std::string text =
        "{\"Other\":[" + decoy + "],\"Info\":{\"Nested\":{\"GPU\":\"x\"},\"GPU\":\"y\"},\"Runs\":[" + run + "]}";
    const Recording recording = read(text);
    expect_three_frames(recording, false, false);
    EXPECT_EQ(recording.streams.size(), 1u);
    EXPECT_EQ(recording.trace.settings.at("GPU"), "y");
}

TEST(Formats, DamagedJsonIsRefusedByItsLine) {
    const std::string deep(100, '[');
    struct Bad {
        std::string text;
        const char* said;
    };
    const Bad bads[] = {
        {"{\n\"Runs\":[", "r.csv:2: found JSON that is damaged or cut short, expected CapFrameX's \"Runs\""},
        {"{\n\"a\":x\n}\n", "r.csv:2: found JSON that is damaged"},
        {capframex_json(json_run("\n16.1,\n1e999\n")), "r.csv:3: found a number too large"},
        {capframex_json(json_run("\n16.1,\n\"x\"\n")), "r.csv:3: found 'x' in"},
        {"{}", "found JSON without runs"},
        {"[1,2]", "found JSON without runs"},
        {capframex_json(json_run("16.1,NoN")), "damaged"},
        {capframex_json(json_run("16.1,--1")), "damaged"},
        {capframex_json(json_run("16.1,1e999")), "a number too large"},
        {capframex_json(json_run("16.1,true")), "found true or false in 'MsBetweenPresents'"},
        {capframex_json(json_run("16.1,\"x\"")), "found 'x' in 'MsBetweenPresents', expected a number"},
        {capframex_json(json_run("16.1", ",\"Dropped\":[true,true]")), "found arrays of 1 and 2 entries"},
        {capframex_json(json_run("")), "found no frame of CapFrameX JSON"},
        {"{\"Runs\":" + deep, "nested deeper than 32"},
        {capframex_json(json_run("16.1")) + "x", "damaged"},
    };
    for (const Bad& bad : bads) EXPECT_TRUE(contains(refusal(bad.text), bad.said)) << refusal(bad.text);
}

TEST(Formats, OurOwnTraces) {
    std::ostringstream out;
    write_trace_header(out, {{"law", "paper"}});
    TraceRow row;
    row.target_ms = 16.6;
    row.frame_ms = 20;
    row.work = {1, 2, 3, 4};
    for (row.frame = 5; row.frame < 9; ++row.frame) write_trace_row(out, row);
    for (const char* mark : {"", "\xEF\xBB\xBF"}) {
        const Recording recording = read(mark + out.str());
        EXPECT_EQ(recording.format, "trace");
        EXPECT_TRUE(recording.has_work());
        ASSERT_EQ(recording.frames.size(), 4u);
        ASSERT_EQ(recording.trace.rows.size(), 4u);
        EXPECT_EQ(recording.frames[0].frame_ms, 20);
        EXPECT_EQ(recording.trace.rows[0].frame, 5);
        EXPECT_EQ(recording.trace.rows[0].work, row.work);
        EXPECT_EQ(recording.trace.settings.at("law"), "paper");
        EXPECT_EQ(recording.streams.at(0).frames, 4);
        EXPECT_NEAR(recording.streams.at(0).seconds, 0.08, 1e-12);
    }
    EXPECT_TRUE(contains(refusal(out.str() + "1,2\n"),
                         "r.csv:7: found 2 fields, expected " + std::to_string(sfsm::trace_columns().size())));
    const Recording cut = read(out.str().substr(0, out.str().size() - 1));
    EXPECT_EQ(cut.frames.size(), 3u);
    EXPECT_TRUE(has_note(cut, "line 6, the last, is cut short: left out"));
    const std::string without_rows = out.str().substr(0, out.str().find("\n5,") + 1);
    EXPECT_TRUE(contains(refusal(without_rows), "r.csv:2: found no whole row behind the header of a trace"));
    EXPECT_TRUE(contains(refusal(without_rows + "5,16"), "r.csv:3: found no whole row behind the header of a trace"));
    EXPECT_TRUE(contains(refusal(out.str(), {"a.exe"}), "expected none: trace does not tell them"));
}

TEST(Formats, OurOwnTracesMayHaveManySettingsAndUnmeasuredFrames) {
    std::ostringstream out;
    write_trace_header(out, {{"device", "a,b"}, {"law", "paper"}, {"seed", "1"}});
    TraceRow row;
    row.target_ms = 16.6;
    for (const double ms : {20.0, std::nan(""), 30.0}) {
        row.frame_ms = ms;
        write_trace_row(out, row);
        ++row.frame;
    }
    const Recording recording = read(out.str());
    EXPECT_EQ(recording.format, "trace");
    EXPECT_EQ(recording.trace.settings.at("seed"), "1");
    EXPECT_EQ(recording.streams.at(0).frames, 3);
    EXPECT_NEAR(recording.streams.at(0).seconds, 0.05, 1e-12) << "of the frames that were measured";
}

}  // namespace
}  // namespace sfsm
