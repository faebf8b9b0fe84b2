#include "tests/apps/failing_calls.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace tests {
namespace {

FailingCalls* present = nullptr;

}  // namespace

FailingCalls::FailingCalls() {
    if (present) std::abort();
    present = this;
}

FailingCalls::~FailingCalls() {
    present = nullptr;
}

}  // namespace tests

using tests::present;

// The names that --wrap gives.
extern "C" {

ssize_t __real_write(int descriptor, const void* bytes, std::size_t size);
int __real_close(int descriptor);
int __real_rename(const char* from, const char* to);

ssize_t __wrap_write(int descriptor, const void* bytes, std::size_t size) {
    if (!present) return __real_write(descriptor, bytes, size);
    present->written.push_back(descriptor);
    int error = 0;
    if (!present->write_errors.empty()) {
        error = present->write_errors.front();
        present->write_errors.erase(present->write_errors.begin());
    }
    if (error != 0) {
        errno = error;
        return -1;
    }
    return __real_write(descriptor, bytes, present->longest_write > 0 ? std::min(size, present->longest_write) : size);
}

int __wrap_close(int descriptor) {
    const int result = __real_close(descriptor);
    if (!present) return result;
    present->closed.push_back(descriptor);
    if (present->close_error == 0) return result;
    errno = present->close_error;
    return -1;
}

int __wrap_rename(const char* from, const char* to) {
    if (!present || present->rename_error == 0) return __real_rename(from, to);
    errno = present->rename_error;
    return -1;
}

}  // extern "C"
