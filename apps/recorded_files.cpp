#include "apps/recorded_files.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace apps {
namespace {

namespace fs = std::filesystem;

void append_folder(std::vector<RecordedFile>& files, const std::string& folder) {
    std::error_code error;
    std::vector<std::string> found;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code unknown;
        const bool is_hidden = entry->path().filename().string().starts_with('.');
        if (!is_hidden && entry->is_regular_file(unknown)) found.push_back(entry->path().string());
    }
    if (error) throw std::runtime_error("cannot read " + folder + ": " + error.message());
    if (found.empty()) throw std::runtime_error(folder + ": found no file in the folder, expected recordings");
    std::sort(found.begin(), found.end());
    for (std::string& path : found) files.push_back({std::move(path), true});
}

// The last `parts` of a path.
std::string end_of(const fs::path& path, std::ptrdiff_t parts) {
    const std::vector<fs::path> all(path.begin(), path.end());
    fs::path end;
    for (auto part = all.end() - std::min(parts, std::ssize(all)); part != all.end(); ++part) {
        if (*part != "/") end /= *part;
    }
    return end.string();
}

}  // namespace

std::vector<RecordedFile> recorded_files(const std::vector<std::string>& paths) {
    std::vector<RecordedFile> files;
    for (const std::string& path : paths) {
        std::error_code unknown;
        if (path != "-" && fs::is_directory(path, unknown)) {
            append_folder(files, path);
        } else {
            files.push_back({path, false});
        }
    }
    return files;
}

std::vector<std::string> short_names(const std::vector<std::string>& paths) {
    constexpr std::ptrdiff_t most_parts = 4;
    std::vector<std::string> names;
    for (const std::string& path : paths) {
        const auto tells_apart = [&](std::ptrdiff_t parts) {
            return std::count_if(paths.begin(), paths.end(), [&](const std::string& other) {
                       return end_of(other, parts) == end_of(path, parts);
                   }) == 1;
        };
        std::ptrdiff_t parts = 1;
        while (parts < most_parts && !tells_apart(parts)) ++parts;
        std::string name = path == "-" ? "standard input" : end_of(path, tells_apart(parts) ? parts : 1);
        const auto before = std::count(paths.begin(), paths.begin() + std::ssize(names), path);
        if (before > 0) name += " (" + std::to_string(before + 1) + ")";
        names.push_back(std::move(name));
    }
    return names;
}

}  // namespace apps
