// place and act: where and how somebody is at a tick, as arithmetic on their own random bits and the tick.
#include <algorithm>
#include <cmath>

#include "motion/schedule.h"
#include "scene/crowd.h"
#include "sfsm/random.h"

namespace scene {

namespace {

using sfsm::below;
using sfsm::hash;
using sfsm::mix;
using sfsm::upper_unit;

// What a random number is for.
enum Salt : std::uint64_t { salt_phase = 101, salt_act, salt_mood, salt_wave, salt_arrival };

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

// Mexican waves. Between two of them everybody goes through periods of one clip's length at a phase of their own.
constexpr std::int64_t wave_interval = 45 * motion::ticks_per_second;
constexpr std::int64_t wave_lap = 20 * motion::ticks_per_second;  // once around the place
constexpr std::int64_t wave_first = 6 * motion::ticks_per_second;
constexpr float wave_share = 0.85f;       // of the spectators who take part
constexpr std::int64_t wave_jitter = 15;  // [ticks] of reaction time

// The tick at which the wave's front reaches somebody; nobody's two waves overlap.
std::int64_t wave_start(std::int64_t wave, float around, std::uint32_t own) {
    return wave * wave_interval + wave_first + static_cast<std::int64_t>(around * static_cast<float>(wave_lap)) +
           below(hash(own, salt_wave), wave_jitter);
}

bool takes_part(std::int64_t wave, std::uint32_t own) {
    return upper_unit(hash(hash(own, salt_wave), static_cast<std::uint64_t>(wave))) < wave_share;
}

// Chance that somebody is excited in a period that starts at `tick`: each part of the place has moods of its own.
float excitement(float around, std::int64_t tick) {
    constexpr float parts = 20;
    constexpr std::int64_t mood_length = 15 * motion::ticks_per_second;
    constexpr float calmest = 0.04f, swing = 0.7f;
    const std::uint64_t part = static_cast<std::uint64_t>(around * parts);
    const std::uint64_t mood = static_cast<std::uint64_t>(floor_div(tick, mood_length));
    const float level = upper_unit(hash(hash(salt_mood, part), mood));
    return calmest + swing * level * level * level;  // mostly calm
}

std::uint8_t choose(const std::vector<std::uint8_t>& clips, std::uint64_t bits) {
    return clips[below(bits, static_cast<std::uint32_t>(clips.size()))];
}

std::int64_t length_of(const motion::PoseTable& poses, std::uint8_t clip) {
    return poses.clips[clip].ticks();
}

// One act for ever, at a phase of one's own.
Act keep_acting(const Acts& acts, const motion::PoseTable& poses, std::uint32_t own, std::int64_t tick) {
    constexpr float excited_share = 0.25f;
    const std::uint64_t bits = hash(own, salt_act);
    const bool excited = !acts.excited.empty() && upper_unit(bits) < excited_share;
    const std::uint8_t clip = choose(excited ? acts.excited : acts.calm, mix(bits));
    const std::int64_t length = length_of(poses, clip);
    const std::int64_t time = tick + below(hash(own, salt_phase), static_cast<std::uint32_t>(length));
    const std::int64_t from = tick - (time - floor_div(time, length) * length);
    return {from, from + length, clip, false};
}

// An act a period. The clips begin and end in one pose, so whoever waits between periods holds it.
Act alternate(const Acts& acts, const motion::PoseTable& poses, std::uint32_t own, float around, bool waves,
              std::int64_t tick) {
    const std::int64_t length = length_of(poses, acts.calm.front());
    const std::int64_t phase = below(hash(own, salt_phase), static_cast<std::uint32_t>(length));
    const std::int64_t period = floor_div(tick + phase, length);
    const std::int64_t start = period * length - phase, end = start + length;
    if (waves && 3 * length < wave_interval) {
        const std::int64_t wave = floor_div(tick - wave_start(0, around, own), wave_interval);
        const std::int64_t last = wave_start(wave, around, own), next = last + wave_interval;
        const std::int64_t over = last + length;
        if (start < over && takes_part(wave, own)) {
            if (tick < over) return {last, over, acts.excited.front(), false};
            return {over, end, acts.calm.front(), true};
        }
        if (end > next && takes_part(wave + 1, own)) return {start, next, acts.calm.front(), true};
    }
    const std::uint64_t bits = hash(hash(own, salt_act), static_cast<std::uint64_t>(period));
    const bool excited = upper_unit(bits) < excitement(around, start);
    return {start, end, choose(excited ? acts.excited : acts.calm, mix(bits)), false};
}

}  // namespace

double speed_of(const Crowd& crowd, std::size_t person, const CastMember& member) {
    constexpr double reference_height = 1.75;  // [m] that gait speeds are given at
    return static_cast<double>(member.gait_speed[static_cast<std::size_t>(crowd.role[person])]) *
           static_cast<double>(crowd.height[person]) / reference_height;
}

Placement place(const Crowd& crowd, std::size_t person, const CastMember& member, std::int64_t tick) {
    const glm::vec3 at = crowd.position[person];
    const Role role = crowd.role[person];
    if (!follows_path(role)) return {at, crowd.yaw[person]};
    const double run = static_cast<double>(at.z) +
                       speed_of(crowd, person, member) * static_cast<double>(tick) / motion::ticks_per_second;
    const float arc = static_cast<float>(std::fmod(run, static_cast<double>(crowd.path->length(at.x))));
    const glm::vec2 xz = crowd.path->position(arc, at.x), ahead = crowd.path->tangent(arc, at.x);
    return {{xz.x, at.y, xz.y}, std::atan2(ahead.x, ahead.y)};
}

// Clips follow one another only if they take equally long.
bool changes_acts(Role role, const Acts& acts, const motion::PoseTable& poses) {
    if (follows_path(role) || acts.excited.empty()) return false;
    const std::int64_t length = length_of(poses, acts.calm.front());
    const auto same = [&](std::uint8_t clip) { return length_of(poses, clip) == length; };
    return std::all_of(acts.calm.begin(), acts.calm.end(), same) &&
           std::all_of(acts.excited.begin(), acts.excited.end(), same);
}

Act act_around(const Crowd& crowd, std::size_t person, const CastMember& member, const motion::PoseTable& poses,
               std::int64_t tick) {
    const Role role = crowd.role[person];
    const Acts& acts = member.acts[static_cast<std::size_t>(role)];
    const std::uint32_t own = crowd.hash[person];
    if (!changes_acts(role, acts, poses)) return keep_acting(acts, poses, own, tick);
    return alternate(acts, poses, own, crowd.around[person], role == Role::spectator, tick);
}

Action act(const Crowd& crowd, std::size_t person, const CastMember& member, const motion::PoseTable& poses,
           std::int64_t tick) {
    return act_around(crowd, person, member, poses, tick).at(tick);
}

bool has_arrived(const Crowd& crowd, std::size_t person, std::int64_t tick) {
    if (tick >= crowd.filled_tick) return true;
    const double share = static_cast<double>(tick) / static_cast<double>(crowd.filled_tick);
    return upper_unit(hash(crowd.hash[person], salt_arrival)) < share;
}

}  // namespace scene
