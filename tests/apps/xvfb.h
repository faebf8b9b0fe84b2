// An X server without a screen, for the tests that want a window.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/command.h"

namespace tests {

// Ended with the object.
class Xvfb {
public:
    Xvfb() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) return;
        // Left to choose, servers that start at once take each other's sockets away: the number is of this process
        // alone. When the last client leaves, a server starts anew and for a moment takes none: not this one.
        const std::string display = ":" + std::to_string(1000 + getpid() % 30000);
        server_ =
            std::make_unique<Process>(std::vector<std::string>{"Xvfb", display, "-noreset", "-displayfd",
                                                               std::to_string(ends[1]), "-screen", "0", "640x480x24"},
                                      ends[1]);
        close(ends[1]);
        char byte = 0;  // the display's number and a line's end, once it takes clients; nothing if there is no Xvfb
        while (read(ends[0], &byte, 1) == 1 && byte != '\n') number_ += byte;
        close(ends[0]);
    }

    // Empty: there is none.
    std::string display() const { return number_.empty() ? "" : ":" + number_; }

private:
    std::unique_ptr<Process> server_;
    std::string number_;
};

}  // namespace tests
