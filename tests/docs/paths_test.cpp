// What the documents send a reader to is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path root = GRANDSTAND_SOURCE;

// Without what stands between lines of ```: commands and drawings.
std::string prose_of(const std::string& document) {
    std::ifstream file(root / document);
    EXPECT_TRUE(file) << document;
    std::string prose;
    bool fenced = false;
    for (std::string line; std::getline(file, line);) {
        const bool fence = line.starts_with("```");
        if (!fence && !fenced) prose += line + '\n';
        fenced ^= fence;
    }
    return prose;
}

std::vector<std::string> all_of(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
        found.push_back((*match)[1]);
    return found;
}

// What stands between backticks and has a slash, but for patterns and what a run leaves.
std::vector<std::string> paths_of(const std::string& text) {
    std::vector<std::string> paths = all_of(text, std::regex("`([A-Za-z0-9_./-]*/[A-Za-z0-9_./-]*)`"));
    std::erase_if(paths,
                  [](const std::string& path) { return path.starts_with("build/") || path.starts_with("out/"); });
    return paths;
}

// The part of `text` under the heading, up to the next; empty if there is none.
std::string section_of(const std::string& text, const std::string& heading) {
    const std::size_t start = text.find("\n## " + heading + "\n");
    if (start == std::string::npos) return "";
    const std::size_t end = text.find("\n## ", start + 1);
    return text.substr(start, end == std::string::npos ? end : end - start);
}

std::vector<std::string> rows_of(const std::string& text) {
    std::vector<std::string> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("| ")) rows.push_back(line);
    if (!rows.empty()) rows.erase(rows.begin());  // the table's heading
    return rows;
}

class Documents : public testing::TestWithParam<const char*> {};

TEST_P(Documents, NamePathsThatAreThere) {
    const std::vector<std::string> paths = paths_of(prose_of(GetParam()));
    EXPECT_FALSE(paths.empty());
    for (const std::string& path : paths) EXPECT_TRUE(fs::exists(root / path)) << path;
}

TEST_P(Documents, LinkToFilesThatAreThere) {
    for (const std::string& link : all_of(prose_of(GetParam()), std::regex("\\]\\(([^)#]+)[^)]*\\)"))) {
        if (link.find("://") != std::string::npos) continue;
        EXPECT_TRUE(fs::exists((root / GetParam()).parent_path() / link)) << link;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Documents, testing::Values("README.md", "docs/architecture.md", "docs/testing.md"),
                         [](const auto& document) { return fs::path(document.param).stem().string(); });

// Below it a reader must look for the place on their own.
constexpr std::size_t fewest_entries = 10;

TEST(Readme, SaysForEachChangeWhichFileToEdit) {
    const std::vector<std::string> entries = rows_of(section_of(prose_of("README.md"), "To change X, edit Y"));
    EXPECT_GE(entries.size(), fewest_entries);
    for (const std::string& entry : entries) EXPECT_FALSE(paths_of(entry).empty()) << entry;
}

class FolderTables : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(FolderTables, SayWhatEveryModuleHolds) {
    const auto [document, heading] = GetParam();
    const std::vector<std::string> rows = rows_of(section_of(prose_of(document), heading));
    const std::set<std::string> without_a_row{"tests"};  // architecture.md speaks of the program alone
    for (const auto& entry : fs::directory_iterator(root)) {
        if (!fs::exists(entry.path() / "CMakeLists.txt")) continue;
        const std::string name = entry.path().filename();
        const std::string folder = "`" + name + "/`";
        const bool is_told = std::any_of(rows.begin(), rows.end(), [&](const std::string& row) {
            return row.substr(0, row.find('|', 1)).find(folder) != std::string::npos;
        });
        EXPECT_TRUE(is_told || (without_a_row.contains(name) && document != std::string("README.md"))) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(All, FolderTables,
                         testing::Values(std::pair("README.md", "How it works"),
                                         std::pair("docs/architecture.md", "Folders")),
                         [](const auto& table) { return fs::path(table.param.first).stem().string(); });

}  // namespace
