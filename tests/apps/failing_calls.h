// System calls that fail as a test asks: disks that fill up at the last byte and signals that come in the middle of a
// write can't be ordered otherwise. The linker leads calls of write, close and rename here (--wrap).
#pragma once

#include <cerrno>
#include <cstddef>
#include <vector>

namespace tests {

// What happens to the calls made while this lives; one at a time.
class FailingCalls {
public:
    FailingCalls();
    ~FailingCalls();
    FailingCalls(const FailingCalls&) = delete;
    FailingCalls& operator=(const FailingCalls&) = delete;

    std::vector<int> write_errors;  // of the next writes, an errno each; 0: the write succeeds
    std::size_t longest_write = 0;  // [bytes] that one write takes; 0: all
    int close_error = 0;            // of every close, which closes all the same, as Linux does
    int rename_error = 0;           // of every rename, which then does nothing

    std::vector<int> written, closed;  // descriptors of the calls so far
};

}  // namespace tests
