#include "render/native/depth_order.h"

#include <algorithm>
#include <cstddef>

namespace render::native {

// A counting sort. Two passes tell a sixteenth of a metre up to a kilometre; the lowest bits take a third, which only
// pays where somebody is farther.
void DepthOrder::sort(std::span<const Person* const> people) {
    constexpr int digit_bits = 11;
    constexpr std::uint32_t digits = 1u << digit_bits;
    constexpr float near_enough = 1024.0f;  // [m]
    entries_.resize(people.size());
    other_.resize(people.size());
    for (std::size_t i = 0; i < people.size(); ++i)
        entries_[i] = {std::bit_cast<std::uint32_t>(people[i]->depth), static_cast<std::uint32_t>(i)};
    const bool has_far = std::ranges::any_of(people, [](const Person* person) { return person->depth > near_enough; });
    for (const int shift : {0, 31 - 2 * digit_bits, 31 - digit_bits}) {
        if (shift == 0 && !has_far) continue;
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
