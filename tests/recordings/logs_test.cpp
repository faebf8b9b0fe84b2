// Logs as people have them: what is told of a row, of streams and of the whole file.
#include <functional>

#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

constexpr std::size_t process = 0, process_id = 1, swap_chain = 2, dropped = 4, time = 5, frame_time = 6;

// `count` rows of `ms` of PresentMon 1.x, one after the other from `begin_s` on.
std::vector<std::vector<std::string>> rows_of(std::size_t count, double ms, double begin_s = 0) {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = begin_s + static_cast<double>(i) * ms / 1000;
        rows.push_back({"game.exe", "11", "0x10", "DXGI", "0", std::to_string(at), std::to_string(ms), "10", "3"});
    }
    return rows;
}

void append(Table& table, std::vector<std::vector<std::string>> rows, const std::string& name, const std::string& id,
            const std::string& chain) {
    for (std::vector<std::string>& row : rows) {
        row[process] = name;
        row[process_id] = id;
        row[swap_chain] = chain;
        table.rows.push_back(row);
    }
}

Table game(std::size_t count = 20, double ms = 10) {
    Table table = presentmon_1();
    table.rows = rows_of(count, ms);
    return table;
}

double mean(const Recording& recording) {
    double sum = 0;
    std::size_t count = 0;
    for (const double ms : frame_times(recording)) {
        if (std::isnan(ms)) continue;
        sum += ms;
        ++count;
    }
    return sum / static_cast<double>(count);
}

TEST(Logs, MangoHudsAveragedRatesTellTheUnitOfAllRows) {
    Table table = mangohud();
    table.columns = {"fps", "frametime"};
    table.rows = {{"176.1", "5200"}, {"175.9", "6300"}, {"175.2", "5600"}, {"192.3", "5200"},
                  {"196.3", "4600"}, {"190.9", "4900"}, {"166.4", "9100"}, {"167.3", "7400"}};
    const Recording recording = read(table.text());
    EXPECT_EQ(frame_times(recording), (std::vector<double>{5.2, 6.3, 5.6, 5.2, 4.6, 4.9, 9.1, 7.4}));
    EXPECT_TRUE(has_note(recording, "microseconds"));
    table.rows[3][1] = "212000";  // a hitch stays one
    EXPECT_EQ(read(table.text()).frames[3].frame_ms, 212);
    for (std::vector<std::string>& row : table.rows) row[1] = std::to_string(std::stod(row[1]) / 1000);
    EXPECT_EQ(read(table.text()).frames[3].frame_ms, 212) << "nor is it another unit in a log of milliseconds";
}

TEST(Logs, SampledPeriodsHoldAsManyFramesAsFit) {
    const auto frames = [](double fps, double period_s) {
        Table table = mangohud();
        table.columns = {"fps", "frametime", "elapsed"};
        table.rows.clear();
        for (int i = 1; i <= 10; ++i)
            table.rows.push_back({std::to_string(fps), std::to_string(1000 / fps),
                                  std::to_string(static_cast<std::int64_t>(i * period_s * 1e9))});
        return static_cast<double>(read(table.text()).frames.size());
    };
    EXPECT_NEAR(frames(144, 10), 12960, 1);
    EXPECT_NEAR(frames(500, 60), 9 * 30000, 9);
    EXPECT_NEAR(frames(60, 0.5), 9 * 30, 1);
}

TEST(Logs, PresentsOfNoTimeAreGeneratedFrames) {
    for (const std::size_t generated : {1, 2, 3}) {
        Table table = presentmon_1();
        table.rows.clear();
        for (std::size_t i = 0; i < 10; ++i) {
            for (std::size_t k = 0; k <= generated; ++k) {
                table.rows.push_back(rows_of(1, 20, 0.02 * static_cast<double>(i))[0]);
                if (k > 0) table.rows.back()[frame_time] = "0.000";
            }
        }
        const Recording recording = read(table.text());
        EXPECT_EQ(frame_times(recording), std::vector<double>(10, 20));
        EXPECT_EQ(recording.streams[0].frames, 10);
        EXPECT_EQ(recording.streams[0].generated, static_cast<std::int64_t>(10 * generated));
        const std::string shown = std::to_string(10 * (generated + 1)), rate = std::to_string(50 * (generated + 1));
        EXPECT_TRUE(has_note(recording, shown + " presented, 10 rendered: " + rate + " and 50 a second"));
    }
}

TEST(Logs, TheFirstPresentOfNoTimeIsNone) {
    Table table = game();
    table.rows[0][frame_time] = "0";
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.streams[0].generated, 0);
    EXPECT_TRUE(std::isnan(recording.frames[0].frame_ms));
}

TEST(Logs, TwoRowsChangeTheMeanByTwoRows) {
    for (const double shorter : {0.5, 1.0, 3.0}) {
        const auto mean_of = [&](std::size_t short_rows) {
            Table table = game(1000, 20);
            for (std::size_t i = 0; i < short_rows; ++i) table.rows[2 * i + 1][frame_time] = std::to_string(shorter);
            EXPECT_EQ(read(table.text()).frames.size(), 1000u);
            return mean(read(table.text()));
        };
        EXPECT_NEAR(mean_of(99) / mean_of(101), 1, 0.01);
    }
}

TEST(Logs, RepeatedPresentsCountOnceAndOnlyIfTheyAreThem) {
    Table table = presentmon_2();
    constexpr std::size_t type = 3, start = 4;
    table.rows[1][type] = "Repeated";
    EXPECT_EQ(read(table.text()).frames.size(), 3u) << "it has a time of its own";
    table.rows[1][start] = table.rows[0][start];
    const Recording recording = read(table.text());
    EXPECT_EQ(frame_times(recording), (std::vector<double>{16.1, 16.3}));
    EXPECT_EQ(recording.streams[0].generated, 1);
}

TEST(Logs, PresentMonOfTwoPartsAddsThem) {
    for (const auto& [busy, wait] :
         {std::pair("CPUBusy", "CPUWait"), {"CPUDuration", "CPUFramePacingStall"}, {"msCPUBusy", "msCPUWait"}}) {
        Table table;
        table.columns = {"Application", "ProcessID", "SwapChainAddress", busy, wait, "GPUBusy", "DisplayedTime"};
        table.rows.assign(6, {"game.exe", "11", "0x10", "10.0", "5.0", "7", "15"});
        table.rows.push_back({"game.exe", "11", "0x10", "10.0", "NA", "7", "15"});
        const Recording recording = read(table.text());
        EXPECT_EQ(recording.format, "PresentMon 2.0");
        ASSERT_EQ(recording.frames.size(), 7u);
        EXPECT_EQ(recording.frames[0].frame_ms, 15) << busy;
        EXPECT_EQ(recording.frames[0].cpu_ms, 10);
        EXPECT_EQ(recording.frames[0].gpu_ms, 7);
        EXPECT_TRUE(std::isnan(recording.frames[6].frame_ms));
    }
}

TEST(Logs, DisplaysThatWereNotTrackedDropNothing) {
    for (const char* name : {"MsUntilDisplayed", "DisplayedTime", "MsBetweenDisplayChange"}) {
        Table table = presentmon_2();
        table.columns[8] = name;
        for (std::vector<std::string>& row : table.rows) row[8] = "NA";
        const Recording recording = read(table.text());
        EXPECT_FALSE(has_note(recording, "dropped, never shown"));
        EXPECT_TRUE(has_note(recording, std::string(name) + " is told in no row")) << name;
        table.rows[2][8] = "16.6";
        EXPECT_TRUE(has_note(read(table.text()), "2 frames dropped, never shown"));
    }
}

TEST(Logs, TheCompositorIsTakenWhereItIsAloneOrAskedFor) {
    for (const char* compositor : {"dwm.exe", "DWM.EXE", "dwm"}) {
        Table table = game(20, 14);
        append(table, rows_of(40, 7), compositor, "1", "0x1");
        const Recording recording = read(table.text());
        EXPECT_EQ(recording.trace.settings.at("process"), "game.exe") << compositor;
        EXPECT_EQ(recording.frames.size(), 20u);
        EXPECT_EQ(read(table.text(), {"dwm"}).frames.size(), 40u);
        table.rows.erase(table.rows.begin(), table.rows.begin() + 20);
        EXPECT_EQ(read(table.text()).frames.size(), 40u);
    }
}

TEST(Logs, ASwapChainMadeAnewGoesOn) {
    Table table = game(40, 10);
    append(table, rows_of(30, 20, 0.4), "game.exe", "11", "0x20");
    append(table, rows_of(5, 5, 1.0), "game.exe", "11", "0x30");
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.streams.size(), 1u);
    EXPECT_EQ(recording.frames.size(), 75u);
    EXPECT_EQ(recording.frames[40].frame_ms, 20);
    EXPECT_EQ(recording.frames[70].frame_ms, 5);
    EXPECT_TRUE(
        has_note(recording, "3 swap chains, each made when the one before was gone: '0x10' (40 frames), '0x20'"));
    for (const RecordingOptions& alone : {RecordingOptions{{}, "0x20"}, {"0x20", {}}, {"game", "0x00000020"}}) {
        const Recording chain = read(table.text(), alone);
        EXPECT_EQ(chain.frames.size(), 30u);
        EXPECT_EQ(chain.trace.settings.at("swap_chain"), "0x20");
    }
    EXPECT_TRUE(contains(refusal(table.text(), {{}, "0x40"}), "swap chain '0x40', expected one of 'game.exe'"));
}

TEST(Logs, SwapChainsBesideEachOtherStayApart) {
    Table table = game(40, 10);
    append(table, rows_of(30, 10, 0.385), "game.exe", "11", "0x20");  // begins before the other's last
    append(table, rows_of(30, 10, 0.8), "game.exe", "12", "0x10");    // another process of the same name
    append(table, rows_of(10, 10, 0.8), "game.exe", "11", "0x30");
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.streams.size(), 3u);
    EXPECT_EQ(recording.frames.size(), 50u) << "the busiest takes in what follows it";
    EXPECT_EQ(read(table.text(), {"12"}).frames.size(), 30u);
}

TEST(Logs, WithoutTimesTheOrderOfRowsTellsWhetherChainsOverlap) {
    for (const char* untold : {"", "NA", "2024-01-01T00:00:00"}) {
        Table table = game(40, 10);
        append(table, rows_of(30, 10), "game.exe", "11", "0x20");
        for (std::vector<std::string>& row : table.rows) row[time] = untold;
        EXPECT_EQ(read(table.text()).streams.size(), 1u) << untold;
        std::swap(table.rows[39], table.rows[40]);
        EXPECT_EQ(read(table.text()).streams.size(), 2u) << untold;
    }
}

TEST(Logs, CountsOfJoinedChainsAreOfAllOfThem) {
    Table table = game(4, 10);
    append(table, rows_of(4, 10, 0.04), "game.exe", "11", "0x20");
    table.rows[2][dropped] = table.rows[5][dropped] = "1";
    table.rows[3][dropped] = "Error";
    table.rows[6][frame_time] = "0";
    table.rows[7][frame_time] = "NA";
    const Recording recording = read(table.text());
    EXPECT_TRUE(has_note(recording, "2 frames dropped, never shown (the first in line 4)"));
    EXPECT_TRUE(has_note(recording, "1 frame of unknown fate"));
    EXPECT_TRUE(has_note(recording, "1 frame without a time (in line 9)"));
    EXPECT_EQ(recording.streams[0].generated, 1);
    EXPECT_EQ(recording.streams[0].frames, 7);
}

TEST(Logs, NamesMayLackExe) {
    Table table = game(5, 10);
    append(table, rows_of(9, 10), "Other", "12", "0x30");
    for (const char* name : {"game.exe", "game", "GAME", "Game.EXE", "11", "0x10"})
        EXPECT_EQ(read(table.text(), {name}).frames.size(), 5u) << name;
    for (const char* name : {"other", "Other.exe"}) EXPECT_EQ(read(table.text(), {name}).frames.size(), 9u) << name;
    EXPECT_TRUE(contains(refusal(table.text(), {".exe"}), "found no process"));
}

TEST(Logs, RowsThatCannotBeReadAreLeftOutAndNamed) {
    for (const char* noise : {"Stop", "warning: lost events, 3", "game.exe,11,0x10,DXGI,0,0.1,ten,10,3"}) {
        std::string text = "Started recording.\nwarning: not elevated\n" + game().text() + noise + "\n";
        const Recording recording = read(text);
        EXPECT_EQ(recording.frames.size(), 20u);
        EXPECT_TRUE(has_note(recording, "1 row that can't be read, the first in line 24: ")) << noise;
        EXPECT_TRUE(has_note(recording, "2 lines before the header, from line 1, 'Started recording.': left out"));
    }
}

// Ten, or one in a hundred.
TEST(Logs, MoreThanAFewUnreadableRowsAreRefused) {
    const auto text = [](std::size_t good, std::size_t bad) {
        std::string noise;
        for (std::size_t i = 0; i < bad; ++i) noise += "noise\n";
        return game(good).text() + noise;
    };
    EXPECT_EQ(read(text(20, 10)).frames.size(), 20u);
    EXPECT_TRUE(contains(refusal(text(20, 11)), "r.csv:22: found 1 fields, expected 9 or more (and 10 rows more)"));
    EXPECT_EQ(read(text(1980, 20)).frames.size(), 1980u);
    EXPECT_TRUE(contains(refusal(text(1979, 21)), "r.csv:1981: found 1 fields"));
    EXPECT_TRUE(contains(refusal(text(3, 3)), "r.csv:5: found 1 fields"));
}

// The frames of the first stream, be it the chosen one or not.
TEST(Logs, FramesAreHeardWhileTheyAreRead) {
    Table table = game(6000);
    append(table, rows_of(9000, 7, 200), "b.exe", "12", "0x30");
    for (std::size_t i = 0; i < table.rows.size(); ++i) table.rows[i][frame_time] = std::to_string(1 + i % 91);
    std::vector<double> heard;
    std::istringstream in(table.text());
    const auto hear = [&](std::span<const FrameRecord> frames) {
        for (const FrameRecord& frame : frames) heard.push_back(frame.frame_ms);
    };
    const Recording recording = read_recording(in, "r.csv", {"game.exe"}, hear);
    ASSERT_EQ(recording.frames.size(), 6000u);
    ASSERT_GT(heard.size(), 2000u);
    ASSERT_LE(heard.size(), 6000u);
    for (std::size_t i = 0; i < heard.size(); ++i) ASSERT_EQ(heard[i], recording.frames[i].frame_ms) << i;
}

TEST(Logs, AnEmptyTimeIsNone) {
    Table table = game();
    table.rows[0][frame_time] = table.rows[7][frame_time] = "";
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.frames.size(), 20u);
    EXPECT_EQ(mean(recording), 10);
    EXPECT_TRUE(has_note(recording, "2 frames without a time (the first in line 2)"));
}

}  // namespace
}  // namespace sfsm
