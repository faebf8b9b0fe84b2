#include "tests/bench/front/csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace {

using bench::front::columns;
using bench::front::from_csv;
using bench::front::Front;
using bench::front::Row;
using bench::front::to_csv;

Row some_row() {
    Row row;
    row.people = 20'000;
    row.view = "close";
    row.is_preset = true;
    row.family = "native mixture";
    row.setting = "D = 0.25 L, S = 2, \"fine\"";
    row.law = "paper";
    row.target_ms = 16.6;
    row.density = 1.2;
    row.samples = 4;
    row.decision = {sfsm::State::points, 12.5, 1.4, 0.00123};
    for (std::size_t i = 0; i < sfsm::work_kinds; ++i) row.work.counts[i] = 1000 + static_cast<std::int64_t>(i);
    row.frame = {0.01234, 31.5, 0.98765, -0.001, 0.002, -0.003, 0.004};
    row.crowd = {0.05, std::numeric_limits<double>::infinity(), 0.9, 0.1, 0.2, 0.3, 0.4};
    row.crowd_share = 0.25;
    row.change = 1.5;
    row.motion_px = 0.125;
    row.motion_worst_px = 7;
    row.outline_px = 0.7;
    row.outline_worst_px = 2;
    row.covering_px = 3.25;
    row.expected_flip = 0.0125;
    row.max_motion_px = 0.75;
    row.max_splat_px = 1.75;
    row.wall_ms = 4.125;
    row.wall_low_ms = 4;
    row.wall_high_ms = 5;
    row.process_ms = 8.5;
    return row;
}

const Front some_front{{"a processor, of a kind", 2, "a driver", "2026-11-26"}, {some_row(), Row{}}};

std::string text() {
    return to_csv(some_front);
}

std::string replaced(const std::string& what, const std::string& by) {
    std::string out = text();
    const std::size_t at = out.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return out.replace(at, what.size(), by);
}

std::string refusal(const std::string& of) {
    try {
        from_csv(of, "a.csv");
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "none";
}

TEST(FrontCsv, ReadsBackWhatItWrote) {
    const Front read = from_csv(text(), "a.csv");
    EXPECT_EQ(read.machine.processor, some_front.machine.processor);
    EXPECT_EQ(read.machine.threads, 2);
    EXPECT_EQ(read.machine.opengl, "a driver");
    ASSERT_EQ(read.rows.size(), 2u);
    EXPECT_EQ(read.rows[0].setting, some_row().setting);
    EXPECT_EQ(read.rows[0].decision, some_row().decision);
    EXPECT_EQ(read.rows[0].work, some_row().work);
    EXPECT_EQ(read.rows[0].crowd.blue, 0.4);
    EXPECT_EQ(to_csv(read), text());
}

// A column that reads into another's field, or none, would change here.
TEST(FrontCsv, EveryColumnHasAFieldOfItsOwn) {
    const Row original = some_row();
    for (const auto& column : columns()) {
        Row row;
        ASSERT_TRUE(column.read(row, column.index, column.text_of(original))) << column.name;
        EXPECT_EQ(column.text_of(row), column.text_of(original)) << column.name;
        for (const auto& other : columns()) {
            if (&other == &column) continue;
            EXPECT_EQ(other.text_of(row), other.text_of(Row{})) << column.name << other.name;
        }
    }
}

// As it was before some columns were there: those of these names cut out of every line.
std::string without(const std::vector<std::string>& names, const Row& row) {
    std::string header, line;
    for (const auto& column : columns()) {
        if (std::ranges::find(names, column.name) != names.end()) continue;
        header += (header.empty() ? "" : ",") + column.name;
        line += (line.empty() ? "" : ",") + column.text_of(row);
    }
    return bench::front::machine_lines({}) + header + '\n' + line + '\n';
}

TEST(FrontCsv, OlderFilesLackTheirYoungerColumnsAndNoOthers) {
    Row row = some_row();
    row.setting = "S = 2";
    const Front read = from_csv(without({"rate", "expected_flip", "max_motion_px", "max_splat_px"}, row), "a.csv");
    row.decision.rate = row.expected_flip = row.max_motion_px = row.max_splat_px = 0;
    EXPECT_EQ(to_csv(read), to_csv({{}, {row}}));
    EXPECT_EQ(from_csv(without({"max_splat_px"}, row), "a.csv").rows.size(), 1u);
    for (const char* name : {"people", "flip", "process_ms"})
        EXPECT_TRUE(refusal(without({name}, row)).starts_with("a.csv:5: found other columns, expected")) << name;
}

TEST(FrontCsv, TheFrontThatWasKeptIsRead) {
    std::ifstream file(GRANDSTAND_KEPT_FRONT);
    std::stringstream kept;
    kept << file.rdbuf();
    EXPECT_EQ(from_csv(kept.str(), GRANDSTAND_KEPT_FRONT).rows.size(), 1280u);
}

TEST(FrontCsv, NothingIsNegativeNothing) {
    Row row;
    row.frame.brightness = -1e-9;
    EXPECT_EQ(to_csv({{}, {row}}), to_csv({{}, {Row{}}}));
}

TEST(FrontCsv, RefusesWhatItDidNotWriteInOneLine) {
    EXPECT_EQ(refusal(""), "a.csv:1: found the end of the file, expected '# processor: ...'");
    EXPECT_EQ(refusal(replaced("# threads: 2", "# strings: 2")),
              "a.csv:2: found '# strings: 2', expected '# threads: ...'");
    EXPECT_EQ(refusal(replaced("# threads: 2", "# threads: two")),
              "a.csv:2: threads: found 'two', expected a whole number");
    EXPECT_TRUE(refusal(replaced("people,view", "people,sight")).starts_with("a.csv:5: found other columns, expected"));
    EXPECT_EQ(refusal(replaced("20000,close", "many,close")),
              "a.csv:6: people: found 'many', expected a whole number from 0");
    EXPECT_EQ(refusal(replaced("20000,close,1", "20000,close,yes")),
              "a.csv:6: is_preset: found 'yes', expected 0 or 1");
    EXPECT_EQ(refusal(replaced("0.01234", "nan")), "a.csv:6: flip: found 'nan', expected a number");
    EXPECT_EQ(refusal(replaced("0.00123,", "-1,")), "a.csv:6: rate: found '-1', expected a number from 0");
    EXPECT_EQ(refusal(replaced(",1003,", ",-3,")),
              "a.csv:6: motion_updates: found '-3', expected a whole number from 0");
    EXPECT_EQ(refusal(replaced("4,2,12.500", "4,3,12.500")), "a.csv:6: state: found '3', expected 0, 1 or 2");
    const std::string columns_text = std::to_string(columns().size());
    EXPECT_EQ(refusal(replaced("20000,close", "20000")),
              "a.csv:6: found " + std::to_string(columns().size() - 1) + " values, expected " + columns_text);
    EXPECT_EQ(refusal(replaced("\"\"fine\"\"\"", "\"\"fine\"\"")),
              "a.csv:6: found a quote that isn't closed, expected one before the line's end");
    std::string cut = text();
    cut.pop_back();
    EXPECT_EQ(refusal(cut), "a.csv:7: found a line without its end, expected a row");
}

}  // namespace
