// Runs programs as a user would, and keeps what they said.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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

    // The names in it, sorted.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    std::filesystem::path path_;
};

inline int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// `arguments` as a shell takes them; redirections in them win.
inline Outcome run(const std::string& program, const std::string& arguments) {
    const Directory scratch;
    const std::string command = std::string(GRANDSTAND_BIN) + "/" + program + " </dev/null >" + (scratch / "out") +
                                " 2>" + (scratch / "err") + " " + arguments;
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = code_of(status);
    outcome.out = read_file(scratch / "out");
    outcome.err = read_file(scratch / "err");
    return outcome;
}

// A program that runs beside the test; ended with it.
class Process {
public:
    // `command[0]` is looked for in PATH. stdout and stderr are thrown away, except what goes to `kept`.
    explicit Process(std::vector<std::string> command, int kept = -1) : pid_(fork()) {
        if (pid_ != 0) return;
        const int nowhere = open("/dev/null", O_RDWR);
        for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, descriptor);
        if (kept >= 0) fcntl(kept, F_SETFD, 0);
        std::vector<char*> arguments;
        for (std::string& argument : command) arguments.push_back(argument.data());
        arguments.push_back(nullptr);
        execvp(arguments[0], arguments.data());
        _exit(127);
    }
    ~Process() {
        if (pid_ <= 0) return;
        signal(SIGKILL);
        wait();
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void signal(int number) const { kill(pid_, number); }

    // As Outcome::code. Once.
    int wait() {
        int status = 0;
        waitpid(std::exchange(pid_, -1), &status, 0);
        return code_of(status);
    }

private:
    pid_t pid_;
};

// The form every error has: one line that starts with the program's name.
inline bool one_line(const std::string& text) {
    return !text.empty() && text.find('\n') == text.size() - 1;
}

}  // namespace tests
