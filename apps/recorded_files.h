// Which files a command line that names recordings and folders of them means.
#pragma once

#include <string>
#include <vector>

namespace apps {

struct RecordedFile {
    std::string path;
    bool is_of_folder = false;  // nobody named it: if it is no recording it is passed over
};

// In the order given; of a folder the files in it, sorted by name, not those in its folders. Throws std::runtime_error
// for a folder that can't be read or has no files.
std::vector<RecordedFile> recorded_files(const std::vector<std::string>& paths);

// The files' names, with the folders that tell those apart that are alike. A file that is named twice has a number.
std::vector<std::string> short_names(const std::vector<std::string>& paths);

}  // namespace apps
