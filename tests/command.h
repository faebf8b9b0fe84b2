// Runs one of our programs as a user would, and keeps what it said.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace tests {

struct Outcome {
    int code = -1;    // exit code; 128 + signal if it crashed
    std::string out;  // stdout
    std::string err;  // stderr
};

inline std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// A directory of the test's own, gone with it.
class Directory {
public:
    Directory() {
        std::string name = (std::filesystem::temp_directory_path() / "grandstand-XXXXXX").string();
        if (!mkdtemp(name.data())) std::abort();
        path_ = name;
    }
    ~Directory() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Directory(const Directory&) = delete;
    Directory& operator=(const Directory&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

// `arguments` as a shell takes them.
inline Outcome run(const std::string& program, const std::string& arguments) {
    const Directory scratch;
    const std::string command = std::string(GRANDSTAND_BIN) + "/" + program + " " + arguments + " </dev/null >" +
                                (scratch / "out") + " 2>" + (scratch / "err");
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = read_file(scratch / "out");
    outcome.err = read_file(scratch / "err");
    return outcome;
}

// The form every error has: one line that starts with the program's name.
inline bool one_line(const std::string& text) {
    return !text.empty() && text.find('\n') == text.size() - 1;
}

}  // namespace tests
