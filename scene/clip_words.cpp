#include "scene/clip_words.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <span>

namespace scene {

namespace {

using Words = std::span<const std::string_view>;

// First the words that say it best.
constexpr std::string_view stand[] = {"stand",   "idle", "standing", "idling", "stands", "breathe", "breathing", "wait",
                                      "waiting", "rest", "resting",  "stance", "relax",  "relaxed", "neutral"};
constexpr std::string_view walk[] = {"walk",     "walking",   "walks", "stroll", "strolling",
                                     "marching", "wandering", "march", "wander"};
constexpr std::string_view run[] = {"run",       "running", "runs",    "gallop", "galloping", "sprint",
                                    "sprinting", "jog",     "jogging", "trot",   "trotting"};
constexpr std::string_view sit[] = {"sit", "sitting", "seated", "sits", "seat"};
constexpr std::string_view cheer[] = {"cheer",     "cheering",    "cheers",      "cheered",    "victory",
                                      "celebrate", "celebrating", "celebration", "celebrates", "rejoice",
                                      "rejoicing", "hooray",      "hurray",      "excited",    "winning"};
constexpr std::string_view clap[] = {"clap", "clapping", "claps", "applaud", "applauding", "applause"};
constexpr std::string_view wave[] = {"wave", "waving", "waves", "hello", "greet", "greeting", "hi"};
constexpr std::array<Words, 7> deeds{stand, walk, run, sit, cheer, clap, wave};

// Ways into a posture and out of it.
constexpr std::string_view transitions[] = {"to",    "start",   "stop", "end",    "begin",     "enter", "exit",
                                            "up",    "down",    "into", "from",   "land",      "turn",  "turning",
                                            "getup", "standup", "rise", "rising", "transition"};
constexpr std::string_view sideways[] = {"back",   "backward", "backwards", "left",    "right",
                                         "strafe", "strafing", "side",      "sideways"};
// These say nothing against standing, walking or sitting.
constexpr std::string_view fillers[] = {
    "cycle", "loop",    "looping", "looped",   "anim",   "animation", "clip",  "action",  "take",    "in",
    "place", "inplace", "forward", "forwards", "fwd",    "chair",     "bench", "normal",  "neutral", "base",
    "layer", "common",  "human",   "male",     "female", "armature",  "basic", "default", "mixamo",  "com"};
constexpr std::string_view others[] = {"fly",      "flying",  "swim",       "swimming", "hop",      "hopping",
                                       "move",     "moving",  "locomotion", "crawl",    "crawling", "hover",
                                       "hovering", "slither", "float",      "floating"};
constexpr std::string_view wild[] = {
    "death",  "die",    "dies",     "dying",    "dead",     "fall",      "falling",  "lie",       "lying",
    "laying", "sleep",  "sleeping", "prone",    "kneel",    "kneeling",  "crouch",   "crouching", "duck",
    "crawl",  "jump",   "jumping",  "climb",    "climbing", "swim",      "swimming", "fly",       "flying",
    "ride",   "riding", "hang",     "hanging",  "roll",     "dodge",     "attack",   "kick",      "punch",
    "slash",  "hit",    "shoot",    "shooting", "throw",    "block",     "blocking", "spin",      "slice",
    "stab",   "chop",   "react",    "reload",   "aiming",   "spellcast", "fight",    "fighting",  "stunned"};

bool contains(Words words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

bool is_known(std::string_view word) {
    return contains(fillers, word) || contains(others, word) ||
           std::ranges::any_of(deeds, [&](Words deed) { return contains(deed, word); });
}

// Appends what `word` is made of, all of it known; or nothing, and false.
bool split(std::string_view word, std::vector<std::string>& out) {
    constexpr std::size_t shortest = 2, longest = 24;
    if (word.size() > longest) return false;
    if (is_known(word)) {
        out.emplace_back(word);
        return true;
    }
    for (std::size_t size = word.size() - std::min(word.size(), shortest); size >= shortest; --size) {
        if (!is_known(word.substr(0, size))) continue;
        const std::size_t before = out.size();
        out.emplace_back(word.substr(0, size));
        if (split(word.substr(size), out)) return true;
        out.resize(before);
    }
    return false;
}

enum class Kind { other, small, capital, digit };

Kind kind_of(char c) {
    const auto code = static_cast<unsigned char>(c);
    if (std::isdigit(code)) return Kind::digit;
    if (std::isupper(code)) return Kind::capital;
    return std::islower(code) || code >= 0x80 ? Kind::small : Kind::other;
}

// Whether a word begins at `at`: walkFast, walk2, WALKFast.
bool begins_word(std::string_view name, std::size_t at) {
    const Kind before = kind_of(name[at - 1]), here = kind_of(name[at]);
    if (before == here) {
        const bool small_after = at + 1 < name.size() && kind_of(name[at + 1]) == Kind::small;
        return here == Kind::capital && small_after;
    }
    return !(before == Kind::capital && here == Kind::small);
}

bool has_any(const std::vector<std::string>& words, Words of) {
    return std::ranges::any_of(words, [&](const std::string& word) { return contains(of, word); });
}

bool is_number(std::string_view word) {
    return kind_of(word.front()) == Kind::digit;
}

// What a word that isn't the deed's own adds.
double strangeness(Deed deed, std::string_view word) {
    constexpr double little = 0.5, some = 1, much = 5, aside = 10;
    if (is_number(word) || word.size() == 1) return little;
    if (contains(fillers, word) || contains(deeds[static_cast<std::size_t>(deed)], word)) return 0;
    if (deed == Deed::sit && contains(stand, word)) return 0;
    if (word == "pose" || word == "full") return little;
    if (contains(sideways, word)) return aside;
    return contains(wild, word) ? much : some;
}

// Postures that leave no room for another deed: who sits idle doesn't stand.
bool excludes(Deed deed, const std::vector<std::string>& words) {
    const bool seated = has_any(words, sit);
    if (deed == Deed::stand)
        return seated || has_any(words, walk) || has_any(words, run) || has_any(words, wild) || has_any(words, others);
    if (deed == Deed::walk) return seated || has_any(words, run);
    return deed == Deed::run && (seated || has_any(words, walk));
}

// The part of a name after the last '|' is the clip's own, what is before it an armature's or a file's.
std::string_view own_part(std::string_view name) {
    return name.substr(name.rfind('|') + 1);
}

std::optional<double> distance_of_words(Deed deed, const std::vector<std::string>& words) {
    const Words meant = deeds[static_cast<std::size_t>(deed)];
    if (!has_any(words, meant) || has_any(words, transitions) || excludes(deed, words)) return std::nullopt;
    constexpr double a_rank = 0.01;
    double sum = 0;
    std::size_t best = meant.size();
    for (const std::string& word : words) {
        best = std::min(best, static_cast<std::size_t>(std::ranges::find(meant, word) - meant.begin()));
        sum += strangeness(deed, word);
    }
    return sum + a_rank * static_cast<double>(best);
}

}  // namespace

std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words;
    std::string word;
    const auto close = [&] {
        if (!word.empty() && !split(word, words)) words.push_back(word);
        word.clear();
    };
    for (std::size_t i = 0; i < name.size(); ++i) {
        const Kind kind = kind_of(name[i]);
        if (kind == Kind::other || (i > 0 && begins_word(name, i))) close();
        if (kind != Kind::other) word += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    close();
    return words;
}

std::optional<double> distance(Deed deed, std::string_view name) {
    constexpr double from_before = 3;  // where only what comes before the clip's own part says it
    if (const auto own = distance_of_words(deed, words_of(own_part(name)))) return own;
    if (own_part(name).size() == name.size()) return std::nullopt;
    const auto whole = distance_of_words(deed, words_of(name));
    if (!whole) return std::nullopt;
    return *whole + from_before;
}

bool moves_on(std::string_view name) {
    return has_any(words_of(own_part(name)), others);
}

bool is_wild(std::string_view name) {
    return has_any(words_of(own_part(name)), wild) || has_any(words_of(own_part(name)), transitions);
}

bool is_bind_pose(std::string_view name) {
    const std::vector<std::string> words = words_of(own_part(name));
    const auto follow = [&](std::string_view first, std::string_view second) {
        for (std::size_t i = 0; i + 1 < words.size(); ++i)
            if (words[i] == first && words[i + 1] == second) return true;
        return std::ranges::find(words, std::string(first) + std::string(second)) != words.end();
    };
    return follow("t", "pose") || follow("a", "pose") || follow("bind", "pose");
}

}  // namespace scene
