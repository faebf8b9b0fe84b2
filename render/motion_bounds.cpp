#include "render/motion_bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "figures/splats.h"
#include "model/unorm.h"

namespace render {

namespace {

constexpr int longest_age = motion::max_period - 1 + ticks_a_key - 1;  // [ticks]

// Turns are drawn with sines of 16 bits, places and scales with floats.
constexpr float rounding = 1.0001f;

// [model units^2] The largest squared distance between two poses of a vertex, by the fewest ticks that lie between.
using ByAge = std::array<float, longest_age + 1>;

void widen(ByAge& ages, const ByAge& other) {
    for (int age = 0; age <= longest_age; ++age) ages[age] = std::max(ages[age], other[age]);
}

// Where one vertex is from pose to pose [model units].
struct Track {
    std::vector<float> x, y, z;

    void resize(std::size_t count) {
        for (std::vector<float>* axis : {&x, &y, &z}) axis->resize(count);
    }
    void set(std::size_t pose, const glm::vec3& at) {
        x[pose] = at.x;
        y[pose] = at.y;
        z[pose] = at.z;
    }
    void copy(std::size_t from, std::size_t to) {
        for (std::vector<float>* axis : {&x, &y, &z}) (*axis)[to] = (*axis)[from];
    }
    float squared_distance(std::size_t pose, const Track& other, std::size_t other_pose) const {
        const float dx = x[pose] - other.x[other_pose], dy = y[pose] - other.y[other_pose],
                    dz = z[pose] - other.z[other_pose];
        return dx * dx + dy * dy + dz * dz;
    }
};

// Over `count` poses, each of `from` with one of `to`. In lanes, which compilers make vectors of.
float farthest(const Track& from, std::size_t first, const Track& to, std::size_t other_first, std::size_t count) {
    constexpr std::size_t lanes = 8;
    float most[lanes] = {};
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const float squared = from.squared_distance(first + i + lane, to, other_first + i + lane);
            most[lane] = squared > most[lane] ? squared : most[lane];
        }
    for (; i < count; ++i) most[0] = std::max(most[0], from.squared_distance(first + i, to, other_first + i));
    return *std::max_element(most, most + lanes);
}

// The fewest ticks between two poses of a clip, or of one and the next, of which one is so many poses after the other.
std::int64_t fewest_ticks(std::int64_t poses, std::int64_t ticks_per_pose) {
    return poses == 0 ? 0 : (poses - 1) * ticks_per_pose + 1;
}

// A clip as one track has it: its poses, and then its first ones again.
struct Stretch {
    std::size_t first = 0, count = 0;
    std::int64_t ticks_per_pose = 1;
};

// What was found of a character so far.
struct Found {
    std::vector<ByAge> clip, far_clip;  // of who goes on with a clip for ever
    std::vector<float> turned;          // by clip: the largest squared distance from the axis that people turn about
    std::array<ByAge, scene::role_count> change{}, far_change{};  // from one clip of a role to another

    void widen_by(const Found& other) {
        for (std::size_t i = 0; i < clip.size(); ++i) {
            widen(clip[i], other.clip[i]);
            widen(far_clip[i], other.far_clip[i]);
            turned[i] = std::max(turned[i], other.turned[i]);
        }
        for (int role = 0; role < scene::role_count; ++role) {
            widen(change[role], other.change[role]);
            widen(far_change[role], other.far_change[role]);
        }
    }

    explicit Found(std::size_t clips) : clip(clips), far_clip(clips), turned(clips) {}
};

std::vector<std::uint8_t> clips_of(const scene::Acts& acts) {
    std::vector<std::uint8_t> clips = acts.calm;
    clips.insert(clips.end(), acts.excited.begin(), acts.excited.end());
    std::ranges::sort(clips);
    clips.erase(std::unique(clips.begin(), clips.end()), clips.end());
    return clips;
}

// Looks at the vertices of one character.
class Poses {
public:
    Poses(const motion::PoseTable& table, const scene::CastMember& member,
          const std::array<bool, scene::role_count>& wanted)
        : table_(table),
          member_(member),
          step_(table.box.size() / static_cast<float>(model::unorm_steps)),
          keys_(figures::splat_keys(table)) {
        is_played_.resize(table.clips.size());
        for (int role = 0; role < scene::role_count; ++role) {
            if (!wanted[role]) continue;
            const scene::Acts& acts = member.acts[role];
            for (const std::uint8_t clip : clips_of(acts)) is_played_[clip] = true;
            if (scene::changes_acts(static_cast<scene::Role>(role), acts, table)) changing_.push_back(role);
        }
        std::size_t first = 0;
        for (const motion::ClipPoses& clip : table.clips) {
            const auto count = static_cast<std::size_t>(clip.pose_count);
            stretches_.push_back({first, count, clip.ticks_per_pose});
            first += count + longest_age;
        }
        length_ = first;
    }

    // Some vertices first: the others can add little to what those did.
    Found find() const {
        constexpr std::size_t first_ones = 16;
        const std::size_t groups = (static_cast<std::size_t>(table_.vertex_count) + together - 1) / together;
        std::vector<std::size_t> some, others;
        for (std::size_t i = 0; i < groups; ++i) (i % first_ones == 0 ? some : others).push_back(i);
        return look_at(others, look_at(some, Found(table_.clips.size())));
    }

private:
    static constexpr float any_step = std::numeric_limits<float>::infinity();
    static constexpr std::size_t together = 8;  // vertices: a cache line of a pose

    // Tracks of some vertices: as they are, and as far blocks show them.
    struct Scratch {
        std::array<Track, together> real, shown;
    };

    Found look_at(std::span<const std::size_t> groups, const Found& known) const {
        tbb::enumerable_thread_specific<Found> found(known);
        const auto all = static_cast<std::size_t>(table_.vertex_count);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups.size()),
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              Scratch scratch;
                              for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                  const std::size_t first = groups[i] * together;
                                  look(first, std::min(together, all - first), scratch, found.local());
                              }
                          });
        Found sum = known;
        for (const Found& one : found) sum.widen_by(one);
        return sum;
    }

    void look(std::size_t first, std::size_t count, Scratch& scratch, Found& found) const {
        for (std::size_t i = 0; i < count; ++i) {
            scratch.real[i].resize(length_);
            scratch.shown[i].resize(length_);
        }
        for (std::size_t clip = 0; clip < stretches_.size(); ++clip) unpack(clip, first, count, scratch);
        for (std::size_t i = 0; i < count; ++i) {
            const Track &real = scratch.real[i], &shown = scratch.shown[i];
            for (std::size_t clip = 0; clip < stretches_.size(); ++clip) {
                if (!is_played_[clip]) continue;
                const Stretch& stretch = stretches_[clip];
                const float reach = reach_in(stretch, real);
                const float step = farthest(real, stretch.first, real, stretch.first + 1, stretch.count);
                follow(stretch, real, real, reach, step, found.clip[clip]);
                if (has_keys()) follow(stretch, shown, real, reach, any_step, found.far_clip[clip]);
                found.turned[clip] = std::max(found.turned[clip], farthest_from_axis(stretches_[clip], real));
            }
            for (const int role : changing_) {
                change(member_.acts[role], real, real, found.change[role]);
                if (has_keys()) change(member_.acts[role], shown, real, found.far_change[role]);
            }
        }
    }

    bool has_keys() const { return !keys_.poses.empty(); }

    void unpack(std::size_t clip, std::size_t first, std::size_t count, Scratch& scratch) const {
        const Stretch& stretch = stretches_[clip];
        const auto first_pose = static_cast<std::size_t>(table_.clips[clip].first_pose);
        for (std::size_t pose = 0; pose < stretch.count; ++pose) {
            const motion::PosedVertex* vertices =
                &table_.vertices[(first_pose + pose) * static_cast<std::size_t>(table_.vertex_count) + first];
            for (std::size_t i = 0; i < count; ++i)
                scratch.real[i].set(stretch.first + pose,
                                    table_.box.min + step_ * glm::vec3(vertices[i].x, vertices[i].y, vertices[i].z));
        }
        for (std::size_t i = 0; i < count; ++i) {
            Track &real = scratch.real[i], &shown = scratch.shown[i];
            for (std::size_t pose = 0; pose < longest_age; ++pose)
                real.copy(stretch.first + pose % stretch.count, stretch.first + stretch.count + pose);
            for (std::size_t pose = 0; pose < stretch.count && has_keys(); ++pose) {
                const auto key = static_cast<std::size_t>(keys_.poses[keys_.of_pose[first_pose + pose]]) - first_pose;
                const std::size_t from = stretch.first + key, to = stretch.first + pose;
                shown.x[to] = real.x[from];
                shown.y[to] = real.y[from];
                shown.z[to] = real.z[from];
            }
        }
    }

    // One clip again and again: who is at a pose has been at one of those before it. Ages that the vertex can add
    // nothing to are passed over: it stays within `reach` of where it was, and goes no farther than `step` from a pose
    // to the next (squared, both).
    static void follow(const Stretch& clip, const Track& before, const Track& now, float reach, float step,
                       ByAge& ages) {
        float known = 0;
        std::int64_t age = 0;
        for (std::int64_t poses = 0; poses <= longest_age; ++poses) {
            const std::int64_t ticks = fewest_ticks(poses, clip.ticks_per_pose);
            if (ticks > longest_age) break;
            for (; age <= ticks; ++age) known = std::max(known, ages[age]);
            if (reach <= known) break;
            if (poses > 0 && static_cast<float>(poses * poses) * step <= known) continue;
            ages[ticks] = std::max(ages[ticks], farthest(before, clip.first, now,
                                                         clip.first + static_cast<std::size_t>(poses), clip.count));
        }
    }

    // The squared diagonal of the box that holds the vertex in a clip.
    static float reach_in(const Stretch& clip, const Track& track) {
        float squared = 0;
        for (const std::vector<float>* axis : {&track.x, &track.y, &track.z}) {
            float least = (*axis)[clip.first], most = least;
            for (std::size_t pose = clip.first; pose < clip.first + clip.count; ++pose) {
                least = std::min(least, (*axis)[pose]);
                most = std::max(most, (*axis)[pose]);
            }
            squared += (most - least) * (most - least);
        }
        return squared;
    }

    // From the end of any clip, or from the pose that is held between them, to the beginning of any. Who has done
    // several in so few ticks did the last of them in fewer.
    void change(const scene::Acts& acts, const Track& before, const Track& now, ByAge& ages) const {
        const std::vector<std::uint8_t> clips = clips_of(acts);
        const Stretch held{stretches_[acts.calm.front()].first, 1, 1};
        for (const std::uint8_t next : clips) {
            cross(held, stretches_[next], before, now, ages);
            for (const std::uint8_t clip : clips)
                if (clip != next) cross(stretches_[clip], stretches_[next], before, now, ages);
        }
    }

    static void cross(const Stretch& clip, const Stretch& next, const Track& before, const Track& now, ByAge& ages) {
        for (std::size_t last = 1; last <= clip.count; ++last) {
            const std::int64_t left = fewest_ticks(static_cast<std::int64_t>(last), clip.ticks_per_pose);
            if (left > longest_age) break;
            for (std::size_t pose = 0; pose < next.count; ++pose) {
                const std::int64_t ticks = left + static_cast<std::int64_t>(pose) * next.ticks_per_pose;
                if (ticks > longest_age) break;
                const float squared = before.squared_distance(clip.first + clip.count - last, now, next.first + pose);
                ages[ticks] = std::max(ages[ticks], squared);
            }
        }
    }

    static float farthest_from_axis(const Stretch& clip, const Track& track) {
        float most = 0;
        for (std::size_t pose = clip.first; pose < clip.first + clip.count; ++pose)
            most = std::max(most, track.x[pose] * track.x[pose] + track.z[pose] * track.z[pose]);
        return most;
    }

    const motion::PoseTable& table_;
    const scene::CastMember& member_;
    const glm::vec3 step_;  // [model units] of a packed position
    const figures::SplatKeys keys_;
    std::vector<bool> is_played_;  // by clip
    std::vector<int> changing_;    // roles that go from clip to clip
    std::vector<Stretch> stretches_;
    std::size_t length_ = 0;  // of a track
};

// The most that anybody of a character and role does on their path in a tick.
struct Going {
    bool is_anybody = false;
    double way = 0;       // [model units]
    double turn = 0;      // [rad]
    double rounding = 0;  // [model units] of two places
};

using Goings = std::array<Going, scene::role_count>;

std::vector<Goings> find_goings(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                                std::span<const figures::Figure> figures) {
    constexpr double step = 4 * static_cast<double>(std::numeric_limits<float>::epsilon());
    std::vector<Goings> goings(figures.size());
    for (std::size_t person = 0; person < crowd.size(); ++person) {
        const std::size_t character = crowd.character[person];
        Going& going = goings[character][static_cast<std::size_t>(crowd.role[person])];
        going.is_anybody = true;
        if (!scene::follows_path(crowd.role[person])) continue;
        const double scale = static_cast<double>(crowd.height[person] / figures[character].poses->rest_height);
        const double speed = scene::speed_of(crowd, person, cast[character]) / motion::ticks_per_second;
        const float offset = crowd.position[person].x;
        const motion::Bounds bounds = crowd.path->bounds(offset);
        const glm::vec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
        const float numbers = crowd.path->length(offset) + reach.x + reach.z;
        going.way = std::max(going.way, std::abs(speed) / scale);
        going.turn =
            std::max(going.turn, speed == 0 ? 0 : std::abs(speed) * static_cast<double>(crowd.path->turning(offset)));
        going.rounding = std::max(going.rounding, step * static_cast<double>(numbers) / scale);
    }
    return goings;
}

// [model units] Whose pose is so far off, and who went on for so long.
double moved(double posed, double from_axis, const Going& going, int age) {
    if (age == 0) return posed;
    const double angle = std::min(going.turn * age, std::numbers::pi);
    return posed + going.way * age + 2 * std::sin(angle / 2) * from_axis + going.rounding;
}

// `later`: how much longer ago than a period says.
MotionBound bound_of(const ByAge& ages, double from_axis, const Going& going, int later) {
    MotionBound bound{};
    float squared = 0;
    int age = 0;
    for (int period = 1; period <= motion::max_period; ++period) {
        for (; age <= period - 1 + later; ++age) squared = std::max(squared, ages[age]);
        const double posed = std::sqrt(static_cast<double>(squared));
        bound[period] = rounding * static_cast<float>(moved(posed, from_axis, going, period - 1 + later));
    }
    bound[0] = bound[1];
    return bound;
}

MotionBounds measure(const scene::CastMember& member, const motion::PoseTable& table, const Goings& goings) {
    std::array<bool, scene::role_count> wanted{};
    for (int role = 0; role < scene::role_count; ++role) wanted[role] = goings[role].is_anybody;
    const Found found = Poses(table, member, wanted).find();
    MotionBounds bounds;
    for (int role = 0; role < scene::role_count; ++role) {
        if (!wanted[role]) continue;
        ByAge ages = found.change[role], far_ages = found.far_change[role];
        float from_axis = 0;
        for (const std::uint8_t clip : clips_of(member.acts[role])) {
            widen(ages, found.clip[clip]);
            widen(far_ages, found.far_clip[clip]);
            from_axis = std::max(from_axis, found.turned[clip]);
        }
        const double radius = std::sqrt(static_cast<double>(from_axis));
        bounds.single[role] = bound_of(ages, radius, goings[role], 0);
        bounds.far[role] = bound_of(far_ages, radius, goings[role], ticks_a_key - 1);
    }
    return bounds;
}

}  // namespace

std::vector<MotionBounds> measure_motion_bounds(const scene::Crowd& crowd, std::span<const scene::CastMember> cast,
                                                std::span<const figures::Figure> figures) {
    const std::vector<Goings> goings = find_goings(crowd, cast, figures);
    std::vector<MotionBounds> bounds;
    for (std::size_t character = 0; character < figures.size(); ++character)
        bounds.push_back(measure(cast[character], *figures[character].poses, goings[character]));
    return bounds;
}

}  // namespace render
