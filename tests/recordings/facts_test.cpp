// What recordings say of the run and the machine.
#include "sfsm/recordings/facts.h"

#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

std::string fact(const Recording& recording, const std::string& name) {
    std::string found;
    for (const auto& [key, value] : recording.facts) {
        EXPECT_FALSE(value.empty()) << key;
        if (key != name) continue;
        EXPECT_EQ(found, "") << "told twice: " << name;
        found = value;
    }
    return found;
}

TEST(Facts, OfPresentMonsColumns) {
    Table table = presentmon_current();
    table.columns.push_back("PresentMode");
    for (const char* mode : {"Composed: Flip", "Hardware: Independent Flip", "Hardware: Independent Flip"}) {
        const std::size_t row = mode[0] == 'C' ? 0 : table.rows[1].size() < table.columns.size() ? 1 : 2;
        table.rows[row].push_back(mode);
    }
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.facts, (Facts{{"game", "a.exe"},
                                      {"API", "DXGI"},
                                      {"present mode", "Hardware: Independent Flip"},
                                      {"recorder", "PresentMon current"}}));
    EXPECT_EQ(fact(read(presentmon_1().text()), "API"), "DXGI") << "where it is called Runtime";
}

TEST(Facts, OfTheChosenStream) {
    Table table = presentmon_1();
    for (int i = 0; i < 2; ++i) table.rows.push_back({"b.exe", "13", "0xB0", "D3D9", "0", "1", "8", "8", "1"});
    EXPECT_EQ(fact(read(table.text()), "game"), "a.exe");
    EXPECT_EQ(fact(read(table.text(), {"b"}), "game"), "b.exe");
    EXPECT_EQ(fact(read(table.text(), {"b"}), "API"), "D3D9");
}

TEST(Facts, OfOcatsFirstRowThatHasThem) {
    Table table = presentmon_1();
    table.columns.insert(table.columns.end(), {"Motherboard", "OS", "Processor", "System RAM", "Base Driver Version",
                                               "Driver Package", "GPU #", "GPU", "Comment"});
    table.rows[1].insert(table.rows[1].end(),
                         {"MSI", "\"Windows 10, 1809\"", "i9-9900K", "32 GB DDR4 3200 MT/s", "41891", "r418_77", "1",
                          "\"GeForce \"\"RTX\"\" 2080 Ti\"", "C:\\Users\\bob\\notes.txt"});
    const Recording recording = read(table.text());
    EXPECT_EQ(recording.facts, (Facts{{"game", "a.exe"},
                                      {"GPU", "GeForce \"RTX\" 2080 Ti"},
                                      {"driver", "r418_77"},
                                      {"CPU", "i9-9900K"},
                                      {"memory", "32 GB DDR4 3200 MT/s"},
                                      {"system", "Windows 10, 1809"},
                                      {"API", "DXGI"},
                                      {"recorder", "OCAT"}}));
}

TEST(Facts, OfFrameViewsColumns) {
    Table table = presentmon_1();
    table.columns.insert(table.columns.end(), {"GPU", "CPU", "Resolution"});
    for (std::vector<std::string>& row : table.rows) row.insert(row.end(), {"RTX 4090", "i9-13900K", "3840x2160"});
    const Recording recording = read(table.text());
    EXPECT_EQ(fact(recording, "GPU"), "RTX 4090");
    EXPECT_EQ(fact(recording, "CPU"), "i9-13900K");
    EXPECT_EQ(fact(recording, "resolution"), "3840x2160");
    table.rows[0][9] = "97";
    EXPECT_EQ(fact(read(table.text()), "GPU"), "RTX 4090") << "a load is no name";
}

TEST(Facts, OfCapFrameXsLinesAndInfo) {
    Table table = presentmon_1();
    table.preamble = {"//GameName=Far Cry", "//CreationDate=2019-03-30", "//CreationTime=12:01:36",
                      "//Processor=i9",     "//System RAM=32 GB",        "//GPU=RTX 2080",
                      "//Driver Package=-", "//Comment=/home/bob/x.txt"};
    const Recording csv = read(table.text());
    EXPECT_EQ(csv.facts, (Facts{{"game", "Far Cry"},
                                {"process", "a.exe"},
                                {"GPU", "RTX 2080"},
                                {"CPU", "i9"},
                                {"memory", "32 GB"},
                                {"API", "DXGI"},
                                {"recorder", "CapFrameX CSV"},
                                {"date", "2019-03-30 12:01:36"}}));
    const Recording json =
        read(R"({"Info":{"ProcessName":"C:\\Games\\g.exe","GameName":"Game","GPU":"RX","GPUDriverVersion":"31.0",)"
             R"("Processor":"R7","SystemRam":"32GB","OS":"Windows 11","ApiInfo":"DX12","ResolutionInfo":"2560x1440",)"
             R"("PresentationMode":"Flip","AppVersion":"1.7.1","CreationDate":"2024-01-02","Comment":"D:\\x"},)"
             R"("Runs":[{"CaptureData":{"MsBetweenPresents":[10]}}]})");
    EXPECT_EQ(json.facts, (Facts{{"game", "Game"},
                                 {"process", "g.exe"},
                                 {"GPU", "RX"},
                                 {"driver", "31.0"},
                                 {"CPU", "R7"},
                                 {"memory", "32GB"},
                                 {"system", "Windows 11"},
                                 {"API", "DX12"},
                                 {"resolution", "2560x1440"},
                                 {"present mode", "Flip"},
                                 {"recorder", "CapFrameX JSON 1.7.1"},
                                 {"date", "2024-01-02"}}));
}

TEST(Facts, OfMangoHudAfterburnerAndUnreal) {
    Table table = mangohud();
    table.preamble = {"v1", "0.7.1", "--------------------SYSTEM INFO--------------------",
                      "os,cpu,gpu,ram,kernel,driver,cpuscheduler",
                      "Arch,Ryzen 7,AMD RX 6800/PCIe/SSE2,32768000,6.1,Mesa 23.1/24.0,schedutil"};
    EXPECT_EQ(read(table.text()).facts, (Facts{{"GPU", "AMD RX 6800/PCIe/SSE2"},
                                               {"driver", "Mesa 23.1/24.0"},
                                               {"CPU", "Ryzen 7"},
                                               {"memory", "31 GB"},
                                               {"system", "Arch, kernel 6.1"},
                                               {"recorder", "MangoHud 0.7.1"}}));
    EXPECT_EQ(read(afterburner({"16.1", "16.2"})).facts,
              (Facts{{"GPU", "GeForce RTX"},
                     {"recorder", "Afterburner Hardware monitoring log v1.6"},
                     {"date", "01-01-2026 00:00:00"}}));
    EXPECT_EQ(read(unreal({"16.1", "16.2"})).facts, (Facts{{"system", "Windows"}, {"recorder", "Unreal CSV profile"}}));
}

TEST(Facts, OfOurOwnTraces) {
    std::ostringstream out;
    write_trace_header(out, {{"law", "paper"},
                             {"people", "20000"},
                             {"seed", "3"},
                             {"size", "1280x720"},
                             {"draw", "gl"},
                             {"device", "RTX 2080"},
                             {"character", "/home/bob/models/person.glb"}});
    TraceRow row;
    row.target_ms = row.frame_ms = 16;
    write_trace_row(out, row);
    EXPECT_EQ(read(out.str()).facts, (Facts{{"law", "paper"},
                                            {"device", "RTX 2080"},
                                            {"people", "20000"},
                                            {"seed", "3"},
                                            {"size", "1280x720"},
                                            {"draw", "gl"}}));
}

TEST(Facts, NeverNameAFolder) {
    struct Case {
        const char *told, *shown;
    };
    const Case cases[] = {{"C:\\Users\\bob\\game.exe", "game.exe"},
                          {"c:/games/x/Game-Win64.exe", "Game-Win64.exe"},
                          {"\\\\server\\share\\a.exe", "a.exe"},
                          {"/home/bob/.steam/game.x86", "game.x86"},
                          {"~/games/run.sh -w", "run.sh -w"},
                          {"games\\bob\\a.exe", "a.exe"},
                          {"bob/a.exe", "a.exe"},
                          {"run C:\\Users\\bob\\game.exe -full", "game.exe -full"},
                          {"C:\\Users\\bob", ""},
                          {"C:\\Users\\bob\\", ""},
                          {"/home/bob", ""},
                          {"in /home/bob", ""},
                          {"32 GB DDR4 3200 MT/s", "32 GB DDR4 3200 MT/s"},
                          {"GeForce RTX 3080/PCIe/SSE2", "GeForce RTX 3080/PCIe/SSE2"},
                          {"OpenGL / Vulkan 1.3", "OpenGL / Vulkan 1.3"},
                          {" RTX\t4090 ", "RTX?4090"},
                          {"N/A", ""},
                          {"-", ""},
                          {"", ""}};
    for (const Case& each : cases) EXPECT_EQ(presentable(each.told), each.shown) << each.told;
    EXPECT_EQ(presentable(std::string(500, 'x')).size(), 123u);
    for (const char* process : {"C:\\Users\\bob\\a.exe", "/home/bob/a.exe"}) {
        Table table = presentmon_2();
        for (std::vector<std::string>& row : table.rows) row[0] = process;
        EXPECT_EQ(fact(read(table.text()), "game"), "a.exe");
    }
}

TEST(Facts, NorDoNotes) {
    Table table = presentmon_1();
    table.preamble = {"Recording to C:\\Users\\bob\\log.csv", "started"};
    const Recording recording = read(table.text());
    EXPECT_TRUE(has_note(recording, "2 lines before the header, from line 1, 'log.csv': left out"));
    table.preamble[0] = "Recording to C:\\Users\\bob";
    EXPECT_TRUE(has_note(read(table.text()), "2 lines before the header, from line 1: left out"));
}

}  // namespace
}  // namespace sfsm
