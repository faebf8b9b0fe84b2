// The faults that tests/faults/run puts in still fit the code: each text stands in its file just once.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Fault {
    std::string name, file, text, replacement, listed_at;
};

std::string read(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

void add_line(std::string& to, const std::string& line) {
    to += (to.empty() ? "" : "\n") + line;
}

std::vector<Fault> all_faults() {
    std::vector<Fault> faults;
    for (const auto& entry : std::filesystem::directory_iterator(GRANDSTAND_SOURCE "/tests/faults")) {
        if (entry.path().extension() != ".faults") continue;
        std::ifstream list(entry.path());
        int number = 0;
        for (std::string line; std::getline(list, line);) {
            ++number;
            const std::string at = entry.path().filename().string() + ":" + std::to_string(number);
            const std::string word = line.substr(0, line.find(' '));
            const std::string rest = line.size() > word.size() ? line.substr(word.size() + 1) : "";
            if (line.empty() || word == "#") continue;
            if (word == "fault") {
                faults.push_back({rest, "", "", "", at});
            } else if (faults.empty()) {
                ADD_FAILURE() << at << ": a line of no fault";
            } else if (word == "file") {
                faults.back().file = rest;
            } else if (word == "-") {
                add_line(faults.back().text, rest);
            } else if (word == "+") {
                add_line(faults.back().replacement, rest);
            } else {
                EXPECT_EQ(word, "argued") << at;
            }
        }
    }
    return faults;
}

TEST(Faults, FitTheCode) {
    for (const Fault& fault : all_faults()) {
        const std::string code = read(std::filesystem::path(GRANDSTAND_SOURCE) / fault.file);
        const std::size_t found = code.find(fault.text);
        EXPECT_FALSE(fault.text.empty()) << fault.listed_at;
        EXPECT_NE(fault.text, fault.replacement) << fault.listed_at;
        EXPECT_NE(found, std::string::npos) << fault.listed_at << ": " << fault.file << " no longer has the text";
        if (found == std::string::npos) continue;
        EXPECT_EQ(code.find(fault.text, found + 1), std::string::npos)
            << fault.listed_at << ": the text stands more than once in " << fault.file;
    }
}

TEST(Faults, AreManyAndHalfOfThemInWhatIsSeen) {
    std::set<std::string> names;
    long seen = 0;
    for (const Fault& fault : all_faults()) {
        EXPECT_TRUE(names.insert(fault.name).second) << fault.listed_at << ": two are called " << fault.name;
        const std::string folder = fault.file.substr(0, fault.file.find('/'));
        seen += folder == "render" || folder == "shaders" || folder == "scene";
    }
    EXPECT_GE(names.size(), 60u);
    EXPECT_GE(2 * seen, static_cast<long>(names.size()));
}

}  // namespace
