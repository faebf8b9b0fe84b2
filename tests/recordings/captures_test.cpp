// Real captures, against figures computed apart from this code: by Python's csv.DictReader over the file (after the
// preamble), rows grouped by Application, ProcessID and SwapChainAddress, the largest group; statistics.median_high,
// max and sum of its frame-time column as floats; dropped are Dropped == '1', or NA in DisplayedTime or
// MsUntilDisplayed.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

struct Capture {
    const char* file;
    const char* format;
    const char* process;
    std::size_t streams;
    std::size_t frames;
    int dropped;
    double median_ms, longest_ms, sum_ms;
    double median_cpu_ms, median_gpu_ms;  // 0: not told
    RecordingOptions options = {};        // what takes that group alone
};

constexpr Capture captures[] = {
    {"presentmon-v1/gold_case_0_v1.csv",
     "PresentMon 1.x",
     "dwm.exe",
     10,
     199,
     1,
     16.6753,
     418.0933,
     4870.4841,
     0,
     0.2252,
     {"dwm"}},
    {"presentmon-v1/gold_case_5_v1.csv",
     "PresentMon 1.x",
     "PresentBench.exe",
     7,
     259,
     84,
     11.0502,
     12.1421,
     2913.6028,
     0,
     0.937,
     {{}, "0x2A70D2CAC00"}},
    {"presentmon-v1/farcrynewdawn_80ms_spike.csv", "PresentMon 1.x", "FarCryNewDawn.exe", 1, 1171, 0, 12.545, 80.095,
     15255.999, 0, 0},
    {"presentmon-v2/gold_case_5_v2.csv",
     "PresentMon 2.x",
     "PresentBench.exe",
     7,
     258,
     84,
     11.0658,
     12.1648,
     2902.5904,
     10.5215,
     0.937,
     {{}, "0x2a70d2cac00"}},
    {"presentmon-v2/gold_case_5_current.csv",
     "PresentMon current",
     "PresentBench.exe",
     7,
     258,
     84,
     11.0522,
     12.1421,
     2902.5974,
     10.5215,
     0.937,
     {{}, "0x2A70D2CAC00"}},
    {"ocat/OCAT-MetroExodus.exe-2019-02-20T101522.csv", "OCAT", "MetroExodus.exe", 1, 2502, 0, 10.201, 17.945,
     25386.433, 0, 0},
    {"capframex-csv/re2_280fps_58pct_dropped.csv", "CapFrameX CSV", "re2.exe", 1, 7285, 4236, 3.428, 8.211, 25443.206,
     0, 0},
};

double median(const std::vector<FrameRecord>& frames, double FrameRecord::*time) {
    std::vector<double> times;
    for (const FrameRecord& frame : frames) {
        if (!std::isnan(frame.*time)) times.push_back(frame.*time);
    }
    if (times.empty()) return 0;
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

class Captures : public testing::TestWithParam<Capture> {};

TEST_P(Captures, ReadAsTheirToolMeantThem) {
    constexpr double rounding_ms = 1e-3;  // of sums written with four decimals
    const Capture& expected = GetParam();
    const std::filesystem::path path = std::filesystem::path(GRANDSTAND_SHARED) / "traces" / expected.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path << ": real captures are not at hand";
    std::ifstream file(path, std::ios::binary);
    const Recording recording = read_recording(file, expected.file, expected.options);
    const Stream& chosen = recording.streams.at(recording.chosen);
    EXPECT_EQ(recording.format, expected.format);
    EXPECT_EQ(recording.streams.size(), expected.streams);
    EXPECT_EQ(chosen.process, expected.process);
    EXPECT_EQ(chosen.frames, static_cast<std::int64_t>(expected.frames));
    EXPECT_EQ(recording.frames.size(), expected.frames);
    EXPECT_NEAR(chosen.seconds * 1000, expected.sum_ms, rounding_ms);
    EXPECT_EQ(median(recording.frames, &FrameRecord::frame_ms), expected.median_ms);
    EXPECT_EQ(median(recording.frames, &FrameRecord::cpu_ms), expected.median_cpu_ms);
    EXPECT_EQ(median(recording.frames, &FrameRecord::gpu_ms), expected.median_gpu_ms);
    const std::vector<double> times = frame_times(recording);
    EXPECT_EQ(*std::max_element(times.begin(), times.end()), expected.longest_ms);
    if (expected.dropped == 0) {
        ASSERT_EQ(recording.notes.size(), 1u);
        EXPECT_TRUE(contains(recording.notes[0], "animation error is not recorded: computed from TimeInSeconds +"));
    } else {
        EXPECT_TRUE(has_note(recording, std::to_string(expected.dropped) + " frame"));
    }
}

std::string test_name(const testing::TestParamInfo<Capture>& info) {
    std::string name = std::filesystem::path(info.param.file).stem().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(All, Captures, testing::ValuesIn(captures), test_name);

}  // namespace
}  // namespace sfsm
