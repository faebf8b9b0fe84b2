// Runs programs as a user would, and keeps what they said.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
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

// The longest that a test waits for another process [s]: far more than any needs, less than ctest gives.
inline constexpr int wait_limit = 120;

// Signals as a shell sets them for a program. Tests may be called with some ignored (as by nohup) or blocked, which
// a child of theirs would inherit.
inline void default_signals() {
    for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGALRM, SIGTERM, SIGCHLD}) std::signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
}

// As fork. The child ends in time, whatever program it becomes: no wait for it is for ever.
inline pid_t fork_child() {
    std::signal(SIGCHLD, SIG_DFL);  // ignored, it would hide how children end
    const pid_t pid = fork();
    if (pid != 0) return pid;
    default_signals();
    alarm(wait_limit);
    return 0;
}

// How a child of fork_child ended, as Outcome::code; -1: it is none.
inline int wait_for(pid_t pid) {
    int status = 0;
    pid_t ended = -1;
    do ended = waitpid(pid, &status, 0);
    while (ended < 0 && errno == EINTR);
    return ended == pid ? code_of(status) : -1;
}

// One byte; nothing at the end or where none comes in time.
inline std::optional<char> read_byte(int descriptor) {
    pollfd source{descriptor, POLLIN, 0};
    int ready = -1;
    do ready = poll(&source, 1, 1000 * wait_limit);  // a handled signal interrupts it, whatever SA_RESTART says
    while (ready < 0 && errno == EINTR);
    char byte = 0;
    if (ready > 0 && read(descriptor, &byte, 1) == 1) return byte;
    return std::nullopt;
}

// A program that runs beside the test; ended with it, or when the limit is over.
class Process {
public:
    // `command[0]` is looked for in PATH. stdout and stderr are thrown away, except what goes to `kept`.
    explicit Process(std::vector<std::string> command, int kept = -1) : pid_(fork_child()) {
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
    int wait() { return wait_for(std::exchange(pid_, -1)); }

    // Whether `done` came true before the program ended.
    bool until(const std::function<bool()>& done) const {
        constexpr int pause = 2;  // [ms]
        while (!done()) {
            siginfo_t end{};
            if (waitid(P_PID, static_cast<id_t>(pid_), &end, WEXITED | WNOHANG | WNOWAIT) != 0 || end.si_pid == pid_) {
                return done();
            }
            poll(nullptr, 0, pause);
        }
        return true;
    }

private:
    pid_t pid_;
};

// The form every error has: one line that starts with the program's name.
inline bool one_line(const std::string& text) {
    return !text.empty() && text.find('\n') == text.size() - 1;
}

}  // namespace tests
