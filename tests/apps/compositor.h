// A Wayland compositor without a screen, for the tests that want a window.
#pragma once

#include <sys/socket.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/command.h"

namespace tests {

// Cage, which shows one client and ends with it. Here the client is a shell that ends with the object.
class Compositor {
public:
    Compositor() {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
        end_ = ends[0];
        const std::string client_end = std::to_string(ends[1]);
        server_ = std::make_unique<Process>(
            std::vector<std::string>{"env", "XDG_RUNTIME_DIR=" + runtime_directory(), "WLR_BACKENDS=headless",
                                     "WLR_RENDERER=pixman", "WLR_LIBINPUT_NO_DEVICES=1", "cage", "--", "sh", "-c",
                                     "echo $WAYLAND_DISPLAY >&" + client_end + "; exec cat <&" + client_end},
            ends[1]);
        close(ends[1]);
        char byte = 0;  // the display's name and a line's end, once it takes clients; nothing if there is no Cage
        while (read(end_, &byte, 1) == 1 && byte != '\n') display_ += byte;
    }
    ~Compositor() {
        if (end_ >= 0) close(end_);
        if (server_) server_->wait();
    }
    Compositor(const Compositor&) = delete;
    Compositor& operator=(const Compositor&) = delete;

    // Empty: there is none.
    std::string display() const { return display_; }
    // XDG_RUNTIME_DIR, where clients find it.
    std::string runtime_directory() const { return directory_ / ""; }

private:
    Directory directory_;
    int end_ = -1;
    std::unique_ptr<Process> server_;
    std::string display_;
};

}  // namespace tests
