#include "sfsm/line_reader.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <stdexcept>

namespace sfsm {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    LineReader reader(in, "t");
    std::vector<std::string> lines;
    for (std::string_view line; reader.next(line);) lines.emplace_back(line);
    EXPECT_EQ(reader.number(), static_cast<std::int64_t>(lines.size()));
    return lines;
}

TEST(LineReader, ReadsWhatGetlineReads) {
    std::mt19937_64 random(1);
    std::string text;
    // Lines from nothing to several blocks, so that they end everywhere in a block.
    for (int i = 0; i < 300; ++i) {
        text += std::string(random() % (i % 50 == 0 ? 200'000 : 3000), static_cast<char>('a' + i % 26)) + "\n";
    }
    text += "last";
    std::istringstream in(text);
    std::vector<std::string> expected;
    for (std::string line; std::getline(in, line);) expected.push_back(line);
    EXPECT_EQ(lines_of(text), expected);
}

TEST(LineReader, LineEndsAndTheByteOrderMarkAreNoText) {
    EXPECT_EQ(lines_of("\xEF\xBB\xBF"
                       "a\r\n\r\nb\n"),
              (std::vector<std::string>{"a", "", "b"}));
    EXPECT_TRUE(lines_of("").empty());
    EXPECT_EQ(lines_of("\n"), std::vector<std::string>{""});
}

TEST(LineReader, SaysWhetherTheLastLineIsWhole) {
    std::istringstream in("a\nb");
    LineReader reader(in, "t");
    std::string_view line;
    ASSERT_TRUE(reader.next(line));
    EXPECT_TRUE(reader.has_line_end());
    ASSERT_TRUE(reader.next(line));
    EXPECT_FALSE(reader.has_line_end());
    EXPECT_FALSE(reader.next(line));
}

TEST(LineReader, ALineAtTheLimitIsReadAndOneOverItRefused) {
    const std::string longest(LineReader::longest_line, 'x');
    EXPECT_EQ(lines_of("a\n" + longest + "\nb"), (std::vector<std::string>{"a", longest, "b"}));
    try {
        lines_of("a\n" + longest + "x\n");
        ADD_FAILURE() << "read";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()), "t:2: found a line over 1 MiB, expected a row of a trace");
    }
}

TEST(LineReader, BytesAreCountedAsLinesToo) {
    std::istringstream in("ab\nc");
    LineReader reader(in, "t");
    std::string text;
    for (int byte; (byte = reader.next_byte()) >= 0;) {
        text += static_cast<char>(byte);
        EXPECT_EQ(reader.number(), byte == 'c' ? 2 : 1) << "a line feed is the last of its line";
        reader.peek_byte();  // takes nothing
    }
    EXPECT_EQ(text, "ab\nc");
    EXPECT_EQ(reader.number(), 2);
}

}  // namespace
}  // namespace sfsm
