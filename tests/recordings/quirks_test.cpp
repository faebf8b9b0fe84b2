// What files in the wild have beside well-formed rows, and what is refused.
#include <algorithm>
#include <random>

#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

std::vector<Table> all_tables() {
    return {presentmon_1(), presentmon_2(), presentmon_current(), mangohud(), fraps()};
}

// Same frames and streams; notes may name other lines.
void expect_same(const Recording& a, const Recording& b) {
    EXPECT_EQ(a.format, b.format);
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (std::size_t i = 0; i < a.frames.size(); ++i) {
        const FrameRecord &x = a.frames[i], &y = b.frames[i];
        for (double FrameRecord::*time : {&FrameRecord::frame_ms, &FrameRecord::cpu_ms, &FrameRecord::gpu_ms}) {
            EXPECT_TRUE(x.*time == y.*time || (std::isnan(x.*time) && std::isnan(y.*time))) << "frame " << i;
        }
    }
    ASSERT_EQ(a.streams.size(), b.streams.size());
    EXPECT_EQ(a.streams[a.chosen].process, b.streams[b.chosen].process);
    EXPECT_EQ(a.trace.settings, b.trace.settings);
    EXPECT_EQ(a.notes.size(), b.notes.size());
}

TEST(Quirks, TheOrderOfColumnsChangesNothing) {
    std::mt19937_64 random(1);
    for (const Table& table : all_tables()) {
        const Recording expected = read(table.text());
        for (int trial = 0; trial < 50; ++trial) {
            Table other = table;
            for (std::size_t i = other.columns.size(); i > 1; --i) {
                const std::size_t k = random() % i;
                std::swap(other.columns[i - 1], other.columns[k]);
                for (std::vector<std::string>& row : other.rows) std::swap(row[i - 1], row[k]);
            }
            expect_same(read(other.text()), expected);
        }
    }
}

TEST(Quirks, LineEndsByteOrderMarkBlankLinesAndLetterCaseChangeNothing) {
    for (const Table& table : all_tables()) {
        const Recording expected = read(table.text());
        Table other = table;
        other.line_end = "\r\n";
        expect_same(read(other.text()), expected);
        expect_same(read("\xEF\xBB\xBF" + other.text()), expected);
        other.line_end = "\n\n \r\n";
        expect_same(read(other.text()), expected);
        other = table;
        for (std::string& column : other.columns) {
            std::transform(column.begin(), column.end(), column.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        }
        expect_same(read(other.text()), expected);
    }
}

TEST(Quirks, SemicolonsTabsQuotesAndDecimalCommasChangeNothing) {
    for (const Table& table : all_tables()) {
        const Recording expected = read(table.text());
        Table commas = table;
        for (std::vector<std::string>& row : commas.rows) {
            for (std::string& field : row) {
                if (field != "a.exe") std::replace(field.begin(), field.end(), '.', ',');
            }
        }
        for (const char* separator : {";", "\t"}) {
            Table other = table;
            other.separator = commas.separator = separator;
            expect_same(read(other.text()), expected);
            expect_same(read(commas.text()), expected);
        }
        for (std::vector<std::string>& row : commas.rows) {
            for (std::string& field : row) field = '"' + field + '"';
        }
        commas.separator = ",";
        expect_same(read(commas.text()), expected);
    }
}

TEST(Quirks, QuotedNamesKeepTheirCommasAndQuotes) {
    Table table = presentmon_1();
    for (std::vector<std::string>& row : table.rows) row[0] = R"("a ""b"", c.exe")";
    EXPECT_EQ(read(table.text()).streams[0].process, "a \"b\", c.exe");
}

TEST(Quirks, DecimalCommasTakenForSeparatorsAreRefused) {
    Table table = presentmon_1();
    for (std::vector<std::string>& row : table.rows) row[6] = "16,2";
    EXPECT_TRUE(contains(refusal(table.text()), "r.csv:2: found 10 fields, expected 9 at most"));
    table = presentmon_1();
    table.rows[1].insert(table.rows[1].end(), {"", " ", ""});  // but empty fields at the end are nothing
    EXPECT_EQ(read(table.text()).frames.size(), 3u);
}

TEST(Quirks, FilesPutTogetherFindTheirColumnsAgain) {
    for (const Table& table : all_tables()) {
        const Recording once = read(table.text());
        Table other = table;
        std::swap(other.columns.front(), other.columns.back());
        for (std::vector<std::string>& row : other.rows) std::swap(row.front(), row.back());
        const Recording twice = read(table.text() + other.text());
        EXPECT_EQ(twice.frames.size(), 2 * once.frames.size());
        EXPECT_NEAR(twice.streams[0].seconds, 2 * once.streams[0].seconds, 1e-12);
        EXPECT_TRUE(has_note(twice, "header found again in line"));
    }
    EXPECT_TRUE(contains(refusal(presentmon_1().text() + presentmon_2().text()),
                         "r.csv:5: found the header of PresentMon 2.x"));
    Table table = presentmon_1();
    table.preamble = {"//GPU=1", "//CPU=2"};
    EXPECT_EQ(read(table.text() + table.text()).frames.size(), 6u);
}

TEST(Quirks, StreamsAreToldApartAndTheBusiestIsTaken) {
    Table table = presentmon_1();
    table.rows.push_back({"dwm.exe", "7", "0xB0", "DXGI", "0", "0.1", "8", "8", "1"});
    table.rows.push_back({"a.exe", "12", "0xC0", "DXGI", "0", "0.04", "9", "9", "1"});  // beside the other
    table.rows.insert(table.rows.begin() + 1, {"dwm.exe", "7", "0xB0", "DXGI", "0", "0.0", "7", "7", "1"});
    const Recording recording = read(table.text());
    EXPECT_EQ(frame_times(recording), (std::vector<double>{16.1, 16.2, 16.3}));
    ASSERT_EQ(recording.streams.size(), 3u);
    EXPECT_EQ(recording.streams[1].process, "dwm.exe");
    EXPECT_EQ(recording.streams[1].frames, 2);
    EXPECT_NEAR(recording.streams[1].seconds, 0.015, 1e-12);
    for (const char* name : {"DWM.exe", "dwm", "7", "0xb0", "0x00b0"}) {
        const Recording other = read(table.text(), {name});
        EXPECT_EQ(frame_times(other), (std::vector<double>{7, 8})) << name;
        EXPECT_EQ(other.chosen, 1u);
        EXPECT_EQ(other.trace.settings.at("process"), "dwm.exe");
    }
    EXPECT_EQ(frame_times(read(table.text(), {"a.exe"})).size(), 3u);
    EXPECT_EQ(frame_times(read(table.text(), {"0xC0"})), (std::vector<double>{9}));
}

TEST(Quirks, AStreamThatIsNotThereIsRefusedWithThoseThatAre) {
    Table table = presentmon_1();
    for (int i = 0; i < 10; ++i)
        table.rows.push_back({"p" + std::to_string(i), std::to_string(i), "0x0", "", "0", "0", "5", "5", "1"});
    const std::string message = refusal(table.text(), {"dw"});
    EXPECT_TRUE(contains(message, "'dw', expected one of 'a.exe', id '12', swap chain '0xA0': 3 frames; 'p0'"));
    EXPECT_TRUE(contains(message, "'p6'")) << message;
    EXPECT_FALSE(contains(message, "'p7'")) << message;
    EXPECT_TRUE(contains(message, "and 3 more")) << message;
    EXPECT_TRUE(contains(refusal(fraps().text(), {"dwm"}), "expected none: FRAPS does not tell them"));
}

TEST(Quirks, TimesThatCannotBeAreNaNAndCounted) {
    Table table = presentmon_1();
    for (const char* bad : {"-0.5", "-1", "600001", "inf", "1e300", "Infinity"}) {
        table.rows[1][6] = bad;
        const Recording recording = read(table.text());
        ASSERT_EQ(recording.frames.size(), 3u);
        EXPECT_TRUE(std::isnan(recording.frames[1].frame_ms)) << bad;
        EXPECT_TRUE(has_note(recording, "1 frame with a time not over 0 or over 10 minutes (in line 3)")) << bad;
        EXPECT_NEAR(recording.streams[0].seconds, 0.0324, 1e-12);
    }
    for (const char* untold : {"NA", "na", "N/A", "nan", "", "-1.#IND", "1.#QNAN", "-nan(ind)", "nan(snan)", "null"}) {
        table.rows[1][6] = untold;
        const Recording recording = read(table.text());
        EXPECT_TRUE(std::isnan(recording.frames[1].frame_ms)) << untold;
        EXPECT_TRUE(has_note(recording, "1 frame without a time (in line 3)")) << untold;
    }
}

TEST(Quirks, PartsOfAFrameMayBeUntold) {
    Table table = presentmon_2();
    table.rows[0][6] = "";
    table.rows[1][6] = "NA";
    table.rows[2][6] = "-3";
    const Recording recording = read(table.text());
    for (const FrameRecord& row : recording.frames) EXPECT_TRUE(std::isnan(row.cpu_ms));
    EXPECT_EQ(recording.frames[2].gpu_ms, 3.3);
    EXPECT_TRUE(has_note(recording, "1 CPU or GPU time that can't be read, under 0 or over 10 minutes (in line 4)"));
}

TEST(Quirks, ClocksThatStandOrRunBackGiveNaN) {
    Table table = fraps();
    table.rows.push_back({"5", "48.6"});
    table.rows.push_back({"6", "40"});
    table.rows.push_back({"7", "50"});
    const Recording recording = read(table.text());
    ASSERT_EQ(recording.frames.size(), 6u);
    EXPECT_TRUE(std::isnan(recording.frames[3].frame_ms) && std::isnan(recording.frames[4].frame_ms));
    EXPECT_EQ(recording.frames[5].frame_ms, 10);
}

Table generated_frames() {
    Table table = presentmon_current();
    table.rows.clear();
    // Each present of the application is shown three times, by rows that all bear its time.
    for (int i = 1; i <= 3; ++i) {
        const std::string time = std::to_string(20 * i);
        for (const char* type : {"Intel XeSS-FG", "Application", "Intel XeSS-FG"})
            table.rows.push_back({"a.exe", "12", "0xA0", "DXGI", type, time, "20", "30", "5", "3"});
    }
    return table;
}

TEST(Quirks, GeneratedFramesOfOnePresentAreLeftOut) {
    const Recording recording = read(generated_frames().text());
    EXPECT_EQ(frame_times(recording), (std::vector<double>{20, 20, 20}));
    EXPECT_TRUE(has_note(recording, "6 rows of generated frames, 'Intel XeSS-FG' (the first in line 2): left out"));
}

TEST(Quirks, GeneratedFramesPresentedApartGiveTheirTimeToTheNext) {
    Table table = generated_frames();
    double sum = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        table.rows[i][4] = i % 3 == 2 ? "Application" : "AMD_AFMF";
        table.rows[i][5] = std::to_string(7 * i);
        table.rows[i][6] = std::to_string(i + 1);
        sum += static_cast<double>(i + 1);
    }
    const Recording recording = read(table.text());
    EXPECT_EQ(frame_times(recording), (std::vector<double>{1 + 2 + 3, 4 + 5 + 6, 7 + 8 + 9}));
    EXPECT_NEAR(recording.streams[0].seconds, sum / 1000, 1e-12);
    for (std::vector<std::string>& row : table.rows) row[4] = "AMD_AFMF";
    EXPECT_TRUE(
        contains(refusal(table.text()), "found no frame of PresentMon current but those of FrameType 'AMD_AFMF'"));
}

TEST(Quirks, AFrameIsUnshownExactlyWhereItsRowSaysSo) {
    const auto is_unshown = [](Table table, std::size_t column, const std::string& told) {
        for (std::vector<std::string>& row : table.rows) row[column] = "16.6";
        table.rows[1][column] = told;
        const Recording recording = read(table.text());
        EXPECT_EQ(recording.frames.size(), 3u) << "it was rendered";
        return has_note(recording, "1 frame dropped, never shown (in line 3)");
    };
    constexpr std::size_t displayed = 8;
    for (const char* told : {"0", "0.0", "0.0000", "-0", "NA", "na", "N/A", "-nan(ind)"})
        EXPECT_TRUE(is_unshown(presentmon_2(), displayed, told)) << told;
    for (const char* told : {"", "0.0001", "16.6", "-1"})
        EXPECT_FALSE(is_unshown(presentmon_2(), displayed, told)) << told;
    for (const char* name : {"DisplayedTime", "MsUntilDisplayed", "MsBetweenDisplayChange"}) {
        Table table = presentmon_2();
        table.columns[displayed] = name;
        EXPECT_TRUE(is_unshown(table, displayed, "0")) << name;
    }
}

TEST(Quirks, DroppedTellsMoreThanTheDisplaysTime) {
    constexpr std::size_t dropped = 4, display_change = 7;
    for (const char* told : {"1", "true", "TRUE"}) {
        Table table = presentmon_1();
        table.rows[1][dropped] = told;
        table.rows[1][display_change] = "16.6";
        EXPECT_TRUE(has_note(read(table.text()), "1 frame dropped")) << told;
    }
    for (const char* told : {"Error", "maybe", "-"}) {
        Table table = presentmon_1();
        for (std::vector<std::string>& row : table.rows) row[dropped] = "0";
        table.rows[1][dropped] = told;
        EXPECT_EQ(read(table.text()).frames.size(), 3u);
        EXPECT_TRUE(has_note(read(table.text()), "1 frame of unknown fate, shown or not (in line 3)")) << told;
        EXPECT_FALSE(has_note(read(table.text()), "dropped")) << told;
    }
    for (const char* told : {"0", "false", "False", "", "NA"}) {
        Table table = presentmon_1();
        table.rows[1][dropped] = told;
        table.rows[1][display_change] = "0";
        EXPECT_FALSE(has_note(read(table.text()), "dropped")) << told;
    }
}

TEST(Quirks, WhatIsNotCalledGeneratedIsTheApplicationsOwn) {
    constexpr std::size_t type = 3;
    for (const char* told : {"", "NA", "na", "N/A", "Application", "APPLICATION"}) {
        Table table = presentmon_2();
        table.rows[1][type] = told;
        const Recording recording = read(table.text());
        EXPECT_EQ(frame_times(recording), (std::vector<double>{16.1, 16.2, 16.3})) << told;
        EXPECT_FALSE(has_note(recording, "generated")) << told;
    }
    for (const char* told : {"Unspecified", "NotSet", "Unknown", "Repeated", "Applications"}) {
        Table table = presentmon_2();
        table.rows[1][type] = told;
        const Recording recording = read(table.text());
        EXPECT_EQ(frame_times(recording), (std::vector<double>{16.1, 16.2, 16.3})) << told;
        EXPECT_TRUE(has_note(recording, "1 row of FrameType '" + std::string(told) + "' (in line 3): taken for"))
            << told;
    }
    for (const char* told : {"AMD_AFMF", "AMD AFMF", "Intel XeSS-FG", "Intel_XEFG", "DLSS-G", "FSR3 FG", "Generated"}) {
        Table table = presentmon_2();
        table.rows[1][type] = told;
        EXPECT_EQ(frame_times(read(table.text())), (std::vector<double>{16.1, 16.2 + 16.3})) << told;
    }
}

TEST(Quirks, TimesThatAreNotToldAreOfNoPresent) {
    constexpr std::size_t type = 4, time = 5, frame_time = 6;
    for (const char* told : {"", "NA"}) {
        Table table = presentmon_current();
        table.rows[0][type] = "AMD_AFMF";
        for (std::vector<std::string>& row : table.rows) row[time] = told;
        const Recording recording = read(table.text());
        ASSERT_EQ(recording.frames.size(), 2u);
        EXPECT_NEAR(recording.frames[0].frame_ms, std::stod(table.rows[0][frame_time]) + 16.2, 1e-9)
            << "nothing says that the two rows are of one present";
        EXPECT_EQ(recording.frames[1].frame_ms, 16.3) << "waiting time is given once";
    }
}

TEST(Quirks, EveryNameThatATimeHadIsRead) {
    const auto with = [](const std::vector<std::string>& names) {
        Table table;
        table.columns = {"Application", "MsBetweenPresents"};
        table.rows = {{"a.exe", "16"}};
        for (std::size_t i = 0; i < names.size(); ++i) {
            table.columns.push_back(names[i]);
            table.rows[0].push_back(std::to_string(i + 1));
        }
        return read(table.text()).frames.at(0);
    };
    for (const char* name : {"MsCPUBusy", "CPUBusy", "CpuActive"}) {
        EXPECT_EQ(with({name}).cpu_ms, 1) << name;
        EXPECT_TRUE(std::isnan(with({name}).gpu_ms)) << name;
    }
    for (const char* name : {"MsGPUBusy", "GPUBusy", "MsGPUActive", "GpuActive"}) {
        EXPECT_EQ(with({name}).gpu_ms, 1) << name;
        EXPECT_TRUE(std::isnan(with({name}).cpu_ms)) << name;
    }
    EXPECT_EQ(with({"MsGPUActive", "MsGPUBusy"}).gpu_ms, 2) << "what is busy was measured, not what was open";
}

TEST(Quirks, EveryNameThatATimeOfPresentHadTellsPresentsApart) {
    for (const char* name :
         {"TimeInSeconds", "TimeInMs", "TimeInQPC", "TimeInDateTime", "QPCTime", "CPUStartTime", "CPUStartTimeInMs",
          "CPUStartQPC", "CPUStartQPCTime", "CPUStartQPCTimeInMs", "CPUStartDateTime"}) {
        Table table = generated_frames();
        table.columns[5] = name;
        EXPECT_EQ(frame_times(read(table.text())), (std::vector<double>{20, 20, 20})) << name;
    }
}

TEST(Quirks, OneColumnOfTheToolsOwnTellsItsFormat) {
    struct Mark {
        const char *format, *time, *column;
    };
    constexpr const char *old_time = "MsBetweenPresents", *new_time = "FrameTime";
    for (const Mark& mark : {Mark{"FrameView", old_time, "Resolution"},
                             {"FrameView", old_time, "Render Queue Depth"},
                             {"OCAT", old_time, "Motherboard"},
                             {"OCAT", old_time, "Base Driver Version"},
                             {"OCAT", old_time, "Driver Package"},
                             {"PresentMon current", old_time, "PresentRuntime"},
                             {"PresentMon current", old_time, "MsCPUBusy"},
                             {"PresentMon current", old_time, "MsGPUBusy"},
                             {"PresentMon current", old_time, "MsBetweenAppStart"},
                             {"PresentMon current", old_time, "FrameType"},
                             {"PresentMon 1.x", old_time, "Runtime"},
                             {"PresentMon 2.x", new_time, "CPUBusy"},
                             {"PresentMon 2.x", new_time, "GPUBusy"},
                             {"PresentMon 2.x", new_time, "DisplayedTime"},
                             {"PresentMon 2.x", new_time, "Application"}}) {
        Table table;
        table.columns = {mark.time, mark.column};
        table.rows = {{"16", ""}};
        EXPECT_EQ(read(table.text()).format, mark.format) << mark.column;
    }
}

TEST(Quirks, TimesAtTheirLimitsAreKept) {
    constexpr double longest = 600'000;  // [ms]
    Table table = presentmon_2();
    for (std::vector<std::string>& row : table.rows) row[5] = "600000";  // one would make the others far too short
    table.rows[1][6] = "0";
    table.rows[2][7] = "600000";
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.frames[0].frame_ms, longest);
    EXPECT_EQ(recording.frames[1].cpu_ms, 0);
    EXPECT_EQ(recording.frames[2].gpu_ms, longest);
    EXPECT_FALSE(has_note(recording, "NaN"));
    table.rows[2][7] = "600000.1";
    EXPECT_TRUE(std::isnan(read(table.text()).frames[2].gpu_ms));
}

TEST(Quirks, StreamsDifferByAnyOfTheirThreeNames) {
    Table table = presentmon_1();
    const std::vector<std::string> row = table.rows[2];
    for (const std::size_t name : {0, 1, 2}) {
        table.rows.insert(table.rows.end(), {row, row});
        table.rows.back()[name] = "other";  // right behind one that differs in nothing else
        table.rows.back()[5] = "0.03";      // and beside the others in time
    }
    const Recording recording = read(table.text());
    ASSERT_EQ(recording.streams.size(), 4u);
    EXPECT_EQ(recording.streams[0].frames, 6);
    for (const std::size_t i : {1, 2, 3}) EXPECT_EQ(recording.streams[i].frames, 1) << i;
}

TEST(Quirks, OfStreamsEquallyBusyTheFirstIsTaken) {
    Table table = presentmon_1();
    for (int i = 0; i < 3; ++i) table.rows.push_back({"b.exe", "13", "0xB0", "DXGI", "0", "0.1", "8", "8", "1"});
    EXPECT_EQ(read(table.text()).trace.settings.at("process"), "a.exe");
    std::rotate(table.rows.begin(), table.rows.begin() + 3, table.rows.end());
    EXPECT_EQ(read(table.text()).trace.settings.at("process"), "b.exe");
}

TEST(Quirks, AGeneratedFrameWithoutAUsableTimeAddsNone) {
    constexpr std::size_t type = 4, frame_time = 6;
    for (const char* told : {"NA", "-1", "0", "600001", "inf"}) {
        Table table = presentmon_current();
        table.rows[0][type] = "AMD_AFMF";
        table.rows[0][frame_time] = told;
        EXPECT_EQ(frame_times(read(table.text())), (std::vector<double>{16.2, 16.3})) << told;
    }
}

Table of_times(const std::vector<double>& times) {
    Table table = presentmon_1();
    table.rows.clear();
    for (const double ms : times) {
        table.rows.push_back({"a.exe", "12", "0xA0", "DXGI", "0", "0", std::to_string(ms), "5", "3"});
    }
    return table;
}

// However short: a recorder that knows of generated frames says so.
TEST(Quirks, ShortPresentsAreFrames) {
    std::vector<double> times;
    for (int i = 0; i < 20; ++i) times.insert(times.end(), {16.5, 0.25, 33, 1, 1});
    EXPECT_EQ(frame_times(read(of_times(times).text())), times);
}

TEST(Quirks, ALastLineCutShortIsLeftOut) {
    Table table = presentmon_1();
    table.rows.push_back(table.rows[0]);
    const std::string text = table.text();
    const std::string whole_fields = text.substr(0, text.size() - 2);  // within msGPUActive, which is read
    const Recording recording = read(whole_fields);
    EXPECT_EQ(recording.frames.size(), 3u);
    EXPECT_TRUE(has_note(recording, "line 5, the last, is cut short: left out"));
    table.columns.push_back("QPCTime");
    for (std::vector<std::string>& row : table.rows) row.push_back("2076674276");
    const std::string longer = table.text();
    EXPECT_EQ(read(longer.substr(0, longer.size() - 5)).frames.size(), 4u);  // in a column that is not read
}

TEST(Quirks, RubbishIsRefusedByItsLine) {
    struct Bad {
        std::string text;
        const char* said;
    };
    const std::string header = "Application,MsBetweenPresents,Dropped\n", row = "a,16,0\n";
    const Bad bads[] = {
        {"", "r.csv:1: found an empty file, expected one of our own traces, PresentMon, CapFrameX"},
        {" \r\n\n", "r.csv:1: found an empty file"},
        {"\n\nhello\nworld\n", "r.csv:3: found no header but 'hello', expected one of our own traces"},
        {"# law=paper\n//GPU=1\nhello\nworld\n", "r.csv:3: found no header but 'hello'"},
        {std::string("MZ\0\1", 4), "r.csv:1: found a binary file, expected one of our own"},
        {"\x1b[31m\x07" + std::string(100, 'x'), "found no header but '?[31m?xxx"},
        {header, "r.csv:1: found no row behind the header of PresentMon 1.x, expected at least one"},
        {"Frame, Time (ms)\n1, 0\n", "found no frame of FRAPS"},
        {"0.1% Min FPS,1% Min FPS,Average FPS\n10,20,30\n",
         "found columns '0.1% Min FPS', '1% Min FPS', 'Average FPS', expected one of them named as --column"},
        {"MsBetweenPresents,Application,msbetweenpresents\n", "r.csv:1: found two columns 'MsBetweenPresents'"},
        {header + row + "a,16\n", "r.csv:3: found 2 fields, expected 3 or more"},
        {header + row + "a,sixteen,0\n", "r.csv:3: MsBetweenPresents is 'sixteen', expected a number or NA"},
        {header + row + "a,1e999,0\n", "r.csv:3: MsBetweenPresents is '1e999'"},
        {header + row + "\"a,16,0\n" + "a,x,0\n", "r.csv:3: found 1 fields, expected 3 or more (and 1 rows more)"},
        {header + row + std::string(2'000'000, 'x') + "\n", "r.csv:3: found a line over 1 MiB"},
        {"fps,frametime,elapsed\n60,x,1\n", "r.csv:2: frametime is 'x'"},
    };
    for (const Bad& bad : bads) {
        const std::string message = refusal(bad.text);
        EXPECT_TRUE(contains(message, bad.said)) << message << "\n  not: " << bad.said;
    }
}

TEST(Quirks, APreambleHasAnEnd) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "//Key=Value\n";
    EXPECT_TRUE(contains(refusal(text + presentmon_1().text()), "r.csv:1: found no header but '//Key=Value'"));
}

}  // namespace
}  // namespace sfsm
