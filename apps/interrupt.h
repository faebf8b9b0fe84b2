// Runs that end early: SIGINT, SIGTERM, SIGHUP. Half-written files go, whatever ends the program.
#pragma once

#include <stdexcept>
#include <string>

namespace apps {

// From now on a signal that ends the program (and exit(), which X11 calls when its server is gone) first removes the
// files that RemovedAtDeath names. Signals that were ignored before, as under nohup, or handled, stay so.
void watch_signals();

// From now on the first SIGINT, SIGTERM or SIGHUP only makes interrupted() true: the run is to end in good order. The
// next one ends the program.
void finish_on_signal();
bool interrupted();

// What run_program reports as "interrupted".
struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
};

// Between steps of a run that has nothing to keep yet. Throws Interrupted.
void throw_if_interrupted();

// A path that is removed if a signal ends the program while this lives. Signal handlers can't allocate: up to 32 at a
// time are kept, each shorter than PATH_MAX; more than that are not removed.
class RemovedAtDeath {
public:
    explicit RemovedAtDeath(const std::string& path);
    ~RemovedAtDeath();
    RemovedAtDeath(const RemovedAtDeath&) = delete;
    RemovedAtDeath& operator=(const RemovedAtDeath&) = delete;

private:
    int slot_ = -1;
};

}  // namespace apps
