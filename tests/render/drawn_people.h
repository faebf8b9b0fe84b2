// Who is in a frame, and how each is drawn.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "render/frame.h"
#include "scene/crowd.h"

namespace tests {

// Who is drawn: numbers in the crowd, of a frame of original triangles at a tick. Nobody stands where another does.
inline std::vector<std::uint32_t> numbers_of(const render::Frame& exact, const scene::Crowd& crowd,
                                             std::span<const scene::CastMember> cast, std::int64_t tick) {
    std::vector<std::uint32_t> numbers;
    std::uint32_t number = 0;
    for (const render::Person& person : exact.people) {
        const auto stands_there = [&] {
            const glm::vec3 at = scene::place(crowd, number, cast[crowd.character[number]], tick).position;
            return exact.view.relative(at) == person.instance.position;
        };
        while (number < crowd.size() && !stands_there()) ++number;
        if (number == crowd.size()) throw std::logic_error("a frame draws somebody who isn't in the crowd");
        numbers.push_back(number++);
    }
    return numbers;
}

// Visits all who are visible in a frame: their place among `numbers`, their number, and how they are drawn by oneself,
// if they are.
template <typename Visit>
void for_each_drawn(const render::Frame& frame, const std::vector<std::uint32_t>& numbers, const scene::Crowd& crowd,
                    Visit visit) {
    std::vector<bool> is_far(crowd.blocks.size());
    for (const render::FarBlock& block : frame.far_blocks) is_far[block.block] = true;
    std::size_t block = 0, drawn = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        while (numbers[i] >= crowd.blocks[block].first + crowd.blocks[block].count) ++block;
        visit(i, numbers[i], is_far[block] ? nullptr : &frame.people.at(drawn++));
    }
    if (drawn != frame.people.size()) throw std::logic_error("a frame draws somebody who isn't visible");
}

}  // namespace tests
