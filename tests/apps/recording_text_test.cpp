// A recording's figures and frames as text: tables, JSON, and a table of frames that can be read back.
#include "apps/recording_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "sfsm/number_text.h"
#include "sfsm/recordings/recording.h"

namespace apps {
namespace {

using Json = nlohmann::ordered_json;
using sfsm::FrameRecord;

// Frames of which everything is told, with a stutter of each of two causes.
std::vector<FrameRecord> told_frames() {
    std::vector<FrameRecord> frames(200);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        FrameRecord& frame = frames[i];
        const bool is_long = i == 60 || i == 150;
        frame.frame_ms = (is_long ? 90 : 9) + static_cast<double>(i % 4) / 3;
        frame.cpu_ms = 0.3 * frame.frame_ms;
        frame.gpu_ms = 0.95 * frame.frame_ms;
        frame.display_ms = static_cast<float>(frame.frame_ms);
        frame.animation_error_ms = i % 2 == 0 ? 0.1f : -0.3f;
        frame.fate = i == 7 ? FrameRecord::Fate::dropped : FrameRecord::Fate::shown;
        frame.compilations = i == 60 ? 4.0f : 0.0f;
    }
    return frames;
}

Json json_of(const std::vector<FrameRecord>& frames) {
    return figures_json(sfsm::figures_of(frames, 3, sfsm::usual_limits_ms), sfsm::stutters_of(frames));
}

TEST(FiguresJson, HasEachFigureUnderItsName) {
    const std::vector<FrameRecord> frames = told_frames();
    const sfsm::Figures figures = sfsm::figures_of(frames, 3, sfsm::usual_limits_ms);
    const Json json = json_of(frames);
    const std::vector<std::pair<const char*, double>> expected = {
        {"average_fps", figures.average_fps},
        {"median_fps", figures.median_fps},
        {"p1_fps", figures.p1_fps},
        {"p0_1_fps", figures.p01_fps},
        {"min_fps", figures.least_fps},
        {"max_fps", figures.most_fps},
        {"mean_ms", figures.mean_ms},
        {"median_ms", figures.median_ms},
        {"p99_ms", figures.p99_ms},
        {"p99_9_ms", figures.p999_ms},
        {"min_ms", figures.least_ms},
        {"max_ms", figures.most_ms},
        {"mean_step_ms", figures.mean_step_ms},
        {"mean_animation_error_ms", figures.mean_animation_error_ms},
        {"seconds", figures.seconds}};
    for (const auto& [key, value] : expected) EXPECT_EQ(json.at(key), value) << key;
    EXPECT_EQ(json.at("low_1_percent_fps"), (Json{{"percentile", figures.low_1.percentile},
                                                  {"mean", figures.low_1.mean},
                                                  {"integral", figures.low_1.integral}}));
    EXPECT_EQ(json.at("low_0_1_percent_fps").at("integral"), figures.low_01.integral);
    EXPECT_EQ(json.at("frames"), 200);
    EXPECT_EQ(json.at("timed"), 200);
    EXPECT_EQ(json.at("dropped"), 1);
    EXPECT_EQ(json.at("generated"), 3);
    EXPECT_EQ(json.at("displayed"), 200);
    EXPECT_EQ(json.at("bottleneck"), (Json{{"frames", 200}, {"gpu", 1.0}, {"cpu", 0.0}, {"neither", 0.0}}));
    ASSERT_EQ(json.at("over_ms").size(), 3u);
    EXPECT_EQ(json.at("over_ms")[2], (Json{{"limit_ms", 33.3}, {"frames", 2}, {"share", 0.01}}));
}

TEST(FiguresJson, TellsStuttersByTheirCause) {
    const Json stutter = json_of(told_frames()).at("stutter");
    EXPECT_EQ(stutter.at("count"), 2);
    EXPECT_EQ(stutter.at("factor"), 2.5);
    EXPECT_EQ(stutter.at("window_frames"), sfsm::stutter_window(10.3));
    EXPECT_EQ(stutter.at("by_cause"), Json::parse(R"({"recorder": 0, "compilation": 1, "gpu": 1, "cpu": 0,
                                                      "waiting": 0, "untold": 0})"));
}

void expect_no_number(const Json& json, const std::string& name) {
    if (json.is_object() || json.is_array()) {
        for (const auto& [key, value] : json.items()) expect_no_number(value, name + '/' + key);
    } else if (json.is_number_float()) {
        EXPECT_TRUE(json == 2.5 || json == 0.0 || name.ends_with("limit_ms")) << name << ' ' << json;
    }
}

TEST(FiguresJson, OfNothingIsNull) {
    const Json json = json_of({});
    EXPECT_TRUE(json.at("average_fps").is_null());
    EXPECT_TRUE(json.at("low_1_percent_fps").at("mean").is_null());
    EXPECT_TRUE(json.at("stutter").at("share").is_null());
    EXPECT_TRUE(json.at("bottleneck").at("gpu").is_null());
    EXPECT_EQ(json.at("frames"), 0);
    expect_no_number(json, "");
}

std::vector<sfsm::Difference> some_differences() {
    constexpr double nothing = FrameRecord::untold;
    return {{"average", "fps", 100, 103, 0.03, 0.021, 0.04, false},
            {"P1", "fps", 50, 40, -0.2, nothing, nothing, false},
            {"time in stutter", "%", 0.01, 0.015, 0.005, -0.001, 0.011, true}};
}

TEST(DifferencesJson, HasAnObjectForEach) {
    const Json json = differences_json(some_differences());
    ASSERT_EQ(json.size(), 3u);
    EXPECT_EQ(json[0], Json::parse(R"({"name": "average", "unit": "fps", "first": 100.0, "second": 103.0,
        "change": 0.03, "low": 0.021, "high": 0.04, "is_share": false, "is_clear": true})"));
    EXPECT_TRUE(json[1].at("low").is_null());
    EXPECT_FALSE(json[1].at("is_clear"));
    EXPECT_TRUE(json[2].at("is_share"));
}

TEST(DifferencesTable, SaysWhatIsClear) {
    std::ostringstream out;
    write_differences(out, "old.csv", "new.csv", some_differences());
    EXPECT_EQ(out.str(),
              "                      old.csv   new.csv        change            95 % within\n"
              "average [fps]           100.0     103.0        +3.0 %         +2.1 to +4.0 %     clear\n"
              "P1 [fps]                 50.0      40.0       -20.0 %                      \u2013\n"
              "time in stutter [%]      1.00      1.50  +0.50 points  -0.10 to +1.10 points\n");
}

using Named = std::pair<std::string, sfsm::Figures>;

std::string figures_table(const std::vector<Named>& named) {
    std::vector<sfsm::ReportedRecording> recordings;
    for (const auto& [name, figures] : named) recordings.push_back({name, {}, {}, {}, figures, {}});
    std::ostringstream out;
    write_figures(out, recordings);
    return out.str();
}

// The line that begins with a label, or nothing.
std::string line_of(const std::string& table, const std::string& label) {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(label)) return line;
    }
    return "";
}

std::vector<FrameRecord> bare_frames(std::size_t count, double ms) {
    std::vector<FrameRecord> frames(count);
    for (FrameRecord& frame : frames) frame.frame_ms = ms;
    return frames;
}

TEST(FiguresTable, HasAColumnForEachRecording) {
    const std::string table =
        figures_table({{"one.csv", sfsm::figures_of(told_frames(), 3, sfsm::usual_limits_ms)},
                       {"another-name.csv", sfsm::figures_of(bare_frames(50, 20), 0, sfsm::usual_limits_ms)}});
    EXPECT_EQ(line_of(table, "  average"), "  average [fps]                   97.0              50.0");
    EXPECT_EQ(line_of(table, "  over 16.7"), "  over 16.7 ms [% of frames]      1.00            100.00");
    EXPECT_EQ(line_of(table, "  generated"), "  generated                          3                 0");
    EXPECT_EQ(line_of(table, "  stutters"), "  stutters                           2                 0");
    EXPECT_EQ(line_of(table, "  GPU"), "  GPU [% of time]                100.0                 -");
}

TEST(FiguresTable, LeavesOutWhatNoRecordingTells) {
    const std::string table = figures_table({{"a", sfsm::figures_of(bare_frames(50, 20), 0, {})}});
    for (const char* label : {"Held up by", "  dropped", "  generated", "  animation", "  over"})
        EXPECT_EQ(line_of(table, label), "") << label;
    EXPECT_NE(line_of(table, "  frames"), "");
}

std::string csv_of(const std::string& name, const std::vector<FrameRecord>& frames, bool header = true) {
    std::ostringstream out;
    write_frames_csv(out, name, frames, header);
    return out.str();
}

TEST(FramesCsv, LeavesEmptyWhatIsNotTold) {
    std::vector<FrameRecord> frames = bare_frames(3, 12.5);
    frames[1] = FrameRecord{};
    frames[2].fate = FrameRecord::Fate::dropped;
    frames[2].cpu_ms = 4;
    frames[2].animation_error_ms = -0.1f;
    EXPECT_EQ(csv_of("a", frames),
              "run,frame,time_s,frame_time_ms,cpu_ms,gpu_ms,display_ms,animation_error_ms,dropped,compilations\n"
              "a,0,0,12.5,,,,,,\n"
              "a,1,0.0125,,,,,,,\n"
              "a,2,0.0125,12.5,4,,,-0.1,1,\n");
    EXPECT_EQ(csv_of("b", {}, false), "");
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) c == ',' ? void(fields.emplace_back()) : void(fields.back() += c);
    return fields;
}

TEST(FramesCsv, NumbersReadBackToTheSameBits) {
    const std::vector<FrameRecord> frames = told_frames();
    std::istringstream lines(csv_of("a", frames, false));
    std::string line;
    for (const FrameRecord& frame : frames) {
        ASSERT_TRUE(std::getline(lines, line));
        const std::vector<std::string> fields = fields_of(line);
        ASSERT_EQ(fields.size(), 10u);
        const auto read = [&](std::size_t i) { return sfsm::parse_double(fields[i]).value(); };
        EXPECT_EQ(read(3), frame.frame_ms);
        EXPECT_EQ(read(4), frame.cpu_ms);
        EXPECT_EQ(read(5), frame.gpu_ms);
        EXPECT_EQ(static_cast<float>(read(6)), frame.display_ms);
        EXPECT_EQ(static_cast<float>(read(7)), frame.animation_error_ms);
        EXPECT_EQ(fields[8], frame.fate == FrameRecord::Fate::dropped ? "1" : "0");
        EXPECT_EQ(static_cast<float>(read(9)), frame.compilations);
    }
}

sfsm::Recording read_back(const std::string& text, const std::string& run = "") {
    std::istringstream in(text);
    return sfsm::read_recording(in, "frames.csv", {.process = run});
}

// Two numbers, or none on both sides.
template <class Number>
bool is_same(Number a, Number b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

void expect_same(const std::vector<FrameRecord>& found, const std::vector<FrameRecord>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const FrameRecord &a = found[i], &b = expected[i];
        EXPECT_TRUE(is_same(a.frame_ms, b.frame_ms) && is_same(a.cpu_ms, b.cpu_ms) && is_same(a.gpu_ms, b.gpu_ms)) << i;
        EXPECT_TRUE(is_same(a.display_ms, b.display_ms)) << i << ' ' << a.display_ms << ' ' << b.display_ms;
        EXPECT_TRUE(is_same(a.animation_error_ms, b.animation_error_ms)) << i;
        EXPECT_TRUE(is_same(a.compilations, b.compilations)) << i;
        EXPECT_EQ(a.fate, b.fate) << i;
    }
}

// Frames of which everything is told somewhere and not told elsewhere; one that was dropped has no display's time.
std::vector<FrameRecord> partly_told_frames() {
    std::vector<FrameRecord> frames = told_frames();
    frames[7].display_ms = frames[7].animation_error_ms = FrameRecord().display_ms;
    frames[20] = FrameRecord{};
    frames[30].cpu_ms = frames[31].gpu_ms = FrameRecord::untold;
    frames[32].compilations = FrameRecord().compilations;
    frames[33].fate = FrameRecord::Fate::untold;
    return frames;
}

TEST(FramesCsv, IsReadAsARecordingOfTheSameFrames) {
    for (const std::string name : {"game.csv", "a \"game\", its log;\n2\t.csv", ""}) {
        SCOPED_TRACE(name);
        expect_same(read_back(csv_of(name, partly_told_frames())).frames, partly_told_frames());
        expect_same(read_back(csv_of(name, bare_frames(3, 12.5))).frames, bare_frames(3, 12.5));
    }
}

TEST(FramesCsv, OfSeveralRunsEachIsReadByItsName) {
    const std::string text = csv_of("old.csv", partly_told_frames()) + csv_of("new.csv", bare_frames(3, 12.5), false);
    expect_same(read_back(text).frames, partly_told_frames());
    expect_same(read_back(text, "new.csv").frames, bare_frames(3, 12.5));
}

}  // namespace
}  // namespace apps
