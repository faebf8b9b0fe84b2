// What the person does: each clip is a function from time to a Figure (where hands, feet and trunk are), turned into
// joint rotations by two-bone inverse kinematics and sampled into keys.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "scene/person.h"
#include "scene/person_rig.h"

namespace scene {
namespace {

using glm::dquat;
using glm::dvec2;
using glm::dvec3;

constexpr double pi = std::numbers::pi;
constexpr double radians(double degrees) {
    return degrees * pi / 180.0;
}

// ---- A figure, and how it becomes joint rotations ----

// A turn of a joint against its parent [deg]: nod forward (+), turn to the left (+), lean to the right (+).
struct Turn {
    double nod = 0, turn = 0, lean = 0;
};

// Both arms and legs are described as if they were the left one: +x is outward.
struct Arm {
    dvec3 wrist;                    // [m] in model space
    dvec3 elbow{0.4, -0.3, -1.0};   // where the elbow points
    dvec3 fingers{0.0, -1.0, 0.0};  // where the fingers point
    dvec3 palm{-1.0, 0.0, 0.0};     // where the palm faces
    double shrug = 0, reach = 0;    // [deg] of the clavicle: up, forward
};

struct Leg {
    dvec3 ankle;                       // [m] in model space
    dvec3 knee{0.05, 0.0, 1.0};        // where the knee points
    double toes_up = 0, toes_out = 0;  // [deg]
};

struct Figure {
    dvec3 pelvis;  // [m] the hips joint
    Turn hips, spine, chest, neck, head;
    Arm arms[2];  // left, right
    Leg legs[2];
};

struct Solved {
    dvec3 position[joint_count];  // model space
    dquat world[joint_count];
};

constexpr dvec3 outward(const dvec3& v, int side) {
    return {side == 0 ? v.x : -v.x, v.y, v.z};
}

dquat about(const dvec3& axis, double degrees) {
    return glm::angleAxis(radians(degrees), axis);
}

dquat rotation(const Turn& t) {
    return about({0, 1, 0}, t.turn) * about({1, 0, 0}, t.nod) * about({0, 0, 1}, t.lean);
}

// Takes the orthogonalised pair (from, from_up) to (to, to_up).
dquat align(const dvec3& from, const dvec3& from_up, const dvec3& to, const dvec3& to_up) {
    const auto frame = [](const dvec3& along, const dvec3& up) {
        const dvec3 x = glm::normalize(along);
        const dvec3 z = glm::normalize(glm::cross(x, up));
        return glm::dmat3(x, glm::cross(z, x), z);
    };
    return glm::normalize(glm::quat_cast(frame(to, to_up) * glm::transpose(frame(from, from_up))));
}

// The part of `q` that turns about the unit vector `axis`, halved.
dquat half_twist(const dquat& q, const dvec3& axis) {
    const double along = glm::dot(dvec3(q.x, q.y, q.z), axis);
    const double angle = std::atan2(std::copysign(along, along * q.w), std::abs(q.w));
    return glm::angleAxis(angle, axis);
}

double bone_length(Joint from, Joint to) {
    return glm::distance(rest_joints[from].position, rest_joints[to].position);
}

void place(Solved& solved, Joint joint, const dquat& local) {
    const JointRest& rest = rest_joints[joint];
    const dvec3 offset = rest.position - rest_joints[rest.parent].position;
    solved.position[joint] = solved.position[rest.parent] + solved.world[rest.parent] * offset;
    solved.world[joint] = solved.world[rest.parent] * local;
}

void place_trunk(const Figure& figure, Solved& solved) {
    solved.position[hips] = figure.pelvis;
    solved.world[hips] = rotation(figure.hips);
    place(solved, spine, rotation(figure.spine));
    place(solved, chest, rotation(figure.chest));
    place(solved, neck, rotation(figure.neck));
    place(solved, head, rotation(figure.head));
    for (int side : {0, 1}) {
        const double sign = side == 0 ? 1.0 : -1.0;
        const Arm& arm = figure.arms[side];
        const Joint clavicle = side == 0 ? clavicle_l : clavicle_r;
        place(solved, clavicle, about({0, 0, 1}, sign * arm.shrug) * about({0, 1, 0}, -sign * arm.reach));
        place(solved, static_cast<Joint>(clavicle + 1), dquat(1, 0, 0, 0));
        place(solved, side == 0 ? thigh_l : thigh_r, dquat(1, 0, 0, 0));
    }
}

// Turns a straight limb (upper, its child, and that one's child) so that its end is at `target` and its middle joint
// points to `pole`. At rest the limb runs along `axis` and its middle joint would point to `rest_pole`.
void place_limb(Solved& solved, Joint upper, const dvec3& target, const dvec3& pole, const dvec3& rest_pole) {
    const auto lower = static_cast<Joint>(upper + 1), end = static_cast<Joint>(upper + 2);
    const dvec3 axis = rest_joints[end].position - rest_joints[upper].position;
    const double a = bone_length(upper, lower), b = bone_length(lower, end);
    // A joint that is all but stretched would snap: the knee moves infinitely fast there.
    constexpr double stretch_limit = 0.998;

    const dvec3 root = solved.position[upper];
    const dvec3 direct = glm::normalize(target - root);
    const double distance = std::min(glm::distance(target, root), stretch_limit * (a + b));
    const double cosine = std::clamp((a * a + distance * distance - b * b) / (2.0 * a * distance), -1.0, 1.0);
    const dvec3 bend = glm::normalize(pole - glm::dot(pole, direct) * direct);
    const dvec3 along_upper = cosine * direct + std::sqrt(1.0 - cosine * cosine) * bend;
    const dvec3 along_lower = (distance * direct - a * along_upper) / b;

    const dvec3 hinge = glm::cross(direct, bend);
    solved.world[upper] = align(axis, rest_pole, along_upper, glm::cross(hinge, along_upper));
    solved.world[lower] = align(axis, rest_pole, along_lower, glm::cross(hinge, along_lower));
    solved.position[lower] = root + a * along_upper;
    solved.position[end] = root + distance * direct;
}

void place_arm(const Arm& arm, int side, Solved& solved) {
    const Joint upper = side == 0 ? upper_arm_l : upper_arm_r;
    const auto lower = static_cast<Joint>(upper + 1), hand = static_cast<Joint>(upper + 2);
    place_limb(solved, upper, outward(arm.wrist, side), outward(arm.elbow, side), {0, 0, -1});

    const dvec3 axis = outward(rest_arm_axis(), side);
    const dvec3 rest_palm = -outward(rest_arm_outward(), side);
    solved.world[hand] = align(axis, rest_palm, outward(arm.fingers, side), outward(arm.palm, side));
    // Radius and ulna share the turn of the hand; without it the wrist would be wrung.
    solved.world[lower] =
        solved.world[lower] * half_twist(glm::inverse(solved.world[lower]) * solved.world[hand], axis);
}

void place_leg(const Leg& leg, int side, Solved& solved) {
    const Joint upper = side == 0 ? thigh_l : thigh_r;
    place_limb(solved, upper, outward(leg.ankle, side), outward(leg.knee, side), {0, 0, 1});
    const double sign = side == 0 ? 1.0 : -1.0;
    solved.world[upper + 2] = about({0, 1, 0}, sign * leg.toes_out) * about({1, 0, 0}, -leg.toes_up);
}

Solved solve(const Figure& figure) {
    Solved solved;
    place_trunk(figure, solved);
    for (int side : {0, 1}) {
        place_arm(figure.arms[side], side, solved);
        place_leg(figure.legs[side], side, solved);
    }
    return solved;
}

// ---- Curves ----

// 0 before `from`, 1 after `to`, with no velocity and no acceleration at either.
double rise(double t, double from, double to) {
    const double x = std::clamp((t - from) / (to - from), 0.0, 1.0);
    return x * x * x * (x * (6.0 * x - 15.0) + 10.0);
}

// Up during [a, b], down during [c, d].
double plateau(double t, double a, double b, double c, double d) {
    return rise(t, a, b) - rise(t, c, d);
}

// A wave of `cycles` in [a, b] that starts and ends at rest.
double ripple(double t, double a, double b, double cycles) {
    const double ease = 0.15 * (b - a);
    return plateau(t, a, a + ease, b - ease, b) * std::sin(2.0 * pi * cycles * std::clamp((t - a) / (b - a), 0.0, 1.0));
}

template <class T>
T blend(const T& a, const T& b, double share) {
    return a + (b - a) * share;
}

Arm blend(const Arm& a, const Arm& b, double share) {
    return {blend(a.wrist, b.wrist, share), blend(a.elbow, b.elbow, share), blend(a.fingers, b.fingers, share),
            blend(a.palm, b.palm, share),   blend(a.shrug, b.shrug, share), blend(a.reach, b.reach, share)};
}

// ---- Seated clips: offsets from one pose, all zero and at rest at both ends ----

constexpr double act_duration = 4.0;  // [s] of every spectator's clip

// Buttocks on the seat: half a thigh above it, less what a cushion of flesh gives.
constexpr double seated_pelvis = seat_height + 0.140;  // [m]

Figure seated() {
    Figure f;
    f.pelvis = {0.0, seated_pelvis, 0.0};
    f.hips = {-4, 0, 0};
    f.spine = {6, 0, 0};
    f.chest = {6, 0, 0};
    f.neck = {-2, 0, 0};
    f.head = {-4, 0, 0};
    for (int side : {0, 1}) {
        f.arms[side].wrist = {0.135, 0.640, 0.255};
        f.arms[side].elbow = {0.55, -0.2, -1.0};
        f.arms[side].fingers = {-0.25, -0.30, 1.0};
        f.arms[side].palm = {-0.15, -1.0, -0.2};
        f.legs[side].ankle = {0.120, ankle_height, 0.370};
        f.legs[side].knee = {0.12, 0.2, 1.0};
        f.legs[side].toes_out = 8;
    }
    return f;
}

Figure breathing(Figure f, double t) {
    const double breath = 0.5 - 0.5 * std::cos(2.0 * pi * 2.0 * t / act_duration);
    f.chest.nod -= 1.5 * breath;
    f.head.nod += 1.0 * breath;
    for (Arm& arm : f.arms) arm.shrug += 1.5 * breath;
    return f;
}

Figure sit(double t) {
    Figure f = breathing(seated(), t);
    const double left = plateau(t, 0.3, 0.9, 1.4, 2.0), right = plateau(t, 2.0, 2.7, 3.1, 3.8);
    f.neck.turn += 14 * left - 10 * right;
    f.head.turn += 16 * left - 12 * right;
    f.head.nod += 3 * right;
    f.chest.turn += 4 * left - 3 * right;
    f.pelvis.x += 0.008 * ripple(t, 0.2, 3.8, 1);
    f.spine.lean += 2 * ripple(t, 0.2, 3.8, 1);
    f.arms[1].wrist += dvec3(0.0, 0.012, -0.03) * plateau(t, 1.2, 1.7, 2.4, 2.9);
    // The left foot taps twice, on its heel.
    const double tap = plateau(t, 2.3, 2.5, 2.5, 2.7) + plateau(t, 2.7, 2.9, 2.9, 3.1);
    f.legs[0].toes_up = 9 * tap;
    f.legs[0].ankle.y += 0.007 * tap;
    return f;
}

Figure clap(double t) {
    Figure f = breathing(seated(), t);
    const double up = plateau(t, 0.1, 0.6, 3.3, 3.9);
    // Raised cosine, so that palms meet with a click and part slowly: 9 claps.
    const double swing = 0.5 - 0.5 * std::cos(2.0 * pi * 9.0 * std::clamp((t - 0.55) / 2.8, 0.0, 1.0));
    Arm clapping;
    clapping.wrist = {0.030 + 0.105 * swing, 1.020, 0.340};
    clapping.elbow = {1.0, -0.7, -0.4};
    clapping.fingers = {-0.02, 0.75, 0.65};
    clapping.palm = {-1.0, 0.0, 0.15};
    for (Arm& arm : f.arms) arm = blend(arm, clapping, up);
    f.chest.nod += 3 * up;
    f.head.nod += up * (-4 + 2 * swing);
    f.head.turn += 6 * ripple(t, 0.5, 3.5, 1);
    return f;
}

Figure wave(double t) {
    Figure f = breathing(seated(), t);
    const double up = plateau(t, 0.1, 0.9, 3.1, 3.9);
    const double swing = ripple(t, 0.8, 3.2, 4);
    Arm waving;
    waving.wrist = {0.300 + 0.10 * swing, 1.330, 0.100};
    waving.elbow = {1.0, -0.8, 0.0};
    waving.fingers = {0.10 + 0.55 * swing, 1.0, 0.05};
    waving.palm = {-0.1, 0.0, 1.0};
    waving.shrug = 12;
    f.arms[1] = blend(f.arms[1], waving, up);
    f.chest.lean -= 4 * up;
    f.head.lean -= 4 * up;
    f.head.turn -= 8 * up;
    return f;
}

Figure cheer(double t) {
    Figure f = seated();
    const double stood = plateau(t, 0.15, 0.85, 2.95, 3.75);
    const double leaning = plateau(t, 0.05, 0.40, 0.50, 0.85) + plateau(t, 2.95, 3.30, 3.45, 3.90);
    const double bounce = plateau(t, 0.80, 1.0, 2.7, 2.95) * 0.5 * (1.0 - std::cos(2.0 * pi * 3.0 * (t - 0.9) / 1.95));

    f.pelvis = blend(f.pelvis, dvec3(0.0, 0.945, 0.335), stood);
    f.pelvis.y -= 0.070 * bounce;
    f.pelvis.z += 0.060 * leaning - 0.03 * bounce;
    f.hips.nod += 26 * leaning + 4 * stood + 6 * bounce;
    f.spine.nod += 10 * leaning - 8 * stood;
    f.chest.nod += -10 * stood - 4 * bounce;
    f.head.nod += -12 * leaning - 6 * stood;

    Arm raised;
    raised.wrist = {0.380, 1.910 - 0.14 * bounce, 0.400};
    raised.elbow = {1.0, -0.2, 0.35};
    raised.fingers = {0.15, 1.0, 0.05};
    raised.palm = {-0.5, 0.0, 1.0};
    raised.shrug = 24;
    const double up = plateau(t, 0.30, 1.0, 2.75, 3.60);
    // The hands give way to the thighs that rise below them and to the chest that rises between them.
    const dvec3 detour = dvec3(0.0, 0.06, 0.0) * leaning + dvec3(0.10, -0.05, 0.26) * 4.0 * up * (1.0 - up);
    for (Arm& arm : f.arms) {
        arm = blend(arm, raised, up);
        arm.wrist += detour;
    }
    return f;
}

// ---- Standing and gaits ----

Figure stand(double t) {
    Figure f;
    const double phase = 2.0 * pi * t / act_duration;
    const double shift = std::sin(phase);
    f.pelvis = {0.012 * shift, 0.956, 0.0};
    f.hips = {0, 0, 1.2 * shift};
    f.spine = {1, 0, -1.2 * shift};
    f.chest = {2 + 0.8 * std::cos(2.0 * phase), 1.5 * shift, 0};
    f.neck = {2, 0, 0};
    f.head = {-4, 10 * std::sin(phase - 0.6), 0};
    for (int side : {0, 1}) {
        f.arms[side].wrist = {0.265 + 0.012 * (side == 0 ? shift : -shift), 0.895, 0.060};
        f.arms[side].elbow = {0.5, 0.0, -1.0};
        f.arms[side].fingers = {-0.05, -1.0, 0.18};
        f.arms[side].palm = {-1.0, 0.0, -0.25};
        f.legs[side].ankle = {0.105, ankle_height, 0.0};
        f.legs[side].knee = {0.10, 0.0, 1.0};
        f.legs[side].toes_out = 8;
    }
    return f;
}

// A number that changes with the phase of the step, for tables.
struct Key {
    double phase, value;
};

// A periodic curve with period 1 through `keys`: monotone between them (Fritsch and Butland 1984), so that what is
// flat in the table stays flat.
double periodic(std::span<const Key> keys, double phase) {
    const auto count = static_cast<int>(keys.size());
    const auto key = [&](int i) {
        const int turn = i < 0 ? -1 : i / count;
        return Key{keys[i - turn * count].phase + turn, keys[i - turn * count].value};
    };
    const auto slope = [&](int i) { return (key(i + 1).value - key(i).value) / (key(i + 1).phase - key(i).phase); };
    const auto tangent = [&](int i) {
        const double before = slope(i - 1), after = slope(i);
        return before * after <= 0.0 ? 0.0 : 2.0 * before * after / (before + after);
    };
    phase -= std::floor(phase);
    if (phase < keys[0].phase) phase += 1.0;
    int i = 0;
    while (i + 1 < count && keys[i + 1].phase <= phase) ++i;

    const double width = key(i + 1).phase - key(i).phase, x = (phase - key(i).phase) / width;
    const double h01 = x * x * (3.0 - 2.0 * x);
    return (1.0 - h01) * key(i).value + h01 * key(i + 1).value +
           width * x * (1.0 - x) * ((1.0 - x) * tangent(i) - x * tangent(i + 1));
}

// Where the ankle passes while the foot swings, from the hips' vertical.
struct Via {
    double phase, forward, height;  // [1], [m], [m]
};

// Phase 0 is the landing of the foot in question; the other foot is half a cycle later.
struct Gait {
    double speed, cycle;           // [m/s], [s] of two steps
    double stance;                 // [1] share of the cycle that a foot is on the ground
    double landing;                // [m] the ankle is ahead of the hips' vertical then, were it flat on the ground
    double step_width;             // [m] of an ankle from the middle
    std::span<const Key> toes_up;  // [deg]
    std::span<const Via> swing;
    double height, bob, bob_phase;    // [m] of the hips joint, its amplitude, and where it is highest
    double sway, hip_turn, hip_drop;  // [m], [deg], [deg]
    double lean;                      // [deg] of the trunk
    double arm_swing, arm_bias;       // [deg] of the upper arm, forward
    double elbow, elbow_swing;        // [deg]
};

// The ankle, when the foot is pitched and its sole rolls without slipping: ahead of where it would be with the foot
// flat on the ground, and its height.
dvec2 rolled_ankle(double toes_up) {
    const bool on_heel = toes_up >= 0.0;
    dvec2 pivot = on_heel ? sole.heel : sole.ball;
    const dvec2 next = on_heel ? sole.heel_back : sole.toe;
    dvec2 ground(pivot.x, 0.0);
    const double angle = radians(toes_up);
    const dvec2 edge = next - pivot;
    if (std::abs(angle) > std::atan2(edge.y, std::abs(edge.x))) {
        ground.x += std::copysign(glm::length(edge), edge.x);
        pivot = next;
    }
    return ground - dvec2(std::cos(angle) * pivot.x - std::sin(angle) * pivot.y,
                          std::sin(angle) * pivot.x + std::cos(angle) * pivot.y);
}

// A foot moves with the ground for this share of the cycle before it lands and after it leaves, as it comes down and
// goes up: near the ground it never slides.
constexpr double hover = 0.03;
constexpr double hover_height = 0.018;  // [m] at the far end

// For phases in [-hover, stance + hover].
dvec2 stance_ankle(const Gait& gait, double phase) {
    const double off_ground = std::max({-phase, phase - gait.stance, 0.0}) / hover;
    return dvec2(gait.landing - gait.speed * gait.cycle * phase, hover_height * off_ground) +
           rolled_ankle(periodic(gait.toes_up, phase));
}

// Cubic Hermite between `a` and `b` at x in [0, 1].
dvec2 hermite(const dvec2& a, const dvec2& tangent_a, const dvec2& b, const dvec2& tangent_b, double x) {
    const double h01 = x * x * (3.0 - 2.0 * x);
    return blend(a, b, h01) + x * (1.0 - x) * ((1.0 - x) * tangent_a - x * tangent_b);
}

// Leaves and meets the ground's motion with the same velocity; Catmull-Rom between.
dvec2 swing_ankle(const Gait& gait, double phase) {
    constexpr double step = 1e-4;
    const double first = gait.stance + hover, last = 1.0 - hover;
    const auto count = static_cast<int>(gait.swing.size());
    const auto knot_phase = [&](int i) { return i == 0 ? first : i > count ? last : gait.swing[i - 1].phase; };
    const auto knot = [&](int i) {
        if (i == 0) return stance_ankle(gait, first);
        if (i > count) return stance_ankle(gait, last - 1.0);
        return dvec2(gait.swing[i - 1].forward, gait.swing[i - 1].height);
    };
    const auto tangent = [&](int i) {
        if (i == 0) return (knot(0) - stance_ankle(gait, first - step)) / step;
        if (i > count) return (stance_ankle(gait, last - 1.0 + step) - knot(i)) / step;
        return (knot(i + 1) - knot(i - 1)) / (knot_phase(i + 1) - knot_phase(i - 1));
    };
    int i = 0;
    while (i < count && knot_phase(i + 1) <= phase) ++i;
    const double width = knot_phase(i + 1) - knot_phase(i);
    return hermite(knot(i), width * tangent(i), knot(i + 1), width * tangent(i + 1), (phase - knot_phase(i)) / width);
}

Leg gait_leg(const Gait& gait, double phase) {
    phase -= std::floor(phase);
    const double since_landing = phase > 1.0 - hover ? phase - 1.0 : phase;
    const bool with_ground = since_landing < gait.stance + hover;
    const dvec2 ankle = with_ground ? stance_ankle(gait, since_landing) : swing_ankle(gait, phase);
    Leg leg;
    leg.ankle = {gait.step_width, ankle.y, ankle.x};
    leg.knee = {0.03, 0.0, 1.0};
    leg.toes_up = periodic(gait.toes_up, phase);
    leg.toes_out = 4;
    return leg;
}

// Swings against the leg of its own side.
Arm gait_arm(const Gait& gait, double phase, const dvec3& shoulder) {
    const double forward = -std::cos(2.0 * pi * phase);
    const double upper = radians(gait.arm_bias + gait.arm_swing * forward);
    const double lower = upper + radians(gait.elbow + gait.elbow_swing * forward);
    const auto direction = [](double angle, double out) {
        return glm::normalize(dvec3(out, -std::cos(angle), std::sin(angle)));
    };
    const double bent_inward = 0.10 - 0.25 * std::sin(lower - upper);
    const dvec3 along_upper = direction(upper, 0.20), along_lower = direction(lower, bent_inward);
    Arm arm;
    arm.wrist =
        shoulder + bone_length(upper_arm_l, forearm_l) * along_upper + bone_length(forearm_l, hand_l) * along_lower;
    arm.elbow = {0.35, -0.5 * std::sin(lower), -1.0};
    arm.fingers = along_lower;
    arm.palm = {-1.0, 0.0, -0.1};
    return arm;
}

Figure gait_figure(const Gait& gait, double phase) {
    const double angle = 2.0 * pi * phase;
    const double middle = 2.0 * pi * (phase - 0.5 * gait.stance);  // 0 when the left foot carries the body
    Figure f;
    f.pelvis = {gait.sway * std::cos(middle),
                gait.height + gait.bob * std::cos(2.0 * (angle - 2.0 * pi * gait.bob_phase)), 0.0};
    f.hips = {0.5 * gait.lean, -gait.hip_turn * std::cos(angle), gait.hip_drop * std::cos(middle)};
    f.spine = {0.3 * gait.lean, gait.hip_turn * std::cos(angle), -0.7 * gait.hip_drop * std::cos(middle)};
    f.chest = {0.2 * gait.lean, 1.1 * gait.hip_turn * std::cos(angle), -0.3 * gait.hip_drop * std::cos(middle)};
    f.neck = {-0.3 * gait.lean, -0.6 * gait.hip_turn * std::cos(angle), 0};
    f.head = {-0.5 * gait.lean, -0.5 * gait.hip_turn * std::cos(angle), 0};
    for (int side : {0, 1}) f.legs[side] = gait_leg(gait, phase + 0.5 * side);

    Solved trunk;
    place_trunk(f, trunk);
    for (int side : {0, 1})
        f.arms[side] =
            gait_arm(gait, phase + 0.5 * side, outward(trunk.position[side == 0 ? upper_arm_l : upper_arm_r], side));
    return f;
}

constexpr Key walk_toes_up[] = {{0.00, 20},  {0.09, 0},   {0.36, 0},  {0.50, -18},
                                {0.60, -42}, {0.66, -50}, {0.80, -8}, {0.90, 14}};
constexpr Via walk_swing[] = {{0.70, -0.330, 0.215}, {0.80, -0.030, 0.160}, {0.90, 0.230, 0.120}};
constexpr Gait walk_gait{.speed = walk_speed,
                         .cycle = 1.0,
                         .stance = 0.60,
                         .landing = 0.330,
                         .step_width = 0.070,
                         .toes_up = walk_toes_up,
                         .swing = walk_swing,
                         .height = 0.922,
                         .bob = 0.016,
                         .bob_phase = 0.30,
                         .sway = 0.018,
                         .hip_turn = 5,
                         .hip_drop = 3,
                         .lean = 3,
                         .arm_swing = 19,
                         .arm_bias = -4,
                         .elbow = 17,
                         .elbow_swing = 9};

constexpr Key run_toes_up[] = {{0.00, 6},   {0.04, 0},   {0.12, 0},  {0.28, -62},
                               {0.42, -95}, {0.60, -50}, {0.78, -5}, {0.92, 10}};
constexpr Via run_swing[] = {{0.42, -0.480, 0.480}, {0.58, -0.120, 0.470}, {0.74, 0.260, 0.320}, {0.88, 0.400, 0.170}};
constexpr Gait run_gait{.speed = run_speed,
                        .cycle = 0.7,
                        .stance = 0.28,
                        .landing = 0.270,
                        .step_width = 0.050,
                        .toes_up = run_toes_up,
                        .swing = run_swing,
                        .height = 0.915,
                        .bob = 0.032,
                        .bob_phase = 0.40,
                        .sway = 0.010,
                        .hip_turn = 9,
                        .hip_drop = 3,
                        .lean = 14,
                        .arm_swing = 36,
                        .arm_bias = -6,
                        .elbow = 92,
                        .elbow_swing = 8};

// ---- Keys ----

model::Channel empty_channel(int joint, model::Path path) {
    model::Channel channel;
    channel.node = joint;
    channel.path = path;
    return channel;
}

// `last` are the rotations of the key before, if there is one, and then of this one.
void append_key(model::Clip& clip, const Solved& solved, bool first, dquat (&last)[joint_count]) {
    for (int i = 0; i < 3; ++i) clip.channels[0].values.push_back(static_cast<float>(solved.position[hips][i]));
    for (int joint = 0; joint < joint_count; ++joint) {
        const int parent = rest_joints[joint].parent;
        dquat local = parent < 0 ? solved.world[joint] : glm::inverse(solved.world[parent]) * solved.world[joint];
        // Neighbouring keys on the same side of the 4-sphere: blends take the short way.
        if (first ? local.w < 0.0 : glm::dot(local, last[joint]) < 0.0) local = -local;
        last[joint] = local;
        for (double v : {local.x, local.y, local.z, local.w})
            clip.channels[joint + 1].values.push_back(static_cast<float>(v));
    }
}

// Keys of `figure` over [0, duration] at `rate` [1/s]; the last is the first again, bit by bit.
model::Clip sample(const std::string& name, double duration, double rate, const std::function<Figure(double)>& figure) {
    model::Clip clip;
    clip.name = name;
    clip.duration = duration;
    clip.channels.push_back(empty_channel(hips, model::Path::translation));
    for (int joint = 0; joint < joint_count; ++joint)
        clip.channels.push_back(empty_channel(joint, model::Path::rotation));

    const auto steps = static_cast<int>(std::lround(duration * rate));
    dquat last[joint_count];
    for (int step = 0; step <= steps; ++step) {
        const bool closing = step == steps;
        append_key(clip, solve(figure(closing ? 0.0 : step / rate)), step == 0, last);
        for (model::Channel& channel : clip.channels)
            channel.times.push_back(static_cast<float>(closing ? duration : step / rate));
    }
    return clip;
}

}  // namespace

std::vector<model::Clip> build_person_clips() {
    constexpr double act_rate = 30.0;   // [1/s] a dozen keys a clap
    constexpr double gait_rate = 60.0;  // [1/s] a running foot turns by 10 degrees in a sixtieth
    const auto gait = [](const Gait& g) { return [&g](double t) { return gait_figure(g, t / g.cycle); }; };
    return {
        sample("sit", act_duration, act_rate, sit),
        sample("clap", act_duration, act_rate, clap),
        sample("cheer", act_duration, act_rate, cheer),
        sample("wave", act_duration, act_rate, wave),
        sample("stand", act_duration, act_rate, stand),
        sample("walk", walk_gait.cycle, gait_rate, gait(walk_gait)),
        sample("run", run_gait.cycle, gait_rate, gait(run_gait)),
    };
}

}  // namespace scene
