// Who is nearer than whom.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "render/frame.h"

namespace render::native {

// Numbers of people, the nearest first; who are equally far, within a kilometre to a sixteenth of a metre, stay in
// their order. Reused.
class DepthOrder {
public:
    void sort(std::span<const Person* const> people);
    std::span<const std::uint32_t> numbers() const { return numbers_; }

private:
    struct Entry {
        std::uint32_t depth;  // bits of a positive float, which rise with it
        std::uint32_t number;
    };
    std::vector<Entry> entries_, other_;
    std::vector<std::uint32_t> counts_, numbers_;
};

}  // namespace render::native
