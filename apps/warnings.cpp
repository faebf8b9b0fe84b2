#include "apps/warnings.h"

#include <cstdio>
#include <stdexcept>

namespace apps {

std::vector<std::string> lines_of(const std::filesystem::path& file, const model::Warnings& warnings) {
    std::vector<std::string> lines;
    for (const model::Warning& warning : warnings)
        lines.push_back(file.filename().string() + ": " + model::text_of(warning));
    return lines;
}

void say(const std::string& program, std::span<const std::string> lines, bool strict) {
    if (strict && !lines.empty()) throw std::runtime_error(lines.front() + "; expected no loss, as --strict asks");
    for (const std::string& line : lines) std::fprintf(stderr, "%s: warning: %s\n", program.c_str(), line.c_str());
}

}  // namespace apps
