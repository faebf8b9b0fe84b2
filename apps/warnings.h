// What files lost on their way in, said to whoever runs a program: a line a kind on stderr, or a refusal.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/warnings.h"

namespace apps {

// "FILE: TEXT", a line a kind, as --stats and --summary list them too.
std::vector<std::string> lines_of(const std::filesystem::path& file, const model::Warnings& warnings);

// Prints "PROGRAM: warning: LINE" each. strict: throws std::runtime_error with the first instead.
void say(const std::string& program, std::span<const std::string> lines, bool strict);

}  // namespace apps
