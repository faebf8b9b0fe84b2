// docs/precision.md says what is so.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/precision/table.h"

namespace {

using namespace precision;

// Measured again on another processor or by another library, a number may be off in its last digit.
constexpr double margin = 1.1, slack_px = 1e-9;
constexpr double most_px = 0.05;  // of any step at 10,000 km, 30 days into a run

// The cells of the document's tables.
std::vector<std::vector<std::string>> documented() {
    std::ifstream document(GRANDSTAND_SOURCE "/docs/precision.md");
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(document, line);) {
        if (!line.starts_with("| ")) continue;
        std::vector<std::string> cells;
        std::istringstream rest(line.substr(1));
        for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(cell.substr(1, cell.size() - 2));
        rows.push_back(cells);
    }
    return rows;
}

// The row that begins so; empty if there is none.
std::vector<std::string> row_that_begins(const std::vector<std::string>& with) {
    for (const std::vector<std::string>& row : documented())
        if (row.size() > with.size() && std::equal(with.begin(), with.end(), row.begin())) return row;
    return {};
}

double first_number(const std::string& text) {
    return std::strtod(text.c_str(), nullptr);
}

double number_in_brackets(const std::string& text) {
    return first_number(text.substr(text.find('(') + 1));
}

TEST(Precision, EachLineOfTheTableHolds) {
    for (const Line& line : measure_lines()) {
        const std::vector<std::string> row = row_that_begins({line.step, line.lens});
        ASSERT_EQ(row.size(), 2 + origins.size()) << "docs/precision.md lacks\n" << row_of(line);
        for (std::size_t i = 0; i < origins.size(); ++i) {
            EXPECT_LE(line.at[i].worst, margin * first_number(row[2 + i]) + slack_px) << row_of(line);
            EXPECT_LE(line.at[i].mean(), margin * number_in_brackets(row[2 + i]) + slack_px) << row_of(line);
            EXPECT_GE(line.at[i].worst, first_number(row[2 + i]) / 2) << "it is better than said\n" << row_of(line);
            EXPECT_GT(line.at[i].count, 0) << row_of(line);
        }
        EXPECT_LE(line.at.back().worst, most_px) << row_of(line);
    }
}

TEST(Precision, TheLawsArithmeticHolds) {
    for (const LawLine& line : measure_law()) {
        const std::vector<std::string> row = row_that_begins({line.loop});
        ASSERT_EQ(row.size(), 2u) << "docs/precision.md lacks\n" << row_of(line);
        EXPECT_LE(line.off, margin * first_number(row[1]) + slack_px) << row_of(line);
        EXPECT_LE(line.off, most_px) << row_of(line);
    }
}

TEST(Precision, NothingBreaksEarlierThanSaid) {
    for (const Limit& limit : measure_limits()) {
        const std::vector<std::string> row = row_that_begins({limit.what});
        ASSERT_EQ(row.size(), 3u) << "docs/precision.md lacks\n" << row_of(limit);
        EXPECT_NEAR(limit.at, first_number(row[1]), 0.1 * limit.at) << row_of(limit);
    }
}

}  // namespace
