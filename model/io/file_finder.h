// Files that another file names, such as textures, wherever they were when it was written. Internal to the loaders.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace model {

class FileFinder {
public:
    // Names are relative to `folder`; an empty one is the working directory.
    explicit FileFinder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // The regular file that `name` means, else an empty path. Blanks and quotes around it are no part of it. Tried as
    // it is written, then with backslashes as slashes, then as its last parts, ever fewer (maps/skin.png, skin.png of
    // C:\work\maps\skin.png), letters of either case.
    std::filesystem::path find(std::string_view name);

private:
    using Names = std::map<std::string, std::set<std::string>>;  // by their lower case

    std::filesystem::path find_in_any_case(std::string_view name);
    const Names& names_in(const std::filesystem::path& folder);

    std::filesystem::path folder_;
    std::map<std::filesystem::path, Names> listings_;
};

}  // namespace model
