#include "model/io/file_finder.h"

#include <algorithm>
#include <system_error>

namespace model {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

std::string_view without_quotes(std::string_view name) {
    const auto around = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '"' || c == '\''; };
    while (!name.empty() && around(name.front())) name.remove_prefix(1);
    while (!name.empty() && around(name.back())) name.remove_suffix(1);
    return name;
}

}  // namespace

fs::path FileFinder::find(std::string_view name) {
    constexpr std::size_t longest_name = 4096;
    if (name.size() > longest_name || name.find('\0') != std::string_view::npos) return {};
    const fs::path as_written = folder_ / name;
    if (is_file(as_written)) return as_written;
    std::string slashed(without_quotes(name));
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    if (slashed.empty()) return {};
    if (const fs::path path = folder_ / slashed; is_file(path)) return path;
    std::string_view rest = slashed;
    while (true) {
        if (const fs::path path = find_in_any_case(rest); !path.empty()) return path;
        const std::size_t slash = rest.find('/');
        if (slash == std::string_view::npos) return {};
        rest.remove_prefix(slash + 1);
    }
}

// Part by part below the folder. Of names that differ in case alone the one in the same case is meant, else the first.
fs::path FileFinder::find_in_any_case(std::string_view name) {
    fs::path path = folder_;
    while (!name.empty()) {
        const std::size_t slash = std::min(name.find('/'), name.size());
        const std::string_view part = name.substr(0, slash);
        name.remove_prefix(std::min(slash + 1, name.size()));
        if (part.empty() || part == ".") continue;
        if (part == "..") return {};
        const Names& names = names_in(path);
        const auto alike = names.find(lower_case(part));
        if (alike == names.end()) return {};
        const auto same = alike->second.find(std::string(part));
        path /= same == alike->second.end() ? *alike->second.begin() : *same;
    }
    return is_file(path) ? path : fs::path();
}

const FileFinder::Names& FileFinder::names_in(const fs::path& folder) {
    const auto [at, added] = listings_.try_emplace(folder);
    if (!added) return at->second;
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        at->second[lower_case(name)].insert(name);
    }
    return at->second;
}

}  // namespace model
