// Reading files and making folders; what goes wrong is told in one line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace bench::front {

// Nothing: there is no such file. Throws std::runtime_error with one line for what can't be read.
std::optional<std::string> contents_of(const std::filesystem::path& path);

// With those that it lies in; one that is there stays. Throws std::runtime_error with one line.
void make_folder(const std::filesystem::path& path);

}  // namespace bench::front
