// Files that gzip has packed, and UTF-16: the same as their text.
#include "tests/recordings/packed.h"

#include <random>

#include "tests/recordings/tables.h"

namespace sfsm {
namespace {

// Three blocks' length, so that what is cut at their ends is seen.
Table long_table() {
    Table table = presentmon_1();
    for (int i = 0; i < 4000; ++i)
        table.rows.push_back({"a.exe", "12", "0xA0", "DXGI", "0", std::to_string(0.05 + 0.016 * i),
                              std::to_string(16 + i % 7), "16", "3"});
    return table;
}

TEST(Packed, GzipChangesNothing) {
    for (const std::string& text : {presentmon_1().text(), long_table().text(), mangohud().text()}) {
        const Recording plain = read(text), packed = read(gzip(text));
        EXPECT_EQ(frame_times(packed), frame_times(plain));
        EXPECT_EQ(packed.format, plain.format);
        EXPECT_EQ(packed.notes, plain.notes);
    }
}

TEST(Packed, GzipMayHaveMembersAndPadding) {
    const std::string text = long_table().text();
    const std::size_t half = text.size() / 2;
    const std::string members = gzip(text.substr(0, half)) + gzip(text.substr(half));
    EXPECT_EQ(frame_times(read(members)), frame_times(read(text)));
    EXPECT_EQ(frame_times(read(members + std::string(512, '\0'))), frame_times(read(text)));
}

TEST(Packed, DamagedGzipIsRefused) {
    const std::string packed = gzip(long_table().text());
    for (std::size_t size = 2; size < packed.size(); size += 97)
        EXPECT_TRUE(contains(refusal(packed.substr(0, size)), "found gzip data that is cut short, expected all of it"));
    std::string damaged = packed;
    damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
    EXPECT_TRUE(contains(refusal(damaged), "found gzip data that is damaged"));
    EXPECT_TRUE(contains(refusal("\x1f\x8b" + std::string(100, 'x')), "found gzip data that is damaged"));
}

TEST(Packed, GzipThatSwellsIsRefused) {
    const std::string header = "MsBetweenPresents,Application\n";
    std::string rows;
    while (rows.size() < (std::size_t{12} << 20)) rows += "16,a\n";
    EXPECT_TRUE(contains(refusal(gzip(header + rows)), "swells to over 100 times its size, expected a recording"));
    rows.resize(std::size_t{1} << 20);
    EXPECT_GT(read(gzip(header + rows)).frames.size(), 100'000u) << "a small file may";
}

TEST(Packed, Utf16IsReadInEitherOrderWithAndWithoutMark) {
    for (const std::string& text : {presentmon_1().text(), long_table().text(), fraps().text()}) {
        const Recording plain = read(text);
        for (const bool is_big_endian : {false, true}) {
            const std::string mark = is_big_endian ? "\xFE\xFF" : "\xFF\xFE";
            const Recording marked = read(mark + utf16(text, is_big_endian)), bare = read(utf16(text, is_big_endian));
            EXPECT_EQ(frame_times(marked), frame_times(plain));
            EXPECT_EQ(marked.notes, plain.notes);
            EXPECT_EQ(frame_times(bare), frame_times(plain));
            EXPECT_TRUE(has_note(bare, "UTF-16 without a mark")) << "it is a guess";
            EXPECT_EQ(frame_times(read(gzip(mark + utf16(text, is_big_endian)))), frame_times(plain));
        }
    }
}

TEST(Packed, Utf16KeepsNames) {
    const std::u16string header = u"Application,MsBetweenPresents\n", rest = u",16\n";
    const auto name = [&](const std::u16string& told) {
        return read("\xFF\xFE" + utf16(header + told + rest, false)).streams.at(0).process;
    };
    EXPECT_EQ(name(u"\u00e9\u4e16\U0001F3C1.exe"), "\xC3\xA9\xE4\xB8\x96\xF0\x9F\x8F\x81.exe");
    const std::u16string halves = {0xD800, u'a', 0xDC00, 0xD801};
    EXPECT_EQ(name(halves),
              "\xEF\xBF\xBD"
              "a\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(Packed, Utf16CutAnywhereIsReadOrRefused) {
    const std::string text = "\xFF\xFE" + utf16(presentmon_1().text(), false);
    for (std::size_t size = 0; size < text.size(); ++size) {
        std::istringstream in(text.substr(0, size));
        try {
            EXPECT_LE(read_recording(in, "r.csv").frames.size(), 3u);
        } catch (const std::runtime_error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("r.csv:")) << error.what();
        }
    }
}

TEST(Packed, DamagedBytesNeverDoHarm) {
    std::mt19937_64 random(5);
    const std::string packed = gzip(presentmon_1().text()), wide = utf16(presentmon_1().text(), false);
    for (int trial = 0; trial < 4000; ++trial) {
        std::string text = trial % 2 == 0 ? packed : wide;
        for (int i = 0; i < 3; ++i) text[2 + random() % (text.size() - 2)] = static_cast<char>(random());
        std::istringstream in(text);
        try {
            const Recording recording = read_recording(in, "r.csv");
            ASSERT_EQ(recording.streams.at(recording.chosen).frames, std::ssize(recording.frames));
        } catch (const std::runtime_error& error) {
            ASSERT_EQ(std::string(error.what()).find_first_of("\r\n"), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace sfsm
