// Positions that several triangles share, known by numbers.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <vector>

namespace render::native {

// Gives every position one number, in the order of first use.
class Numbering {
public:
    std::uint32_t of(glm::vec3 position) {
        // By their bits, among which there is an order whatever they mean.
        const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(position);
        const auto [found, is_new] = numbers_.try_emplace(bits, static_cast<std::uint32_t>(positions_.size()));
        if (is_new) positions_.push_back(position);
        return found->second;
    }
    const std::vector<glm::vec3>& positions() const { return positions_; }

private:
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> numbers_;
    std::vector<glm::vec3> positions_;
};

}  // namespace render::native
