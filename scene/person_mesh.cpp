// The person's surface: closed lofts through rings of vertices, one table of rings a part. Parts overlap where they
// meet, as sleeves and shoes do. To change how people look, edit the tables.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "scene/person.h"
#include "scene/person_rig.h"

namespace scene {
namespace {

using model::Mesh;
using model::Slot;

// One cross-section of a part: a superellipse around the part's axis, and how it follows the skeleton.
struct Ring {
    double along;           // [m] on the part's axis, from its origin
    double offset;          // [m] of the centre, towards the part's front
    double half_width;      // [m] what the polygon reaches to either side
    double half_depth;      // [m] and to front and back
    double tilt;            // [deg] turns the front towards the end of the axis
    double squareness;      // exponent of the superellipse: 2 = ellipse, more = boxier
    Joint a, b;             // the joints it follows ...
    double share_of_b;      // ... and how they divide it
    Slot slot;              // of the strip from here to the next ring
    double shade;           // baked ambient light, (0, 1]
    double front = 0;       // [m] pushes the foremost vertex out: nose and chin
    Joint side = hips;      // left joint that pulls at the ring's left, and its mirror image at the right ...
    double side_share = 0;  // ... by this share at the outermost vertices, none in the middle
};

// A right-handed frame: front x side = axis.
struct Frame {
    glm::dvec3 origin, axis, front, side;
};

enum class Side { middle, left, right };

struct Part {
    Frame frame;
    std::span<const Ring> rings;
    int segments;
    Side side = Side::middle;          // tables are for the left, or for parts that have both
    glm::u8vec3 color{255, 255, 255};  // of what is in no slot
};

// The vertices of one ring, in order.
using Loop = std::vector<std::uint32_t>;

constexpr Slot skin = skin_slot, shirt = shirt_slot, trousers = trousers_slot, hair = hair_slot;
constexpr Slot shoe = model::no_slot, eye = model::no_slot;
constexpr glm::u8vec3 shoe_color{46, 44, 50};
constexpr glm::u8vec3 eye_color{40, 28, 24};

// From the hips up; heights above the ground, front = +z. Arms and legs grow out of it, see the openings below.
constexpr Ring torso_rings[] = {
    {0.868, -0.016, 0.168, 0.114, 0, 2.3, hips, hips, 0.0, trousers, 0.88, 0.0, thigh_l, 0.60},
    {0.930, -0.018, 0.165, 0.117, 0, 2.3, hips, hips, 0.0, trousers, 0.95, 0.0, thigh_l, 0.15},
    {0.985, -0.010, 0.158, 0.108, 0, 2.3, hips, hips, 0.0, trousers, 0.85},
    {0.985, -0.010, 0.168, 0.117, 0, 2.3, hips, spine, 0.1, shirt, 0.95},
    {1.065, -0.002, 0.148, 0.106, 0, 2.3, hips, spine, 0.7, shirt, 0.95},
    {1.150, 0.002, 0.142, 0.102, 0, 2.3, spine, chest, 0.3, shirt, 0.97},
    {1.240, 0.002, 0.154, 0.110, 0, 2.3, spine, chest, 0.8, shirt, 0.97},
    {1.325, 0.000, 0.164, 0.118, 0, 2.4, chest, chest, 0.0, shirt, 0.90, 0.0, clavicle_l, 0.35},
    {1.400, -0.010, 0.170, 0.108, 0, 2.4, chest, chest, 0.0, shirt, 1.00, 0.0, clavicle_l, 0.65},
    {1.458, -0.020, 0.140, 0.078, 0, 2.2, chest, chest, 0.0, shirt, 1.00, 0.0, clavicle_l, 0.70},
    {1.498, -0.020, 0.066, 0.060, 0, 2.0, chest, neck, 0.3, shirt, 0.85},
};
constexpr int torso_segments = 12;
constexpr int armpit_ring = 7;  // the opening for an arm goes from here two rings up
// The vertex between the legs.
constexpr Ring crotch{0.826, -0.014, 0.0, 0.0, 0, 2.0, hips, hips, 0.0, trousers, 0.60};

// From inside the collar up; heights above the ground, front = +z.
constexpr Ring head_rings[] = {
    {1.450, -0.022, 0.058, 0.056, 0, 2.0, chest, neck, 0.5, skin, 0.80},
    {1.530, -0.010, 0.053, 0.056, 0, 2.0, neck, head, 0.5, skin, 0.70},
    {1.556, 0.018, 0.050, 0.078, -22, 2.3, head, head, 0.0, skin, 0.80},
    {1.590, 0.017, 0.065, 0.085, -9, 2.2, head, head, 0.0, skin, 0.95},
    {1.618, 0.015, 0.070, 0.088, -4, 2.2, head, head, 0.0, skin, 1.00, 0.024},
    {1.654, 0.011, 0.074, 0.088, 0, 2.2, head, head, 0.0, skin, 0.95, 0.004},
    {1.695, 0.008, 0.074, 0.092, 0, 2.2, head, head, 0.0, skin, 1.00},
    {1.733, 0.000, 0.050, 0.066, 0, 2.0, head, head, 0.0, skin, 1.00},
};

// The left eye, from inside the skull forward.
constexpr Ring eye_rings[] = {
    {0.000, 0.000, 0.013, 0.008, 0, 2.0, head, head, 0.0, eye, 1.00},
    {0.020, 0.000, 0.012, 0.008, 0, 2.0, head, head, 0.0, eye, 1.00},
};

// The left ear, from inside the skull outward; front = down, where it is narrow.
constexpr Ring ear_rings[] = {
    {0.000, 0.000, 0.015, 0.026, 0, 2.0, head, head, 0.0, skin, 0.85},
    {0.022, -0.003, 0.016, 0.028, 0, 2.0, head, head, 0.0, skin, 1.00},
};

// From the hairline, high at the forehead and low at the nape, up.
constexpr Ring hair_rings[] = {
    {1.641, 0.010, 0.079, 0.111, 35, 2.2, head, head, 0.0, hair, 0.80},
    {1.695, -0.003, 0.082, 0.107, 17, 2.2, head, head, 0.0, hair, 1.00},
    {1.736, -0.006, 0.064, 0.084, 8, 2.1, head, head, 0.0, hair, 1.00},
    {1.752, -0.008, 0.026, 0.036, 4, 2.0, head, head, 0.0, hair, 1.00},
};

// The left arm from the opening in the torso to the finger tips; from the shoulder, front = outward and up, width =
// front to back.
constexpr Ring arm_rings[] = {
    {0.024, -0.008, 0.063, 0.056, -18, 2.1, clavicle_l, upper_arm_l, 0.50, shirt, 1.00},
    {0.095, -0.002, 0.059, 0.056, -5, 2.0, clavicle_l, upper_arm_l, 0.92, shirt, 0.97},
    {0.205, 0.000, 0.056, 0.054, 0, 2.0, upper_arm_l, upper_arm_l, 0.0, shirt, 0.90},
    {0.205, 0.000, 0.044, 0.042, 0, 2.0, upper_arm_l, upper_arm_l, 0.0, skin, 0.80},
    {0.280, 0.000, 0.040, 0.039, 0, 2.0, upper_arm_l, forearm_l, 0.30, skin, 0.97},
    {0.320, 0.000, 0.041, 0.038, 0, 2.0, upper_arm_l, forearm_l, 0.75, skin, 0.97},
    {0.375, 0.002, 0.043, 0.039, 0, 2.0, forearm_l, forearm_l, 0.0, skin, 1.00},
    {0.540, 0.000, 0.027, 0.021, 0, 2.2, forearm_l, hand_l, 0.40, skin, 0.97},
    {0.610, -0.004, 0.042, 0.017, 0, 2.6, hand_l, hand_l, 0.0, skin, 1.00},
    {0.680, -0.014, 0.037, 0.013, -10, 2.6, hand_l, hand_l, 0.0, skin, 1.00},
    {0.732, -0.028, 0.020, 0.007, -25, 2.4, hand_l, hand_l, 0.0, skin, 0.95},
};
constexpr int limb_segments = 8;  // as many as an opening has corners

// From inside the left palm to the tip.
constexpr Ring thumb_rings[] = {
    {0.000, 0.000, 0.015, 0.014, 0, 2.0, hand_l, hand_l, 0.0, skin, 0.95},
    {0.045, 0.000, 0.013, 0.012, 0, 2.0, hand_l, hand_l, 0.0, skin, 1.00},
    {0.075, -0.004, 0.007, 0.007, 0, 2.0, hand_l, hand_l, 0.0, skin, 1.00},
};

// The left leg from the opening in the torso to the hem; from the hip joint down, front = +z.
constexpr Ring leg_rings[] = {
    {0.135, 0.002, 0.081, 0.090, 0, 2.0, hips, thigh_l, 0.93, trousers, 0.90},
    {0.270, 0.004, 0.066, 0.075, 0, 2.0, thigh_l, thigh_l, 0.0, trousers, 0.97},
    {0.375, 0.004, 0.057, 0.062, 0, 2.0, thigh_l, shin_l, 0.12, trousers, 0.97},
    {0.420, 0.006, 0.055, 0.060, 0, 2.0, thigh_l, shin_l, 0.50, trousers, 0.97},
    {0.465, -0.002, 0.053, 0.057, 0, 2.0, thigh_l, shin_l, 0.88, trousers, 0.97},
    {0.560, -0.012, 0.055, 0.061, 0, 2.0, shin_l, shin_l, 0.0, trousers, 0.97},
    {0.700, -0.008, 0.047, 0.052, 0, 2.0, shin_l, shin_l, 0.0, trousers, 0.95},
    {0.825, -0.004, 0.048, 0.060, 0, 2.0, shin_l, shin_l, 0.0, trousers, 0.85},
};

// Centre and half height of a shoe's cross-section between its sole and its upper, both from the ankle.
constexpr Ring shoe_ring(glm::dvec2 ground, double upper, double half_width, double shade) {
    return {ground.x, 0.5 * (ground.y + upper), half_width, 0.5 * (upper - ground.y), 0, 2.8, foot_l, foot_l, 0.0, shoe,
            shade};
}

// The left shoe from heel to toe; from the ankle forward, front = up.
constexpr Ring shoe_rings[] = {
    shoe_ring(sole.heel_back, 0.000, 0.026, 0.90),
    shoe_ring(sole.heel, 0.025, 0.036, 0.95),
    shoe_ring({0.040, sole.ball.y}, 0.012, 0.040, 1.00),
    shoe_ring(sole.ball, -0.022, 0.048, 1.00),
    shoe_ring(sole.toe, -0.036, 0.026, 1.00),
};

// Vertex `k` of `count` on the unit superellipse, stretched so that the polygon reaches 1 to both sides, front and
// back: x = side, y = front. Vertices on the two sides are exact mirror images.
glm::dvec2 unit_ring(int k, int count, double squareness) {
    const auto raw = [&](int index) {
        const double angle = 2.0 * std::numbers::pi * index / count;
        const auto bulge = [&](double v) { return std::copysign(std::pow(std::abs(v), 2.0 / squareness), v); };
        return glm::dvec2(bulge(std::sin(angle)), bulge(std::cos(angle)));
    };
    double side = 0, back = 0;
    for (int i = 0; i < count; ++i) {
        side = std::max(side, raw(i).x);
        back = std::max(back, -raw(i).y);
    }
    const bool right = 2 * k > count;
    const glm::dvec2 v = raw(right ? count - k : k);
    const double x = k == 0 || 2 * k == count ? 0.0 : v.x / side;
    return {right ? -x : x, v.y < 0.0 ? v.y / back : v.y};
}

void add_influence(Mesh& mesh, int slot, Joint joint, double weight) {
    mesh.joints.back()[slot] = static_cast<std::uint16_t>(weight > 0.0 ? joint : 0);
    mesh.weights.back()[slot] = static_cast<float>(weight);
}

void add_influences(Mesh& mesh, const Part& part, const Ring& ring, double x) {
    // The outer parts of a ring belong to its side joint, fading out towards the middle.
    const double t = std::clamp((std::abs(x) - 0.3) / 0.6, 0.0, 1.0);
    const double side = ring.side_share * t * t * (3.0 - 2.0 * t);
    const auto own = [&](Joint joint) { return part.side == Side::right ? mirrored(joint) : joint; };
    mesh.joints.emplace_back(0);
    mesh.weights.emplace_back(0.0f);
    add_influence(mesh, 0, own(ring.a), (1.0 - ring.share_of_b) * (1.0 - side));
    add_influence(mesh, 1, own(ring.b), ring.share_of_b * (1.0 - side));
    add_influence(mesh, 2, x > 0.0 ? ring.side : mirrored(ring.side), side);
}

void add_vertex(Mesh& mesh, const Part& part, const Ring& ring, Slot slot, int k) {
    const Frame& f = part.frame;
    const double tilt = ring.tilt * std::numbers::pi / 180.0;
    const glm::dvec3 front = std::cos(tilt) * f.front + std::sin(tilt) * f.axis;
    const glm::dvec2 unit = unit_ring(k, part.segments, ring.squareness);
    const double depth = unit.y * ring.half_depth + (k == 0 ? ring.front : 0.0);
    const glm::dvec3 centre = f.origin + ring.along * f.axis + ring.offset * f.front;
    mesh.positions.emplace_back(centre + unit.x * ring.half_width * f.side + depth * front);
    const glm::dvec3 color = slot == model::no_slot ? glm::dvec3(part.color) : glm::dvec3(255.0);
    mesh.colors.emplace_back(glm::u8vec3(color * ring.shade + 0.5), std::uint8_t{255});
    mesh.slots.push_back(slot);
    add_influences(mesh, part, ring, unit.x);
}

Loop add_ring(Mesh& mesh, const Part& part, const Ring& ring, Slot slot) {
    Loop loop;
    for (int k = 0; k < part.segments; ++k) {
        loop.push_back(static_cast<std::uint32_t>(mesh.vertex_count()));
        add_vertex(mesh, part, ring, slot, k);
    }
    return loop;
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

// One quad of the strip between two rings. Diagonals of the two sides mirror each other, or the shading wouldn't.
void add_quad(Mesh& mesh, const Loop& from, const Loop& to, std::size_t k) {
    const std::size_t next = (k + 1) % from.size();
    const bool second_half = 2 * k + 1 > from.size();
    add_triangle(mesh, from[k], from[next], second_half ? to[k] : to[next]);
    add_triangle(mesh, second_half ? from[next] : from[k], to[next], to[k]);
}

// Closes the end of a loft, zigzagging from the front vertex to the back.
void add_cap(Mesh& mesh, const Loop& ring, bool at_end) {
    const std::size_t count = ring.size();
    const auto zigzag = [&](std::size_t i) { return ring[i % 2 ? (i + 1) / 2 : (count - i / 2) % count]; };
    for (std::size_t i = 0; i + 2 < count; ++i) {
        const bool flip = (i % 2 == 1) == at_end;
        add_triangle(mesh, zigzag(i), zigzag(flip ? i + 2 : i + 1), zigzag(flip ? i + 1 : i + 2));
    }
}

// The strip from one ring to the next.
struct Band {
    Loop lower, upper;
};

// Every ring of a part, twice where two slots meet.
std::vector<Band> add_rings(Mesh& mesh, const Part& part) {
    std::vector<Band> bands;
    Loop lower = add_ring(mesh, part, part.rings[0], part.rings[0].slot);
    for (std::size_t i = 1; i < part.rings.size(); ++i) {
        const Slot below = part.rings[i - 1].slot, above = part.rings[i].slot;
        const Loop upper = add_ring(mesh, part, part.rings[i], below);
        bands.push_back({lower, upper});
        lower = above == below ? upper : add_ring(mesh, part, part.rings[i], above);
    }
    return bands;
}

void add_bands(Mesh& mesh, const std::vector<Band>& bands) {
    for (const Band& band : bands)
        for (std::size_t k = 0; k < band.lower.size(); ++k) add_quad(mesh, band.lower, band.upper, k);
}

void add_part(Mesh& mesh, const Part& part) {
    const std::vector<Band> bands = add_rings(mesh, part);
    add_cap(mesh, bands.front().lower, false);
    add_bands(mesh, bands);
    add_cap(mesh, bands.back().upper, true);
}

// ---- The torso, and where the limbs grow out of it ----

// The segment of the torso's rings at the left or right shoulder.
constexpr std::size_t shoulder_segment(Side side) {
    return side == Side::left ? 3 : 9;
}

// Two bands high and two quads wide: eight corners, the topmost first and on around as an arm's rings go.
Loop shoulder_opening(const std::vector<Band>& torso, Side side) {
    const std::size_t k = shoulder_segment(side);
    const Loop &low = torso[armpit_ring].lower, &middle = torso[armpit_ring].upper,
               &high = torso[armpit_ring + 1].upper;
    return {high[k], high[k - 1], middle[k - 1], low[k - 1], low[k], low[k + 1], middle[k + 1], high[k + 1]};
}

bool in_opening(std::size_t band, std::size_t k) {
    if (band != armpit_ring && band != armpit_ring + 1) return false;
    const auto at = [&](Side side) { return k + 1 == shoulder_segment(side) || k == shoulder_segment(side); };
    return at(Side::left) || at(Side::right);
}

// Half the torso's lowest ring and the crotch: eight corners, the foremost first and on around as a leg's rings go.
Loop hip_opening(const Loop& lowest, std::uint32_t between, Side side) {
    const Loop& v = lowest;
    if (side == Side::left) return {v[1], v[0], between, v[6], v[5], v[4], v[3], v[2]};
    return {v[11], v[10], v[9], v[8], v[7], v[6], between, v[0]};
}

void add_limb(Mesh& mesh, const Part& limb, const Loop& opening) {
    std::vector<Band> bands = add_rings(mesh, limb);
    bands.insert(bands.begin(), {opening, bands.front().lower});
    add_bands(mesh, bands);
    add_cap(mesh, bands.back().upper, true);
}

// ---- Frames ----

constexpr glm::dvec3 to_right(glm::dvec3 v) {
    return {-v.x, v.y, v.z};
}

// The mirror image, right-handed like every frame. Rings are symmetric, so it's the side that may be turned over.
Frame mirrored_frame(const Frame& f) {
    return {to_right(f.origin), to_right(f.axis), to_right(f.front), -to_right(f.side)};
}

Frame on_side(const Frame& left, Side side) {
    return side == Side::right ? mirrored_frame(left) : left;
}

// Upright, with the ground as origin: what the tables of torso, head and hair are relative to.
constexpr Frame upright{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};

Frame arm_frame() {
    return {rest_joints[upper_arm_l].position, rest_arm_axis(), rest_arm_outward(), {0, 0, 1}};
}

// From the ball of the thumb forward, and down along the hand.
Frame thumb_frame() {
    constexpr double splay = 0.75;  // [rad] from the direction of the fingers
    const glm::dvec3 forward(0, 0, 1), along = rest_arm_axis(), outward = rest_arm_outward();
    const glm::dvec3 axis = std::cos(splay) * along + std::sin(splay) * forward;
    const glm::dvec3 origin = rest_joints[hand_l].position + 0.035 * along - 0.004 * outward + 0.016 * forward;
    return {origin, axis, outward, glm::cross(axis, outward)};
}

// Ears stand off the skull, backward.
constexpr Frame ear_frame{{0.062, 1.622, 0.010}, {0.8, 0, -0.6}, {0, -1, 0}, {-0.6, 0, -0.8}};

constexpr Frame eye_frame{{0.031, 1.648, 0.078}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};

Frame leg_frame() {
    return {rest_joints[thigh_l].position, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}};
}

Frame shoe_frame() {
    return {rest_joints[foot_l].position, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
}

// Torso, arms and legs: one closed surface.
void add_body(Mesh& mesh) {
    const Part trunk{upright, torso_rings, torso_segments};
    const std::vector<Band> torso = add_rings(mesh, trunk);
    for (std::size_t band = 0; band < torso.size(); ++band)
        for (std::size_t k = 0; k < torso_segments; ++k)
            if (!in_opening(band, k)) add_quad(mesh, torso[band].lower, torso[band].upper, k);
    add_cap(mesh, torso.back().upper, true);

    const auto between = static_cast<std::uint32_t>(mesh.vertex_count());
    add_vertex(mesh, trunk, crotch, trousers, 0);
    for (const Side side : {Side::left, Side::right}) {
        const Part arm{on_side(arm_frame(), side), arm_rings, limb_segments, side};
        const Part leg{on_side(leg_frame(), side), leg_rings, limb_segments, side};
        add_limb(mesh, arm, shoulder_opening(torso, side));
        add_limb(mesh, leg, hip_opening(torso.front().lower, between, side));
    }
}

// Weighted by the angle of each face at the vertex (Thuermer and Wuethrich 1998), so that triangulation doesn't show.
// Vertices that were doubled for a change of material keep a hard edge.
std::vector<glm::vec3> smooth_normals(const Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.vertex_count(), glm::dvec3(0.0));
    for (std::size_t first = 0; first < mesh.indices.size(); first += 3) {
        glm::dvec3 corner[3];
        for (int i = 0; i < 3; ++i) corner[i] = mesh.positions[mesh.indices[first + i]];
        const glm::dvec3 normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 to_next = glm::normalize(corner[(i + 1) % 3] - corner[i]);
            const glm::dvec3 to_last = glm::normalize(corner[(i + 2) % 3] - corner[i]);
            sums[mesh.indices[first + i]] += std::acos(std::clamp(glm::dot(to_next, to_last), -1.0, 1.0)) * normal;
        }
    }
    std::vector<glm::vec3> normals;
    for (const glm::dvec3& sum : sums) normals.emplace_back(glm::normalize(sum));
    return normals;
}

// Rings have vertices even where a limb opens them.
void drop_unused_vertices(Mesh& mesh) {
    std::vector<bool> used(mesh.vertex_count(), false);
    for (const std::uint32_t index : mesh.indices) used[index] = true;

    std::vector<std::uint32_t> moved_to(mesh.vertex_count());
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!used[v]) continue;
        mesh.positions[kept] = mesh.positions[v];
        mesh.colors[kept] = mesh.colors[v];
        mesh.slots[kept] = mesh.slots[v];
        mesh.joints[kept] = mesh.joints[v];
        mesh.weights[kept] = mesh.weights[v];
        moved_to[v] = kept++;
    }
    for (std::uint32_t& index : mesh.indices) index = moved_to[index];
    mesh.positions.resize(kept);
    mesh.colors.resize(kept);
    mesh.slots.resize(kept);
    mesh.joints.resize(kept);
    mesh.weights.resize(kept);
}

}  // namespace

Mesh build_person_mesh() {
    Mesh mesh;
    add_body(mesh);
    add_part(mesh, {upright, head_rings, 10});
    add_part(mesh, {upright, hair_rings, 10});
    for (const Side side : {Side::left, Side::right}) {
        add_part(mesh, {on_side(eye_frame, side), eye_rings, 4, side, eye_color});
        add_part(mesh, {on_side(ear_frame, side), ear_rings, 3, side});
        add_part(mesh, {on_side(thumb_frame(), side), thumb_rings, 3, side});
        add_part(mesh, {on_side(shoe_frame(), side), shoe_rings, 7, side, shoe_color});
    }
    drop_unused_vertices(mesh);
    mesh.normals = smooth_normals(mesh);
    mesh.uvs.assign(mesh.vertex_count(), glm::vec2(0.0f));
    mesh.materials.resize(1);
    mesh.material_ids.assign(mesh.vertex_count(), 0);
    return mesh;
}

}  // namespace scene
