// Who does what, remembered: act() with no arithmetic as long as somebody goes on with what they do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/crowd.h"

namespace scene {

// The answers are act()'s, whatever was asked before and in whatever order; those of ticks that go up come fastest.
// 8 bytes a person. Several threads may ask at once, each of other people.
class RememberedActs {
public:
    // `crowd` must outlive it.
    explicit RememberedActs(const Crowd& crowd);

    // What `person` does at `tick`; `member` and `poses` are those of their character.
    Action at(std::size_t person, const CastMember& member, const motion::PoseTable& poses, std::int64_t tick) {
        const Memory& memory = memories_[person];
        const std::int64_t since = tick - memory.from;
        if (since < 0 || since >= memory.ticks) return ask(person, member, poses, tick);
        return {memory.clip, memory.holds ? 0 : since};
    }

private:
    // Of an Act, as far as it fits.
    struct Memory {
        std::int32_t from = 0;    // [ticks]
        std::uint16_t ticks = 0;  // 0: nothing is known
        std::uint8_t clip = 0;
        bool holds = false;
    };

    Action ask(std::size_t person, const CastMember& member, const motion::PoseTable& poses, std::int64_t tick);

    const Crowd& crowd_;
    std::vector<Memory> memories_;
};

}  // namespace scene
