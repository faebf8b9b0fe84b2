#include "apps/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "apps/interrupt.h"
#include "apps/places.h"

namespace apps {
namespace {

constexpr std::string_view standard_output = "-";
constexpr mode_t mode_bits = 07777, default_mode = 0666;  // the user's mask takes its part of the latter

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot write " + (path == standard_output ? "standard output" : path) + ": " + reason);
}

// A name that no other file of this program, and no other program that is running, uses.
std::string temporary_name(const std::string& target) {
    static std::atomic<int> count = 0;
    return target + ".part" + std::to_string(::getpid()) + "-" + std::to_string(count++);
}

}  // namespace

DescriptorBuffer::~DescriptorBuffer() {
    if (owned_) ::close(descriptor_);
}

void DescriptorBuffer::open(int descriptor, bool owned) {
    descriptor_ = descriptor;
    owned_ = owned;
    setp(bytes_.data(), bytes_.data() + bytes_.size());
}

void DescriptorBuffer::close() {
    drain();
    // Some file systems notice only now that the disk is full.
    if (owned_ && ::close(descriptor_) != 0 && error_ == 0) error_ = errno;
    owned_ = false;
}

bool DescriptorBuffer::drain() {
    for (const char* next = pbase(); next < pptr() && error_ == 0;) {
        const ssize_t written = ::write(descriptor_, next, static_cast<std::size_t>(pptr() - next));
        if (written >= 0)
            next += written;
        else if (errno != EINTR)
            error_ = errno;
    }
    setp(bytes_.data(), bytes_.data() + bytes_.size());
    return error_ == 0;
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type c) {
    if (!drain()) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
}

int DescriptorBuffer::sync() {
    return drain() ? 0 : -1;
}

OutputFile::OutputFile(const std::string& path) : path_(path) {
    if (path_ == standard_output) {
        buffer_.open(STDOUT_FILENO, false);
        return;
    }
    if (path_.empty()) fail("''", "found no name, expected a file's");
    struct stat found {};
    const bool exists = ::stat(path_.c_str(), &found) == 0;
    if (!exists && errno != ENOENT) fail(path_, std::strerror(errno));
    if (exists && S_ISDIR(found.st_mode)) fail(path_, "found a directory, expected a file");
    // Renaming would replace a file that its owner has made read-only.
    if (exists && ::faccessat(AT_FDCWD, path_.c_str(), W_OK, AT_EACCESS) != 0) fail(path_, std::strerror(errno));
    if (exists && !S_ISREG(found.st_mode)) {
        open_in_place();
    } else {
        target_ = followed(path_).string();
        open_temporary(exists ? std::optional<unsigned>(found.st_mode & mode_bits) : std::nullopt);
    }
}

void OutputFile::open_in_place() {
    const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path_, std::strerror(errno));
    buffer_.open(descriptor, true);
}

void OutputFile::open_temporary(std::optional<unsigned> old_mode) {
    int descriptor = -1;
    while (descriptor < 0) {
        const std::string name = temporary_name(target_);
        guard_ = std::make_unique<RemovedAtDeath>(name);
        descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, old_mode.value_or(default_mode));
        // A program that was killed may have left one of the same name.
        if (descriptor < 0 && errno != EEXIST) fail(path_, std::strerror(errno));
        temporary_ = name;
    }
    buffer_.open(descriptor, true);
    // The mask may have taken bits of the old mode; where modes can't be changed there are none to keep.
    if (old_mode) static_cast<void>(::fchmod(descriptor, *old_mode));
}

OutputFile::~OutputFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::commit() {
    buffer_.close();
    if (buffer_.error() != 0) fail(path_, std::strerror(buffer_.error()));
    if (!stream_) fail(path_, "the write failed");
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, std::strerror(errno));
    temporary_.clear();
    guard_.reset();
}

}  // namespace apps
