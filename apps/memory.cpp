#include "apps/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace apps {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t everything = std::numeric_limits<std::uint64_t>::max();

// A file's only number; none where there is no file, or a word such as "max" in it.
std::optional<std::uint64_t> number_in(const fs::path& file) {
    std::ifstream in(file);
    std::uint64_t number = 0;
    if (in >> number) return number;
    return std::nullopt;
}

// The number after `name` in a file of lines that begin with names.
std::optional<std::uint64_t> number_of(const fs::path& file, const std::string& name) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        std::uint64_t number = 0;
        if (words >> word >> number && word == name) return number;
    }
    return std::nullopt;
}

struct GroupFiles {
    const char *limit, *usage, *reclaimable;  // the last of memory.stat: files kept, and let go when room is needed
};
constexpr GroupFiles first_version{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles second_version{"memory.max", "memory.current", "inactive_file"};

// What a group and those that it is in leave. In a container its path may be the host's: then what is mounted counts.
std::uint64_t left_in_group(const fs::path& mount, fs::path group, const GroupFiles& files) {
    std::uint64_t left = everything;
    for (;; group = group.parent_path()) {
        const fs::path folder = mount / group.relative_path();
        const auto limit = number_in(folder / files.limit), used = number_in(folder / files.usage);
        if (limit && used) {
            const std::uint64_t kept = number_of(folder / "memory.stat", files.reclaimable).value_or(0);
            const std::uint64_t held = *used - std::min(*used, kept);
            left = std::min(left, *limit - std::min(*limit, held));
        }
        if (group == group.parent_path()) return left;
    }
}

// A line of proc/self/cgroup is number:controllers:path; the second version's has no controllers.
std::uint64_t left_in_groups(const fs::path& root) {
    const fs::path groups = root / "sys/fs/cgroup";
    std::uint64_t left = everything;
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == line.npos || second == line.npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const fs::path path = line.substr(second + 1);
        if (controllers == ",,") left = std::min(left, left_in_group(groups, path, second_version));
        if (controllers.find(",memory,") != controllers.npos)
            left = std::min(left, left_in_group(groups / "memory", path, first_version));
    }
    return left;
}

std::uint64_t left_to_process(const fs::path& root) {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return everything;
    const std::uint64_t pages = number_in(root / "proc/self/statm").value_or(0);
    const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, used);
}

}  // namespace

Memory available_memory(const fs::path& root) {
    constexpr std::uint64_t kibibyte = 1024;
    const auto available = number_of(root / "proc/meminfo", "MemAvailable:");
    Memory least{available ? *available * kibibyte : everything, "on this machine"};
    for (const Memory& other :
         {Memory{left_in_groups(root), "in its control group"}, Memory{left_to_process(root), "by ulimit -v"}})
        if (other.bytes < least.bytes) least = other;
    return least;
}

std::uint64_t most_memory(std::int64_t people, int width, int height) {
    constexpr std::uint64_t always = 200'000'000, person = 560, pixel = 24;  // [bytes]
    const std::uint64_t pixels =
        std::uint64_t{1} * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    return always + person * static_cast<std::uint64_t>(people) + pixel * pixels;
}

void require_memory(std::int64_t people, int width, int height, const Memory& available) {
    const std::uint64_t most = most_memory(people, width, height);
    if (most <= available.bytes) return;
    throw std::runtime_error("memory: found " + bytes_text(available.bytes) + " left " + available.of + ", expected " +
                             bytes_text(most) + ", which " + std::to_string(people) + " people at " +
                             std::to_string(width) + "x" + std::to_string(height) + " may take");
}

std::string bytes_text(std::uint64_t bytes) {
    constexpr double megabyte = 1e6, gigabyte = 1e9;
    const auto count = static_cast<double>(bytes);
    char text[40];
    if (count < gigabyte)
        std::snprintf(text, sizeof text, "%.0f MB", count / megabyte);
    else
        std::snprintf(text, sizeof text, "%.1f GB", count / gigabyte);
    return text;
}

std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts kibibytes
}

}  // namespace apps
