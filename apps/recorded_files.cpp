#include "apps/recorded_files.h"

#include <algorithm>
#include <filesystem>
#include <set>
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
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const std::string& path : paths) {
        const std::string file = path == "-" ? "standard input" : fs::path(path).filename().string();
        std::string name = file;
        for (int number = 2; !taken.insert(name).second; ++number) name = file + " (" + std::to_string(number) + ")";
        names.push_back(std::move(name));
    }
    return names;
}

}  // namespace apps
