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

// The files' names without folders, which nobody needs to know; those that are alike are numbered from the second on.
std::vector<std::string> short_names(const std::vector<std::string>& paths);

}  // namespace apps
