// Files that are whole or not there: written beside their place and renamed into it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>

namespace apps {

class RemovedAtDeath;

// Writes to a descriptor and keeps the reason of the first write that failed, which std::filebuf loses.
class DescriptorBuffer : public std::streambuf {
public:
    DescriptorBuffer() = default;
    ~DescriptorBuffer() override;  // closes; what was not flushed is dropped

    void open(int descriptor, bool owned);  // `owned`: close() closes it
    void close();
    int error() const { return error_; }  // an errno; 0: none

protected:
    int_type overflow(int_type c) override;
    int sync() override;

private:
    bool drain();

    std::array<char, 1 << 16> bytes_;
    int descriptor_ = -1;
    bool owned_ = false;
    int error_ = 0;
};

// A file being written. Opening it at the start of a run finds an unwritable place before the work is done.
// - "-" is standard output.
// - Links are followed, also one that leads to no file yet: the link stays and its end is written.
// - An older file must be writable; the new one takes its place and its mode, not its owner or other hard links.
// - What exists and is not a regular file (a device, a pipe) is written in place.
// Until commit() the bytes are in a file of a name of its own beside the target, TARGET.part*, which goes with the
// object, and with the program if a signal ends it (interrupt.h).
class OutputFile {
public:
    // Throws std::runtime_error: "cannot write PATH: REASON".
    explicit OutputFile(const std::string& path);
    ~OutputFile();  // without commit(): nothing of it is left, and an older file is as it was
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    std::ostream& stream() { return stream_; }

    // Puts the file in its place. Once, at the end; throws as the constructor does, also for a full disk.
    void commit();

private:
    void open_in_place();
    void open_temporary(std::optional<unsigned> old_mode);

    std::string path_;       // as the user named it
    std::string target_;     // links followed
    std::string temporary_;  // empty where the target is written directly
    std::unique_ptr<RemovedAtDeath> guard_;
    DescriptorBuffer buffer_;
    std::ostream stream_{&buffer_};
};

}  // namespace apps
