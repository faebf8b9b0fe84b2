// Bytes that come in blocks and are handed out as lines or as runs: memory is a block and the longest line or run.
// Where they come from is the owner's business: who finds too little here reads into room().
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace sfsm {

class BlockBuffer {
public:
    static constexpr std::size_t block = std::size_t{64} << 10;  // [bytes] stays in the second-level cache

    // What is read and not yet handed out. This and all that is handed out is valid until the next room().
    std::size_t size() const { return end_ - begin_; }
    std::string_view rest() const { return {bytes_.get() + begin_, size()}; }

    // The next `count` bytes, at most size().
    const char* take(std::size_t count) {
        begin_ += count;
        searched_ = 0;
        return bytes_.get() + begin_ - count;
    }

    // The next line, without its line end (LF or CR LF). False: no line ends within what is read.
    bool take_line(std::string_view& line) {
        const char* from = bytes_.get() + begin_ + searched_;
        const void* newline = size() > searched_ ? std::memchr(from, '\n', size() - searched_) : nullptr;
        if (!newline) {
            searched_ = size();
            return false;
        }
        const auto length = static_cast<std::size_t>(static_cast<const char*>(newline) - bytes_.get()) - begin_;
        line = without_return({take(length + 1), length});
        return true;
    }

    // At the end of the file: what is left, a line without a line end. False: nothing is.
    bool take_last_line(std::string_view& line) {
        if (size() == 0) return false;
        const std::size_t length = size();
        line = without_return({take(length), length});
        return true;
    }

    // Where the next bytes are to be read to: never empty. added() says how many came.
    std::span<char> room() {
        if (begin_ > 0) std::memmove(bytes_.get(), bytes_.get() + begin_, size());
        end_ -= std::exchange(begin_, 0);
        if (end_ == capacity_) {
            auto larger = std::make_unique_for_overwrite<char[]>(2 * capacity_);
            std::memcpy(larger.get(), bytes_.get(), end_);
            bytes_ = std::move(larger);
            capacity_ *= 2;
        }
        return {bytes_.get() + end_, capacity_ - end_};
    }
    void added(std::size_t count) { end_ += count; }

private:
    static std::string_view without_return(std::string_view line) {
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }

    std::size_t capacity_ = block;
    std::unique_ptr<char[]> bytes_ = std::make_unique_for_overwrite<char[]>(block);
    std::size_t begin_ = 0, end_ = 0;  // of what is read and not yet handed out
    std::size_t searched_ = 0;         // of that, known to have no line feed
};

}  // namespace sfsm
