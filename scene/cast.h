// Gives a character its roles: which of its clips play when people sit, react, walk and run.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/character.h"
#include "scene/clip_words.h"
#include "scene/crowd.h"

namespace scene {

// What a user wants somebody to do something by.
struct ActWish {
    Deed deed;
    std::string clip;  // its name

    bool operator==(const ActWish&) const = default;
};

struct Casting {
    CastMember member;
    // Into Character::clips with `stills` behind them, in the order CastMember's acts count them: what to bake. The
    // first is the one that people stand in. Empty: a statue.
    std::vector<int> clips;
    std::vector<model::Clip> stills;  // single poses of the character's clips
    model::Warnings warnings;         // roles that there is nothing for
};

// Clips are found by what their names say, in any spelling (scene/clip_words.h).
// - Who has a clip to sit by takes a seat, and others stand before theirs: in a clip to stand by, else in the calmest
//   there is, as measured on the posed surface. Nobody walks or runs on the spot: of a gait the mean pose is held, on
//   both feet. Of a clip that sits down or stands up its end is held.
// - Who walks without a clip for it runs, flies or does what looks most like a gait, and the other way round; else they
//   glide.
// - A clip that never leaves the bind pose is taken only where there is no other.
// `wishes` go before all that; throws std::runtime_error naming the clips there are for one that isn't there, or for a
// character without clips.
Casting cast(const model::Character& character, std::span<const ActWish> wishes = {});

// Puts the casting's stills where its `clips` look for them.
void add_stills(model::Character& character, const Casting& casting);

}  // namespace scene
