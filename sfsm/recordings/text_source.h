// A file's bytes as UTF-8 text: unpacked where gzip has packed them, and turned from UTF-16, as shells write it.
#pragma once

#include <istream>
#include <memory>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace sfsm {

class TextSource {
public:
    // Reads from `in` in blocks of 64 KiB, as the text is read; `in` must outlive it. gzip is known by its magic
    // number, UTF-16 by its mark or by every second byte being 0. `name` is the file's in messages.
    TextSource(std::istream& in, const std::string& name);
    ~TextSource();

    // The text. Reading throws std::runtime_error where the file can't be read on, and where gzip's data is damaged,
    // cut short, or swells to more than 8 MiB and 100 times its size: no log does.
    std::istream& stream() { return stream_; }

    const std::vector<std::string>& notes() const { return notes_; }  // on what was guessed

    // A block of bytes that comes from another, or from the file.
    class Layer;

private:
    std::vector<std::unique_ptr<Layer>> layers_;
    std::istream stream_{nullptr};
    std::vector<std::string> notes_;
};

}  // namespace sfsm
