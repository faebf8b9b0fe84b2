// An X server without a screen, for the tests that want a window.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/command.h"

namespace tests {

// One record of an Xauthority file, for any display: a server with it takes clients with it alone.
inline std::string cookie(char secret) {
    const auto field = [](const std::string& text) {
        return std::string{static_cast<char>(text.size() >> 8), static_cast<char>(text.size())} + text;
    };
    const std::string any_family = "\xff\xff";
    return any_family + field("") + field("") + field("MIT-MAGIC-COOKIE-1") + field(std::string(16, secret));
}

// Ended with the object. One a process.
class Xvfb {
public:
    explicit Xvfb(const std::vector<std::string>& more = {}) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) return;
        // Left to choose, servers that start at once take each other's sockets away: the number is of this process
        // alone. When the last client leaves, a server starts anew and for a moment takes none: not this one.
        const std::string display = ":" + std::to_string(1000 + getpid() % 30000);
        std::vector<std::string> command{"Xvfb",    display, "-noreset",  "-displayfd", std::to_string(ends[1]),
                                         "-screen", "0",     "640x480x24"};
        command.insert(command.end(), more.begin(), more.end());
        server_ = std::make_unique<Process>(command, ends[1]);
        close(ends[1]);
        // The display's number and a line's end, once it takes clients; nothing if there is no Xvfb.
        for (auto byte = read_byte(ends[0]); byte && byte != '\n'; byte = read_byte(ends[0])) number_ += *byte;
        close(ends[0]);
    }

    // Empty: there is none.
    std::string display() const { return number_.empty() ? "" : ":" + number_; }

private:
    std::unique_ptr<Process> server_;
    std::string number_;
};

}  // namespace tests
