// Files cut anywhere and files with damaged bytes: read, or refused in one line.
#include <cstdint>
#include <random>

#include "tests/recordings/tables.h"
#include "tests/sfsm/steps.h"

namespace sfsm {
namespace {

std::string json_recording() {
    return "{\"Info\":{\"ProcessName\":\"a.exe\"},\"Runs\":[{\"CaptureData\":{\"MsBetweenPresents\":[16.1,16.2],"
           "\"Dropped\":[false,true]},\"SensorData\":{}}]}";
}

std::string our_trace() {
    std::ostringstream out;
    write_trace_header(out, {{"law", "paper"}});
    TraceRow row;
    row.motion = {motion_step(100, 5, 0.5)};
    row.shapes = {shape_step(1, 2, 3, 0.25)};
    for (row.frame = 0; row.frame < 3; ++row.frame) write_trace_row(out, row);
    return out.str();
}

std::vector<std::string> all_texts() {
    Table capframex = presentmon_1(), quoted = presentmon_2();
    capframex.preamble = {"//GPU=a", "//OS=b"};
    for (std::vector<std::string>& row : quoted.rows) row[0] = "\"a, \"\"b\"\"\"";
    return {presentmon_1().text(),
            presentmon_2().text(),
            presentmon_current().text(),
            mangohud().text(),
            fraps().text(),
            capframex.text(),
            quoted.text(),
            json_recording(),
            our_trace(),
            afterburner({"16.1", "N/A", "16.3"}),
            unreal({"8.5", "9.5"}),
            "10.5\n11.5\n9\n",
            "frame,time\n1,16\n2,17\n3,16\n"};
}

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

// Of traces of ours; others have none.
bool same_forecasts(const Trace& a, const Trace& b, std::size_t i) {
    if (a.rows.empty()) return true;
    return a.rows[i].motion == b.rows[i].motion && a.rows[i].shapes == b.rows[i].shapes;
}

TEST(HostileFiles, CutAnywhereTheyReadAsAPrefixOrAreRefused) {
    for (const std::string& text : all_texts()) {
        const Recording whole = read(text);
        for (std::size_t size = 0; size < text.size(); ++size) {
            std::istringstream in(text.substr(0, size));
            try {
                const Recording cut = read_recording(in, "r.csv");
                ASSERT_LE(cut.frames.size(), whole.frames.size());
                for (std::size_t i = 0; i < cut.frames.size(); ++i) {
                    const FrameRecord &a = cut.frames[i], &b = whole.frames[i];
                    ASSERT_TRUE(same(a.frame_ms, b.frame_ms) && same(a.cpu_ms, b.cpu_ms) && same(a.gpu_ms, b.gpu_ms) &&
                                same_forecasts(cut.trace, whole.trace, i))
                        << "frame " << i << " of the first " << size << " bytes of\n"
                        << text;
                }
            } catch (const std::runtime_error& error) {
                const std::string message = error.what();
                ASSERT_EQ(message.find('\n'), std::string::npos) << message;
                ASSERT_TRUE(message.starts_with("r.csv:")) << message;
            }
        }
    }
}

// A text with some bytes changed, doubled or left out.
std::string damaged(std::string text, std::mt19937_64& random) {
    constexpr std::string_view telling = ",;\"\n\r\t.-+eE0129nNaA/#{}[]:\0\xff";
    for (std::uint64_t i = 1 + random() % 6; i > 0 && !text.empty(); --i) {
        const std::size_t at = random() % text.size();
        const std::size_t length = std::min<std::size_t>(random() % 40, text.size() - at);
        switch (random() % 4) {
            case 0:
                text[at] = static_cast<char>(random());
                break;
            case 1:
                text[at] = telling[random() % telling.size()];
                break;
            case 2:
                text.insert(at, text.substr(at, length));
                break;
            default:
                text.erase(at, length);
        }
    }
    return text;
}

TEST(HostileFiles, DamagedBytesAreReadOrRefusedInOneLine) {
    std::mt19937_64 random(3);
    int read_count = 0, refused_count = 0;
    for (const std::string& text : all_texts()) {
        for (int trial = 0; trial < 2000; ++trial) {
            std::istringstream in(damaged(text, random));
            try {
                const Recording recording = read_recording(in, "r.csv");
                ASSERT_LT(recording.chosen, recording.streams.size());
                ASSERT_EQ(recording.streams[recording.chosen].frames,
                          static_cast<std::int64_t>(recording.frames.size()));
                for (const std::string& note : recording.notes) ASSERT_EQ(note.find('\n'), std::string::npos) << note;
                ++read_count;
            } catch (const std::runtime_error& error) {
                const std::string message = error.what();
                ASSERT_EQ(message.find_first_of("\n\r"), std::string::npos) << message;
                ++refused_count;
            }
        }
    }
    EXPECT_GT(read_count, 1000);
    EXPECT_GT(refused_count, 1000);
}

}  // namespace
}  // namespace sfsm
