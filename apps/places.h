// The files that a command line names: which of them are one.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace apps {

// "-" is standard output; an empty path is no place at all.
struct Place {
    std::string option;  // as the user knows it: "--out"
    std::string path;
};

// The file that writing to `path` would make or replace, from the root: links followed, those too that lead to nothing
// yet.
std::filesystem::path followed(const std::filesystem::path& path);

// Whether both reach one regular file, or would once it is made. Devices and pipes may be shared.
bool same_file(const std::string& a, const std::string& b);

// Throws std::invalid_argument, naming both options, if two outputs are one file, or both standard output, or an output
// would destroy an input.
void check_places(std::span<const Place> inputs, std::span<const Place> outputs);

}  // namespace apps
