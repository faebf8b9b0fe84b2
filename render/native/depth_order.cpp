#include "render/native/depth_order.h"

#include <cstddef>

namespace render::native {

// A counting sort in two passes.
void DepthOrder::sort(std::span<const Person* const> people) {
    constexpr int digit_bits = 11;
    constexpr std::uint32_t digits = 1u << digit_bits;
    entries_.resize(people.size());
    other_.resize(people.size());
    for (std::size_t i = 0; i < people.size(); ++i)
        entries_[i] = {std::bit_cast<std::uint32_t>(people[i]->depth), static_cast<std::uint32_t>(i)};
    for (const int shift : {31 - 2 * digit_bits, 31 - digit_bits}) {
        const auto digit = [&](const Entry& entry) { return entry.depth >> shift & (digits - 1); };
        counts_.assign(digits + 1, 0);
        for (const Entry& entry : entries_) ++counts_[digit(entry) + 1];
        for (std::uint32_t i = 0; i < digits; ++i) counts_[i + 1] += counts_[i];
        for (const Entry& entry : entries_) other_[counts_[digit(entry)]++] = entry;
        entries_.swap(other_);
    }
    numbers_.resize(people.size());
    for (std::size_t i = 0; i < people.size(); ++i) numbers_[i] = entries_[i].number;
}

}  // namespace render::native
