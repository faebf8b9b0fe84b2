// A headless browser and the few words of the WebDriver protocol (w3.org/TR/webdriver2) that tests speak with it, over
// plain HTTP on the loopback.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/command.h"

namespace tests {

using nlohmann::json;

// The first of the programs that PATH has; empty: none. Snaps don't count: they see no files in temporary folders.
inline std::string find_program(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        std::istringstream folders(std::getenv("PATH"));
        for (std::string folder; std::getline(folders, folder, ':');) {
            const std::string path = folder + "/" + name;
            if (folder != "/snap/bin" && access(path.c_str(), X_OK) == 0) return path;
        }
    }
    return "";
}

// A program that has children and grandchildren: all of them end with the object, and with the test however it ends.
// Between the two stands a keeper, which orphans of the family fall to, and which sees the test go by a pipe.
class Family {
public:
    // In `folder`, which is also where temporary files go. `said` [fd]: what it writes.
    Family(std::vector<std::string> command, const std::string& folder, int said) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0)
            throw std::runtime_error("found no pipe, expected one for the browser's keeper");
        keeper_ = fork();
        if (keeper_ == 0) {
            close(ends[1]);
            keep(std::move(command), folder, said, ends[0]);
        }
        close(ends[0]);
        lifeline_ = ends[1];
    }
    ~Family() {
        close(lifeline_);
        if (keeper_ > 0) waitpid(keeper_, nullptr, 0);
    }
    Family(const Family&) = delete;
    Family& operator=(const Family&) = delete;

private:
    [[noreturn]] static void keep(std::vector<std::string> command, const std::string& folder, int said, int lifeline) {
        prctl(PR_SET_CHILD_SUBREAPER, 1);
        const pid_t child = fork();
        if (child == 0) become(std::move(command), folder, said);
        close(said);
        char nothing;
        while (read(lifeline, &nothing, 1) < 0 && errno == EINTR) {
        }
        // Each that ends hands its children to the keeper; it is over when there are none.
        kill(child, SIGKILL);
        while (waitpid(-1, nullptr, 0) > 0 || errno == EINTR) kill_children();
        _exit(0);
    }

    static void kill_children() {
        std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
        for (pid_t child; children >> child;) kill(child, SIGKILL);
    }

    [[noreturn]] static void become(std::vector<std::string> command, const std::string& folder, int said) {
        default_signals();
        const int nowhere = open("/dev/null", O_RDWR);
        dup2(nowhere, STDIN_FILENO);
        dup2(said, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        for (const char* name : {"HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"}) {
            setenv(name, folder.c_str(), 1);
        }
        std::vector<char*> arguments;
        for (std::string& argument : command) arguments.push_back(argument.data());
        arguments.push_back(nullptr);
        execv(arguments[0], arguments.data());
        _exit(127);
    }

    pid_t keeper_ = -1;
    int lifeline_ = -1;
};

// Whether all of an answer is there: the driver leaves connections open.
inline bool is_whole(const std::string& answer) {
    const std::size_t head = answer.find("\r\n\r\n");
    const std::size_t length = answer.find("Content-Length:");
    if (head == answer.npos || length > head) return false;
    return answer.size() - (head + 4) >= std::stoul(answer.substr(length + 15));
}

// One request on a connection of its own. Throws std::runtime_error where there is no answer.
inline std::string http(int port, const std::string& method, const std::string& path, const std::string& body) {
    const int connection = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const timeval patience{60, 0};
    setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string answer;
    if (connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
        const std::string request = method + " " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                                    "Content-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) +
                                    "\r\n\r\n" + body;
        for (std::size_t sent = 0; sent < request.size();) {
            const ssize_t count = send(connection, request.data() + sent, request.size() - sent, MSG_NOSIGNAL);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) break;
            sent += static_cast<std::size_t>(count);
        }
        char piece[65536];
        while (!is_whole(answer)) {
            const ssize_t count = recv(connection, piece, sizeof piece, 0);
            if (count < 0 && errno == EINTR) continue;  // the test was stopped for a while
            if (count <= 0) break;
            answer.append(piece, static_cast<std::size_t>(count));
        }
    }
    close(connection);
    if (!is_whole(answer))
        throw std::runtime_error("found no answer to " + method + " " + path + ", expected one in 60 s");
    return answer.substr(answer.find("\r\n\r\n") + 4);
}

// A browser with one window. All of it throws std::runtime_error with what the driver said.
class Browser {
public:
    Browser(const std::string& driver, const std::string& browser) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("found no pipe, expected one from the driver");
        family_ = std::make_unique<Family>(std::vector<std::string>{driver, "--port=0"}, folder_ / "", ends[1]);
        close(ends[1]);
        port_ = read_port(ends[0]);
        said_ = ends[0];
        const json options = {{"binary", browser}, {"args", arguments()}};
        const json wanted = {
            {"browserName", "chrome"}, {"goog:chromeOptions", options}, {"goog:loggingPrefs", {{"browser", "ALL"}}}};
        session_ = "/session";
        session_ +=
            "/" + ask("POST", "", {{"capabilities", {{"alwaysMatch", wanted}}}})["sessionId"].get<std::string>();
    }
    ~Browser() {
        family_.reset();
        close(said_);
    }
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    void open(const std::string& url) const { ask("POST", "/url", {{"url", url}}); }

    // The value of a function's body, in the page.
    json value(const std::string& script) const {
        return ask("POST", "/execute/sync", {{"script", script}, {"args", json::array()}});
    }

    // Of one input device: "pointer" or "wheel" or "key".
    void act(const std::string& type, const json& actions, const std::string& pointer = "mouse") const {
        json source = {{"type", type}, {"id", type + pointer}, {"actions", actions}};
        if (type == "pointer") source["parameters"] = {{"pointerType", pointer}};
        act(json::array({source}));
    }
    void act(const json& sources) const { ask("POST", "/actions", {{"actions", sources}}); }

    // A command of the browser's developer tools.
    json command(const std::string& name, const json& parameters) const {
        return ask("POST", "/goog/cdp/execute", {{"cmd", name}, {"params", parameters}});
    }

    // What the console was told since the last call.
    json console() const { return ask("POST", "/se/log", {{"type", "browser"}}); }

private:
    json arguments() const {
        return {"--headless=new",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-quic",
                "--disable-dev-shm-usage",
                "--no-first-run",
                "--disable-background-networking",
                "--disable-component-update",
                "--disable-sync",
                "--window-size=1280,1000",
                "--user-data-dir=" + (folder_ / "profile")};
    }

    // "ChromeDriver was started successfully on port 12345."
    static int read_port(int said) {
        std::string text;
        for (auto byte = read_byte(said); byte; byte = read_byte(said)) {
            text += *byte;
            const std::size_t found = text.find("successfully on port ");
            if (byte == '\n' && found != text.npos) return std::atoi(text.c_str() + found + 21);
        }
        throw std::runtime_error("found '" + text + "' from chromedriver, expected its port");
    }

    json ask(const std::string& method, const std::string& path, const json& body) const {
        const json answer = json::parse(http(port_, method, session_ + path, body.dump())).at("value");
        if (answer.is_object() && answer.contains("error")) {
            throw std::runtime_error(path + ": " + answer.value("message", answer.dump()));
        }
        return answer;
    }

    Directory folder_;  // outlives the family
    std::unique_ptr<Family> family_;
    int port_ = 0, said_ = -1;
    std::string session_;
};

}  // namespace tests
