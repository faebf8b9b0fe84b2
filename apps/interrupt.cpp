#include "apps/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>

namespace apps {

namespace {

enum class Use : int { unused, filling, armed };

// All a handler touches is here: static storage and lock-free atomics.
struct Slot {
    std::atomic<Use> use = Use::unused;
    char path[PATH_MAX];
};
static_assert(std::atomic<Use>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

Slot slots[32];
std::atomic<bool> finishing = false, pending = false;

constexpr int requests[] = {SIGINT, SIGTERM, SIGHUP};  // somebody asks the program to end
constexpr int failures[] = {SIGPIPE, SIGQUIT};         // it ends at once, but need not leave anything

void remove_files() {
    for (const Slot& slot : slots)
        if (slot.use == Use::armed) ::unlink(slot.path);
}

void die_of(int number) {
    remove_files();
    std::signal(number, SIG_DFL);
    std::raise(number);  // blocked until the handler returns
}

void end_or_finish(int number) {
    if (!finishing || pending.exchange(true)) die_of(number);
}

void handle(int number, void (*handler)(int)) {
    struct sigaction action {};
    if (::sigaction(number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
    action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;  // a run that goes on must not see its reads and writes fail
    ::sigaction(number, &action, nullptr);
}

}  // namespace

void watch_signals() {
    for (const int number : requests) handle(number, end_or_finish);
    for (const int number : failures) handle(number, die_of);
    std::atexit(remove_files);
}

void finish_on_signal() {
    finishing = true;
}

bool interrupted() {
    return pending;
}

void throw_if_interrupted() {
    if (interrupted()) throw Interrupted();
}

RemovedAtDeath::RemovedAtDeath(const std::string& path) {
    if (path.size() >= sizeof slots[0].path) return;
    for (Slot& slot : slots) {
        Use expected = Use::unused;
        if (!slot.use.compare_exchange_strong(expected, Use::filling)) continue;
        std::memcpy(slot.path, path.c_str(), path.size() + 1);
        slot.use = Use::armed;
        slot_ = static_cast<int>(&slot - slots);
        return;
    }
}

RemovedAtDeath::~RemovedAtDeath() {
    if (slot_ >= 0) slots[slot_].use = Use::unused;
}

}  // namespace apps
