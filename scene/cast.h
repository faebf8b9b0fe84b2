// Gives a character its roles: which of its clips play when people sit, react, walk and run.
#pragma once

#include <vector>

#include "model/character.h"
#include "scene/crowd.h"

namespace scene {

struct Casting {
    CastMember member;
    std::vector<int>
        clips;  // into Character::clips, in the order CastMember's acts count them: what to bake. Empty: a statue
};

// Clips are found by name: exactly, then as the shortest name that contains the word, in any case ("Robot_Walking" for
// walk). A character with a clip called just "sit" is the built-in person's like and takes seats; any other walks on
// the spot in the stands, and some cheer, wave or clap if they can. Where no name fits, the first clip plays.
Casting cast(const model::Character& character);

}  // namespace scene
