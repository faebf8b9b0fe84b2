#include "scene/cast.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "model/clip_list.h"
#include "model/input_file.h"
#include "motion/pose.h"
#include "scene/body_motion.h"
#include "scene/person.h"

namespace scene {

namespace {

// A clip, or a pose of it.
struct Take {
    int clip = 0;
    std::optional<double> held;  // [s] a moment
    bool is_mean = false;        // the mean of all moments

    bool operator==(const Take&) const = default;
};

// What is known of a character's clips, measured when it is asked for.
class Repertoire {
public:
    explicit Repertoire(const model::Character& character)
        : character_(character), motions_(character.clips.size()), spread_(character.clips.size()) {}

    int size() const { return static_cast<int>(character_.clips.size()); }
    const model::Clip& clip(int index) const { return character_.clips[static_cast<std::size_t>(index)]; }

    const BodyMotion& motion(int index) {
        constexpr std::size_t most_moments = 8;
        std::optional<BodyMotion>& motion = motions_[static_cast<std::size_t>(index)];
        if (!motion) motion = measure_motion(character_, &clip(index), most_moments);
        return *motion;
    }

    bool is_bind_pose(int index) {
        std::optional<bool>& spread = spread_[static_cast<std::size_t>(index)];
        if (!spread) spread = scene::is_bind_pose(clip(index).name) || strikes_bind_pose(character_, clip(index));
        return *spread;
    }

    // Whether somebody would go somewhere by it.
    bool is_gait(int index) {
        const std::string& name = clip(index).name;
        return distance(Deed::walk, name) || distance(Deed::run, name) || motion(index).gait() != glm::vec2(0.0f);
    }

    // The clip whose name says it best.
    std::optional<int> named(Deed deed) {
        return best([&](int index) { return distance(deed, clip(index).name); });
    }

    // The one of the smallest cost; bind poses and those of no cost at all are left out.
    std::optional<int> best(const std::function<std::optional<double>(int)>& cost) {
        std::optional<int> found;
        double least = 0;
        for (int i = 0; i < size(); ++i) {
            const std::optional<double> here = cost(i);
            if (!here || (found && !(*here < least)) || is_bind_pose(i)) continue;
            found = i;
            least = *here;
        }
        return found;
    }

private:
    const model::Character& character_;
    std::vector<std::optional<BodyMotion>> motions_;
    std::vector<std::optional<bool>> spread_;
};

// The end of a clip that sits down or stands up, in which the body is higher or lower.
Take held_end(const BodyMotion& motion, int clip, bool higher) {
    const bool is_last = (motion.boxes.back().size().y > motion.boxes.front().size().y) == higher;
    return {clip, is_last ? motion.times.back() : 0.0};
}

// Upright, as far as there is anything to compare with.
bool is_upright(Repertoire& clips, int index) {
    constexpr float bent = 0.75f;  // of the height of whoever is highest
    float highest = 0;
    for (int i = 0; i < clips.size(); ++i)
        if (!is_wild(clips.clip(i).name)) highest = std::max(highest, clips.motion(i).height());
    return !(clips.motion(index).height() < bent * highest);
}

// What somebody stands in who has no clip for it.
Take calmest(Repertoire& clips, model::Warnings& warnings) {
    const auto liveliness = [&](int i) { return std::optional(clips.motion(i).liveliness); };
    const auto while_standing = [&](int i) -> std::optional<double> {
        const std::string& name = clips.clip(i).name;
        if (is_wild(name) || distance(Deed::sit, name) || clips.is_bind_pose(i) || !is_upright(clips, i))
            return std::nullopt;
        return liveliness(i);
    };
    std::optional<int> found = clips.best(while_standing);
    if (!found) found = clips.best(liveliness);
    if (!found) return {0, std::nullopt};
    if (!clips.is_gait(*found)) return {*found, std::nullopt};
    warnings.add("no clip to stand in, the mean pose of one is held", clips.clip(*found).name);
    return {*found, std::nullopt, true};
}

Take to_stand(Repertoire& clips, model::Warnings& warnings) {
    const auto steady = [&](int i) -> std::optional<double> {
        const auto cost = distance(Deed::stand, clips.clip(i).name);
        return cost && !clips.is_bind_pose(i) && clips.motion(i).is_loop() ? cost : std::nullopt;
    };
    if (const auto found = clips.best(steady)) return {*found, std::nullopt};
    if (const auto rising = clips.named(Deed::stand)) return held_end(clips.motion(*rising), *rising, true);
    return calmest(clips, warnings);
}

std::optional<Take> to_sit(Repertoire& clips) {
    const auto found = clips.named(Deed::sit);
    if (!found) return std::nullopt;
    const BodyMotion& motion = clips.motion(*found);
    if (!motion.is_loop()) return held_end(motion, *found, false);
    return Take{*found, std::nullopt};
}

// The first that there is of what `deeds` name, else what moves on in another way, else by its looks.
std::optional<Take> to_go(Repertoire& clips, std::initializer_list<Deed> deeds) {
    for (const Deed deed : deeds)
        if (const auto found = clips.named(deed)) return Take{*found, std::nullopt};
    const auto moving = [&](int i) { return moves_on(clips.clip(i).name) ? std::optional(0.0) : std::nullopt; };
    if (const auto found = clips.best(moving)) return Take{*found, std::nullopt};
    const auto gait = [&](int i) -> std::optional<double> {
        if (is_wild(clips.clip(i).name) || clips.motion(i).gait() == glm::vec2(0.0f)) return std::nullopt;
        return clips.motion(i).liveliness;
    };
    if (const auto found = clips.best(gait)) return Take{*found, std::nullopt};
    return std::nullopt;
}

// What users want, by deed.
std::map<Deed, Take> takes_of(std::span<const ActWish> wishes, const model::Character& character) {
    std::map<Deed, Take> takes;
    for (const ActWish& wish : wishes) {
        const auto found = std::ranges::find(character.clips, wish.clip, &model::Clip::name);
        if (found == character.clips.end())
            throw std::runtime_error(
                "found no clip " + model::in_quotes(wish.clip) + " to " + std::string(name_of(wish.deed)) +
                " by; expected " +
                (character.clips.empty() ? "none, as it has no clips" : "one of " + model::list_of(character.clips)));
        takes[wish.deed] = {static_cast<int>(found - character.clips.begin()), std::nullopt};
    }
    return takes;
}

// One moment of a clip, as a clip.
model::Clip still_of(const model::Clip& clip, double moment) {
    char text[40];
    std::snprintf(text, sizeof text, ", held at %.2f s", moment);
    model::Clip still{clip.name + text, 0, clip.channels};
    for (model::Channel& channel : still.channels)
        for (float& time : channel.times) time -= static_cast<float>(moment);
    return still;
}

// What somebody who walks is in on the whole: upright, on both feet, arms hanging.
model::Clip mean_pose_of(const model::Clip& clip) {
    model::Clip still = motion::mean_of(clip);
    still.name += ", its mean pose";
    return still;
}

// Collects what is to be baked.
class Program {
public:
    Program(const model::Character& character, Casting& casting) : character_(character), casting_(casting) {}

    std::uint8_t baked(const Take& take) {
        const auto found = std::ranges::find(takes_, take);
        if (found != takes_.end()) return static_cast<std::uint8_t>(found - takes_.begin());
        takes_.push_back(take);
        casting_.clips.push_back(take.held || take.is_mean ? still(take) : take.clip);
        return static_cast<std::uint8_t>(takes_.size() - 1);
    }

private:
    int still(const Take& take) {
        const model::Clip& clip = character_.clips[static_cast<std::size_t>(take.clip)];
        casting_.stills.push_back(take.is_mean ? mean_pose_of(clip) : still_of(clip, *take.held));
        return static_cast<int>(character_.clips.size() + casting_.stills.size()) - 1;
    }

    const model::Character& character_;
    Casting& casting_;
    std::vector<Take> takes_;
};

void be_a_statue(CastMember& member) {
    for (Acts& acts : member.acts) acts.calm = {0};
}

}  // namespace

Casting cast(const model::Character& character, std::span<const ActWish> wishes) {
    Casting casting;
    CastMember& member = casting.member;
    member.name = character.name;
    member.gait_speed[static_cast<int>(Role::walker)] = walk_speed;
    member.gait_speed[static_cast<int>(Role::runner)] = run_speed;
    const std::map<Deed, Take> wanted = takes_of(wishes, character);
    if (character.clips.empty()) {
        be_a_statue(member);
        return casting;
    }
    Repertoire clips(character);
    const auto choose = [&](Deed deed, const std::function<std::optional<Take>()>& otherwise) {
        const auto wish = wanted.find(deed);
        return wish == wanted.end() ? otherwise() : std::optional(wish->second);
    };
    const auto sit = choose(Deed::sit, [&] { return to_sit(clips); });
    model::Warnings of_standing;
    const auto stand = choose(Deed::stand, [&] { return to_stand(clips, of_standing); });
    if (!sit) casting.warnings = of_standing;
    const auto walk = choose(Deed::walk, [&] { return to_go(clips, {Deed::walk, Deed::run}); });
    const auto run = choose(Deed::run, [&] { return to_go(clips, {Deed::run, Deed::walk}); });
    if (!walk && !run) casting.warnings.add("no clip to walk or run by, glides", "");
    member.sits = sit.has_value();

    Program program(character, casting);
    const auto calm = [&](Role role, const Take& take) {
        member.acts[static_cast<int>(role)].calm = {program.baked(take)};
    };
    // The first clip baked is the one that a person's height is measured in: upright, not seated nor in mid-stride.
    calm(Role::standing, *stand);
    calm(Role::walker, walk.value_or(*stand));
    calm(Role::runner, run.value_or(*stand));
    calm(Role::spectator, sit.value_or(*stand));
    for (const Deed deed : {Deed::cheer, Deed::clap, Deed::wave}) {
        const auto take = choose(deed, [&]() -> std::optional<Take> {
            const auto found = clips.named(deed);
            return found ? std::optional(Take{*found, std::nullopt}) : std::nullopt;
        });
        if (take) member.acts[static_cast<int>(Role::spectator)].excited.push_back(program.baked(*take));
    }
    return casting;
}

void add_stills(model::Character& character, const Casting& casting) {
    character.clips.insert(character.clips.end(), casting.stills.begin(), casting.stills.end());
}

}  // namespace scene
