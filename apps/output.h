// Files that are whole or not there: written beside their place and renamed into it.
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace apps {

// A file being written. Opening it at the start of a run finds an unwritable place before the work is done.
// "-" is standard output. What exists and is not a regular file (a device, a pipe) is written in place.
class OutputFile {
public:
    // Throws std::runtime_error: "cannot write PATH: REASON".
    explicit OutputFile(const std::string& path);
    ~OutputFile();  // without commit(): nothing of it is left, and an older file is as it was
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    std::ostream& stream();

    // Puts the file in its place. Once, at the end; throws as the constructor does, also for a full disk.
    void commit();

private:
    std::string path_;       // as the user named it
    std::string target_;     // links followed
    std::string temporary_;  // empty where the target is written directly
    std::ofstream file_;
};

}  // namespace apps
