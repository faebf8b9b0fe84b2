#include "scene/cast.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "scene/person.h"

namespace scene {

namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

std::optional<int> find_exactly(const model::Character& character, std::string_view word) {
    for (std::size_t i = 0; i < character.clips.size(); ++i)
        if (lower(character.clips[i].name) == word) return static_cast<int>(i);
    return std::nullopt;
}

// The shortest name that contains `word`: just the word, if there is one.
std::optional<int> find(const model::Character& character, std::string_view word) {
    std::optional<int> best;
    for (std::size_t i = 0; i < character.clips.size(); ++i) {
        const std::string& name = character.clips[i].name;
        if (lower(name).find(word) == std::string::npos) continue;
        if (!best || name.size() < character.clips[*best].name.size()) best = static_cast<int>(i);
    }
    return best;
}

// The first of `words` that names a clip, else clip 0.
int find_any(const model::Character& character, std::initializer_list<std::string_view> words) {
    for (std::string_view word : words)
        if (const auto clip = find(character, word)) return *clip;
    return 0;
}

// The clip's place in the list to bake, where it goes if it isn't in it yet.
std::uint8_t baked(Casting& casting, int clip) {
    const auto found = std::find(casting.clips.begin(), casting.clips.end(), clip);
    const auto index = found - casting.clips.begin();
    if (found == casting.clips.end()) casting.clips.push_back(clip);
    return static_cast<std::uint8_t>(index);
}

}  // namespace

Casting cast(const model::Character& character) {
    Casting casting;
    CastMember& member = casting.member;
    member.name = character.name;
    member.gait_speed[static_cast<int>(Role::walker)] = walk_speed;
    member.gait_speed[static_cast<int>(Role::runner)] = run_speed;
    if (character.clips.empty()) {
        for (Acts& acts : member.acts) acts.calm = {0};
        return casting;
    }
    const auto seated = find_exactly(character, "sit");
    member.sits = seated.has_value();
    const int walk = find_any(character, {"walk", "run", "fly"});
    const auto calm = [&](Role role, int clip) { member.acts[static_cast<int>(role)].calm = {baked(casting, clip)}; };
    // The first clip baked is the one that a person's height is measured in: upright, not seated nor in mid-stride.
    calm(Role::standing, seated ? find_any(character, {"stand", "idle", "walk"}) : walk);
    calm(Role::walker, walk);
    calm(Role::runner, find_any(character, {"run", "walk", "fly"}));
    calm(Role::spectator, seated ? *seated : walk);
    for (std::string_view word : {"cheer", "clap", "wave"})
        if (const auto clip = find(character, word))
            member.acts[static_cast<int>(Role::spectator)].excited.push_back(baked(casting, *clip));
    return casting;
}

}  // namespace scene
