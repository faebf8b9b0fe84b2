// Memory that vectors of any length can be read from.
#pragma once

#include <tbb/cache_aligned_allocator.h>

#include <vector>

namespace render::native {

template <typename T>
using Array = std::vector<T, tbb::cache_aligned_allocator<T>>;

}  // namespace render::native
