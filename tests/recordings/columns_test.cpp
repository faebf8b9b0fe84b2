// Times in a column: of Afterburner, of Unreal, of games, of anybody.
#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

std::string lines(const std::vector<std::string>& rows) {
    std::string text;
    for (const std::string& row : rows) text += row + '\n';
    return text;
}

// 10.5, 11.5, 12.5 and again, told as `row` makes lines of them.
template <typename Row>
std::string thirty(const std::string& header, const Row& row) {
    std::string text = header;
    for (int i = 0; i < 30; ++i) text += row(i, 10.5 + i % 3) + '\n';
    return text;
}

RecordingOptions of_column(const std::string& column, std::optional<Unit> unit = {}) {
    RecordingOptions options;
    options.column = column;
    options.unit = unit;
    return options;
}

void expect_thirty(const Recording& recording) {
    ASSERT_EQ(recording.frames.size(), 30u);
    for (std::size_t i = 0; i < 30; ++i) {
        EXPECT_NEAR(recording.frames[i].frame_ms, 10.5 + static_cast<double>(i % 3), 1e-9);
    }
}

TEST(Columns, AfterburnersSamplesAreRows) {
    const Recording recording = read(afterburner({"16.667", "16.667", "N/A", "20.5"}));
    EXPECT_EQ(recording.format, "Afterburner");
    ASSERT_EQ(recording.frames.size(), 4u);
    EXPECT_EQ(recording.frames[0].frame_ms, 16.667);
    EXPECT_TRUE(std::isnan(recording.frames[2].frame_ms));
    EXPECT_EQ(recording.frames[3].frame_ms, 20.5);
    EXPECT_EQ(recording.trace.settings.at("GPU"), "GeForce RTX");
    EXPECT_TRUE(has_note(recording, "samples, taken now and then"));
    EXPECT_FALSE(has_note(recording, "left out")) << "its own lines are no noise";
}

TEST(Columns, AfterburnersLogsFollowOneAnother) {
    const Recording recording = read(afterburner({"16", "17"}) + afterburner({"18"}));
    EXPECT_EQ(frame_times(recording), (std::vector<double>{16, 17, 18}));
}

TEST(Columns, AfterburnerMayTellRatesAlone) {
    std::string text = afterburner({"0", "0"});
    const std::size_t name = text.find("Frametime");
    text.replace(name, 9, "GPU clock");
    EXPECT_EQ(frame_times(read(text)), std::vector<double>(2, 1000 / 60.0));
}

TEST(Columns, AfterburnersCsvIsTheSameWithoutKinds) {
    EXPECT_EQ(frame_times(read("Time,GPU usage,Framerate,Frametime\n1,95,60,16.5\n2,95,50,20\n")),
              (std::vector<double>{16.5, 20}));
    EXPECT_EQ(frame_times(read("Time;Framerate;Frametime\n1;60,0;16,5\n2;50,0;20,0\n")),
              (std::vector<double>{16.5, 20}));
    EXPECT_EQ(frame_times(read("Time,GPU usage,Framerate\n1,95,50\n2,95,40\n")), (std::vector<double>{20, 25}));
}

TEST(Columns, UnrealsProfile) {
    const Recording recording = read(unreal({"8.5", "9.5"}));
    EXPECT_EQ(recording.format, "Unreal CSV profile");
    EXPECT_EQ(frame_times(recording), (std::vector<double>{8.5, 9.5}));
    EXPECT_EQ(recording.frames[0].cpu_ms, 5.1);
    EXPECT_EQ(recording.frames[0].gpu_ms, 3.1);
    EXPECT_EQ(recording.trace.settings.at("Platform"), "Windows");
    EXPECT_FALSE(recording.trace.settings.contains("Commandline")) << "it names the user's folders";
    EXPECT_TRUE(recording.notes.empty()) << recording.notes[0];
}

TEST(Columns, UnrealsRowsMayGrowAndHaveEvents) {
    const std::string text =
        "EVENTS,FrameTime,GameThreadTime\n,8.5,6\nmap;load,0,6,1,2\n,9.5,6,1,2\n"
        "EVENTS,FrameTime,GameThreadTime,New/a,New/b\n[HasHeaderRowAtEnd],1\n";
    const Recording recording = read(text);
    ASSERT_EQ(recording.frames.size(), 3u);
    EXPECT_TRUE(std::isnan(recording.frames[1].frame_ms)) << "a time of 0 is none, and no generated frame";
    EXPECT_EQ(recording.frames[2].frame_ms, 9.5);
}

TEST(Columns, AGamesTableIsReadByItsNames) {
    const auto number = [](double value) { return std::to_string(value); };
    for (const char* header : {"Frame index, Frame time (ms), DLSS Frame Generation (ms)", "frame,FrameTime [ms],x",
                               "#;frame_time_ms;x", "n,FrameTimeMs,fps", "scene,Frame Time,fps"}) {
        const char separator = std::string(header).find(';') == std::string::npos ? ',' : ';';
        expect_thirty(read(thirty(std::string(header) + '\n', [&](int i, double ms) {
            return std::to_string(i) + separator + ' ' + number(ms) + separator + " 1";
        })));
    }
    for (const char* header :
         {"frame,ms", "Frame,Time", "frame number,duration", "index,time (ms)", "Frame, Time (ms)"}) {
        expect_thirty(read(thirty(std::string(header) + '\n',
                                  [&](int i, double ms) { return std::to_string(i) + ',' + number(ms); })));
    }
}

TEST(Columns, OneNumberALineIsAColumn) {
    const auto number = [](int, double ms) { return std::to_string(ms); };
    for (const char* header : {"", "frametime\n", "ms\n", "\"Frame time\"\n", "# made by hand\n"}) {
        const Recording recording = read(thirty(header, number));
        EXPECT_EQ(recording.format, "a column of times");
        expect_thirty(recording);
    }
    EXPECT_TRUE(has_note(read(thirty("", number)), "no unit told: taken for ms"));
    EXPECT_FALSE(has_note(read(thirty("ms\n", number)), "no unit told"));
    EXPECT_EQ(read(lines({"10,5", "11,5", "nan", "noise", "9"})).frames.size(), 4u);
}

TEST(Columns, TheUnitIsToldOrTheOneInWhichAFrameIsLikely) {
    struct Told {
        double factor;
        Unit unit;
        const char* name;
    };
    for (const Told& told :
         {Told{1e-3, Unit::s, "s"}, {1, Unit::ms, "ms"}, {1e3, Unit::us, "us"}, {1e6, Unit::ns, "ns"}}) {
        const auto row = [&](int, double ms) { return std::to_string(ms * told.factor); };
        expect_thirty(read(thirty("", row)));
        EXPECT_TRUE(has_note(read(thirty("", row)), std::string("taken for ") + told.name + ","));
        expect_thirty(read(thirty("x\n", row), of_column("x", told.unit)));
        expect_thirty(read(thirty("Frame time (" + std::string(told.name) + ")\n", row)));
    }
    const auto fps = [](int, double ms) { return std::to_string(1000 / ms); };
    const Recording rates = read(thirty("x\n", fps), of_column("x", Unit::fps));
    ASSERT_EQ(rates.frames.size(), 30u);
    EXPECT_NEAR(rates.frames[0].frame_ms, 10.5, 1e-3);
    EXPECT_NEAR(read(thirty("fps\n", fps), of_column("fps")).frames[1].frame_ms, 11.5, 1e-3);
    EXPECT_TRUE(std::isnan(read("fps\n0\n60\n", of_column("fps")).frames[0].frame_ms));
}

TEST(Columns, TimesThatGoOnAreAClock) {
    double at = 100;
    const std::string text = "frame,time\n0,100\n" + thirty("", [&](int i, double ms) {
                                 return std::to_string(i + 1) + ',' + std::to_string(at += ms);
                             });
    const Recording recording = read(text);
    expect_thirty(recording);
    EXPECT_TRUE(has_note(recording, "taken for a clock"));
}

TEST(Columns, AnyColumnCanBeNamed) {
    const std::string text = "scene,GPU frame,CPU frame\na,8000,9000\nb,8200,9100\n";
    EXPECT_EQ(frame_times(read(text, of_column("gpu FRAME", Unit::us))), (std::vector<double>{8, 8.2}));
    EXPECT_EQ(frame_times(read(text, of_column("CPU frame"))), (std::vector<double>{9, 9.1}));
    EXPECT_EQ(frame_times(read("1,8,9\n2,8.5,9.5\n", of_column("2", Unit::ms))), (std::vector<double>{8, 8.5}));
    EXPECT_EQ(frame_times(read("GPUs,ms of it\n8,9\n9,10\n", of_column("GPUs"))), (std::vector<double>{8, 9}))
        << "no unit is in that name";
    Table table = presentmon_1();
    table.rows.push_back({"b.exe", "13", "0xB0", "DXGI", "0", "0.1", "8", "8", "1"});
    const Recording gpu = read(table.text(), of_column("msGPUActive"));
    EXPECT_EQ(frame_times(gpu), (std::vector<double>{3.1, 3.2, 3.3})) << "of the busiest process";
}

TEST(Columns, WhereNoneIsKnownThoseThatThereAreAreNamed) {
    const std::string text = "scene,GPU frame,CPU frame\na,8000,9000\nb,8200,9100\n";
    EXPECT_TRUE(
        contains(refusal(text), "found columns 'GPU frame', 'CPU frame', expected one of them named as --column"));
    EXPECT_TRUE(contains(refusal(text, of_column("x")), "found no column 'x' but columns 'GPU frame', 'CPU frame'"));
    EXPECT_TRUE(contains(refusal("1,8,9\n2,8.5,9.5\n"), "found columns '1', '2', '3', expected one of them"));
    EXPECT_TRUE(contains(refusal("a\nb\n", of_column("x")), "found no column 'x' but 'a', expected"));
    std::string names = "a", values = "a";
    for (int i = 0; i < 100; ++i) {
        names += ",a name of a column " + std::to_string(i);
        values += ",1";
    }
    EXPECT_LT(refusal(names + '\n' + values + '\n').size(), 200u);
    EXPECT_TRUE(contains(refusal(names + '\n' + values + '\n'), " ..., expected one of them"));
    EXPECT_LT(refusal(std::string(5000, 'x') + '\n').size(), 200u);
}

}  // namespace
}  // namespace sfsm
