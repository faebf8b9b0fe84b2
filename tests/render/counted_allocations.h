// How often a test's program has asked for memory.
#pragma once

#include <cstddef>

namespace tests {

std::size_t allocations();

}  // namespace tests
