// What memory a run may take, and what the machine has: a run that can't end is refused before it begins.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace apps {

// What can still be had, and what bounds it.
struct Memory {
    std::uint64_t bytes = 0;
    std::string of;  // for people, after "left": "on this machine"
};

// The least of: what Linux says is available, what the limits of the control groups (both versions) that this process
// is in leave, and what `ulimit -v` leaves. Without a limit and on systems that don't say: everything. `root` is where
// proc/ and sys/ are.
Memory available_memory(const std::filesystem::path& root = "/");

// [bytes] The most that a run takes, all people in view; measured, and rounded up.
std::uint64_t most_memory(std::int64_t people, int width, int height);

// Throws std::runtime_error where that is more than there is.
void require_memory(std::int64_t people, int width, int height, const Memory& available);

// As people read it: "5.2 GB".
std::string bytes_text(std::uint64_t bytes);

// [bytes] The most that this process has held until now.
std::uint64_t peak_memory();

}  // namespace apps
