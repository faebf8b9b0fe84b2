#include "scene/settle.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "scene/body_motion.h"
#include "scene/clip_words.h"
#include "scene/person.h"

namespace scene {

namespace {

constexpr std::size_t most_moments = 48;
constexpr double pi = 3.14159265358979;

glm::vec3 over(glm::vec2 ground, float y = 0) {
    return {ground.x, y, ground.y};
}

// One of the clips that are baked: null is the rest pose.
struct Baked {
    model::Clip* clip = nullptr;
    BodyMotion motion;
};

std::vector<Baked> measure_all(model::Character& character, const Casting& casting) {
    std::vector<Baked> all;
    if (casting.clips.empty()) all.push_back({nullptr, measure_motion(character, nullptr, most_moments)});
    for (const int index : casting.clips) {
        model::Clip& clip = character.clips[static_cast<std::size_t>(index)];
        all.push_back({&clip, measure_motion(character, &clip, most_moments)});
    }
    return all;
}

// [model units] What becomes settled_height.
float size_of(const BodyMotion& standing) {
    constexpr float lying = 2.5f;  // times as long as high
    const glm::vec3 size = [&] {
        std::vector<float> x, z;
        for (const motion::Bounds& box : standing.boxes) {
            x.push_back(box.size().x);
            z.push_back(box.size().z);
        }
        std::ranges::nth_element(x, x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2));
        std::ranges::nth_element(z, z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2));
        return glm::vec3(x[x.size() / 2], standing.height(), z[z.size() / 2]);
    }();
    const float longest = std::max(size.x, size.z);
    const float height = longest > lying * size.y ? longest : size.y;
    if (!(height > 0) || !std::isfinite(height))
        throw std::runtime_error("found a body without any extent; expected one to stand on its feet");
    return height;
}

// How model units become metres around the vertical; where to is a clip's own business.
struct Frame {
    float scale;     // [m / model unit]
    glm::mat3 turn;  // about y

    glm::vec3 operator()(glm::vec3 position) const { return scale * (turn * position); }
    glm::vec2 on_ground(glm::vec2 at) const {
        const glm::vec3 turned = (*this)(over(at));
        return {turned.x, turned.z};
    }
};

// [m] What is to be added to a body at each moment of a clip so that it stays over the origin with its feet at 0.
// Swaying stays as it is; what goes farther than that is walking about.
std::vector<glm::vec3> staying(const BodyMotion& motion, const Frame& frame) {
    constexpr float most_sway = 0.3f * settled_height;
    const double duration = motion.times.back();
    const glm::vec2 drift = frame.on_ground(motion.drift);
    const auto share = [&](std::size_t i) {
        return duration > 0 ? static_cast<float>(motion.times[i] / duration) : 0.0f;
    };
    const auto without_drift = [&](std::size_t i) { return frame.on_ground(motion.middles[i]) - share(i) * drift; };
    glm::vec2 mean(0.0f);
    for (std::size_t i = 0; i < motion.times.size(); ++i) mean += without_drift(i);
    mean /= static_cast<float>(motion.times.size());
    std::vector<glm::vec3> offsets;
    for (std::size_t i = 0; i < motion.times.size(); ++i) {
        const glm::vec2 sway = without_drift(i) - mean;
        const float far = glm::length(sway);
        const glm::vec2 excess = far > most_sway ? (1.0f - most_sway / far) * sway : glm::vec2(0.0f);
        offsets.push_back(over(-(mean + share(i) * drift + excess), -frame.scale * motion.floor()));
    }
    return offsets;
}

// Where somebody sits, of a body that faces +z [m].
struct Seat {
    float surface;  // y, over its own floor
    float back;     // z
};

// What the hindmost two fifths of the body below the shoulders, arms and knees apart, rest on: heads and hats may be as
// deep as the rest.
Seat find_seat(const model::Character& character, const Baked& sitting, const Frame& frame) {
    constexpr double most_under = 0.1, most_behind = 0.02;  // of the area
    constexpr float below_shoulders = 0.55f;
    const float floor = frame.scale * sitting.motion.floor();
    constexpr float hind = 0.4f, inner = 0.3f;  // of how long and how wide it is
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate(character, *sitting.clip, 0.5 * sitting.motion.times.back(), pose);
    motion::skin(character.mesh, pose, positions, normals);
    for (glm::vec3& position : positions) position = frame(position);
    struct Piece {
        glm::vec3 at;
        double area;
    };
    std::vector<Piece> pieces;
    const std::vector<std::uint32_t>& indices = character.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3 a = positions[indices[i]], b = positions[indices[i + 1]], c = positions[indices[i + 2]];
        const glm::vec3 middle = (a + b + c) / 3.0f;
        if (middle.y < floor + below_shoulders * frame.scale * sitting.motion.height())
            pieces.push_back({middle, glm::length(glm::dvec3(glm::cross(b - a, c - a)))});
    }
    const auto quantile = [](std::vector<Piece>& of, int axis, double share) {
        std::ranges::sort(of, {}, [axis](const Piece& piece) { return piece.at[axis]; });
        double total = 0, before = 0;
        for (const Piece& piece : of) total += piece.area;
        for (const Piece& piece : of)
            if ((before += piece.area) >= share * total) return piece.at[axis];
        return of.empty() ? 0.0f : of.back().at[axis];
    };
    const float back = quantile(pieces, 2, most_behind), front = quantile(pieces, 2, 1 - most_behind);
    const float left = quantile(pieces, 0, most_behind), right = quantile(pieces, 0, 1 - most_behind);
    std::vector<Piece> trunk;
    for (const Piece& piece : pieces) {
        const bool is_hind = piece.at.z < back + hind * (front - back);
        const bool is_inner = std::fabs(piece.at.x - 0.5f * (left + right)) < inner * (right - left);
        if (is_hind && is_inner) trunk.push_back(piece);
    }
    return {quantile(trunk, 1, most_under) - floor, back};
}

// Moves a clip's offsets so that the body rests on the seat of the stands.
void sit_down(const model::Character& character, const Baked& sitting, const Frame& frame,
              std::vector<glm::vec3>& offsets) {
    constexpr float back_of_person = -0.17f;  // [m] z of the built-in one
    const Seat seat = find_seat(character, sitting, frame);
    const float ahead = back_of_person - (seat.back + offsets[offsets.size() / 2].z);
    for (glm::vec3& offset : offsets) offset += glm::vec3(0, seat_height - seat.surface, ahead);
}

bool is_among(const std::vector<std::uint8_t>& clips, std::size_t index) {
    return std::ranges::find(clips, index) != clips.end();
}

// Excited people may stay seated or jump to their feet.
void take_seats(const model::Character& character, const CastMember& member, const std::vector<Baked>& all,
                const Frame& frame, std::vector<std::vector<glm::vec3>>& offsets) {
    constexpr float feet_ahead = 0.37f;  // [m] of the hips, as the built-in person stands up
    const Acts& acts = member.acts[static_cast<int>(Role::spectator)];
    const float sitting = all[acts.calm.front()].motion.height(), standing = all.front().motion.height();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const float height = all[i].motion.height();
        const bool is_calm = is_among(acts.calm, i);
        if (!is_calm && !is_among(acts.excited, i)) continue;
        if (is_calm || std::fabs(height - sitting) < std::fabs(height - standing))
            sit_down(character, all[i], frame, offsets[i]);
        else
            for (glm::vec3& offset : offsets[i]) offset.z += feet_ahead;
    }
}

// [m/s] of who is settled_height tall; empty if the clip doesn't say.
std::optional<float> speed_of(const BodyMotion& motion, const Frame& frame) {
    constexpr float slowest = 0.2f, fastest = 12.0f;
    const float speed = glm::length(frame.on_ground(motion.gait()));
    return speed >= slowest && speed <= fastest ? std::optional(speed) : std::nullopt;
}

// The same clip, but so many times as long.
model::Clip slowed(const model::Clip& clip, float factor) {
    model::Clip slow = clip;
    slow.name += ", slowed";
    slow.duration *= static_cast<double>(factor);
    for (model::Channel& channel : slow.channels) {
        for (float& time : channel.times) time *= factor;
        if (channel.interpolation != model::Interpolation::cubic_spline || channel.times.empty()) continue;
        const std::size_t part = channel.values.size() / channel.times.size() / 3;
        for (std::size_t i = 0; i < channel.values.size(); ++i)
            if (i / part % 3 != 1) channel.values[i] /= factor;  // tangents are per second
    }
    return slow;
}

void set_gaits(CastMember& member, const std::vector<Baked>& all, const Frame& frame) {
    for (const Role role : {Role::walker, Role::runner}) {
        const BodyMotion& motion = all[member.acts[static_cast<int>(role)].calm.front()].motion;
        if (const auto speed = speed_of(motion, frame)) member.gait_speed[static_cast<int>(role)] = *speed;
    }
}

// Gives who walks faster than anybody does a slower clip of their own to walk by, so that their feet don't slide
// either. Returns whether it did.
bool stroll(model::Character& character, Casting& casting) {
    constexpr float fastest_walk = 2.2f;  // [m/s] beyond it people run
    CastMember& member = casting.member;
    float& speed = member.gait_speed[static_cast<int>(Role::walker)];
    if (casting.clips.empty() || speed <= fastest_walk) return false;
    std::uint8_t& walk = member.acts[static_cast<int>(Role::walker)].calm.front();
    const model::Clip& fast = character.clips[static_cast<std::size_t>(casting.clips[walk])];
    if (!distance(Deed::walk, fast.name)) return false;
    model::Clip slow = slowed(fast, speed / fastest_walk);
    walk = static_cast<std::uint8_t>(casting.clips.size());
    casting.clips.push_back(static_cast<int>(character.clips.size()));
    character.clips.push_back(std::move(slow));
    speed = fastest_walk;
    return true;
}

double area_of(const model::Mesh& mesh, const std::vector<glm::vec3>& positions) {
    double twice = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(positions[mesh.indices[i]]), b(positions[mesh.indices[i + 1]]),
            c(positions[mesh.indices[i + 2]]);
        twice += glm::length(glm::cross(b - a, c - a));
    }
    return 0.5 * twice;
}

// Makes the mesh in its bind pose about as large as it will be: drawers take its triangles' areas for those that points
// were spread by. What is posed stays where it is.
void scale_bind_pose(model::Character& character, const Baked& standing, const Frame& frame) {
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    if (standing.clip)
        motion::evaluate(character, *standing.clip, 0, pose);
    else
        motion::evaluate_rest(character, pose);
    motion::skin(character.mesh, pose, positions, normals);
    const double bound = area_of(character.mesh, character.mesh.positions), posed = area_of(character.mesh, positions);
    const auto factor = static_cast<float>(static_cast<double>(frame.scale) * std::sqrt(posed / bound));
    if (!(factor > 0) || !std::isfinite(factor) || !std::isfinite(1 / factor)) return;
    for (glm::vec3& position : character.mesh.positions) position *= factor;
    for (model::MorphTarget& morph : character.mesh.morphs)
        for (glm::vec3& offset : morph.position_offsets) offset *= factor;
    for (model::PaletteEntry& entry : character.skeleton.palette)
        entry.inverse_bind = entry.inverse_bind * glm::scale(glm::mat4(1.0f), glm::vec3(1 / factor));
}

// Of all that is there the parent.
void add_root(model::Character& character, const Frame& frame, glm::vec3 at_rest) {
    model::Node root;
    root.name = "settled";
    root.rest.translation = at_rest;
    root.rest.rotation = glm::quat_cast(frame.turn);
    root.rest.scale = glm::vec3(frame.scale);
    root.rest_matrix = glm::translate(glm::mat4(1.0f), at_rest) * glm::mat4(frame.scale * frame.turn);
    root.rest_matrix[3][3] = 1.0f;
    model::Skeleton& skeleton = character.skeleton;
    for (model::Node& node : skeleton.nodes) ++node.parent;  // who had none has the new one, the first
    skeleton.nodes.insert(skeleton.nodes.begin(), root);
    for (model::PaletteEntry& entry : skeleton.palette) ++entry.node;
    for (model::MorphTarget& morph : character.mesh.morphs) ++morph.node;
    for (model::Clip& clip : character.clips)
        for (model::Channel& channel : clip.channels) ++channel.node;
}

void move_root(const BodyMotion& motion, const std::vector<glm::vec3>& offsets, model::Clip& clip) {
    model::Channel channel;
    channel.node = 0;
    channel.path = model::Path::translation;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        channel.times.push_back(static_cast<float>(motion.times[i]));
        for (int axis = 0; axis < 3; ++axis) channel.values.push_back(offsets[i][axis]);
    }
    clip.channels.push_back(std::move(channel));
}

}  // namespace

void settle(model::Character& character, Casting& casting, double turn) {
    add_stills(character, casting);
    casting.stills.clear();
    std::vector<Baked> all = measure_all(character, casting);
    const auto angle = static_cast<float>(turn * pi / 180);
    const Frame frame{settled_height / size_of(all.front().motion),
                      glm::mat3(glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0)))};
    if (!casting.clips.empty()) set_gaits(casting.member, all, frame);
    if (stroll(character, casting)) all = measure_all(character, casting);
    std::vector<std::vector<glm::vec3>> offsets;
    for (const Baked& one : all) offsets.push_back(staying(one.motion, frame));
    if (casting.member.sits) take_seats(character, casting.member, all, frame, offsets);
    scale_bind_pose(character, all.front(), frame);
    add_root(character, frame, offsets.front().front());
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].clip) move_root(all[i].motion, offsets[i], *all[i].clip);
}

}  // namespace scene
