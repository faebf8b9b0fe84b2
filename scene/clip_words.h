// What the name of a clip says its character does, in whatever spelling tools give it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scene {

// What can be asked of a character.
enum class Deed { stand, walk, run, sit, cheer, clap, wave };
inline constexpr std::array<std::string_view, 7> deed_names{"stand", "walk", "run", "sit", "cheer", "clap", "wave"};

inline std::string_view name_of(Deed deed) {
    return deed_names[static_cast<std::size_t>(deed)];
}

// The words of a name in small letters: "mixamo.com|Sit_ChairIdle02" has mixamo, com, sit, chair, idle, 02. Also words
// written as one, if all of them are known: "walkcycle" has walk and cycle.
std::vector<std::string> words_of(std::string_view name);

// How far a clip of this name is from being the deed and nothing else, >= 0: 0 for "Walk", more for "Walk_Gun" and
// "Walk_Left". Empty if the name says something else, or the way into or out of it ("Sit_Chair_Down", "StandToWalk").
std::optional<double> distance(Deed deed, std::string_view name);

// Whether a name says that its character moves on, though not on its feet, perhaps: flies, swims, hops.
bool moves_on(std::string_view name);

// Whether a name says that its character doesn't stand there calmly: falls, dies, fights.
bool is_wild(std::string_view name);

// Whether a name says that limbs are spread for whoever binds them.
bool is_bind_pose(std::string_view name);

}  // namespace scene
