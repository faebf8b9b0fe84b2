// The person's surface: closed lofts through rings of vertices, one table of rings a part. Parts overlap where they
// meet, as sleeves and shoes do. To change how people look, edit the tables.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <span>
#include <utility>

#include "scene/person_rig.h"

namespace scene {
namespace {

using motion::Mesh;
using motion::Tint;

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
    Tint tint;              // of the strip from here to the next ring
    double shade;           // baked ambient light, (0, 1]
    double front = 0;       // [m] pushes the foremost vertex out: nose and chin
    Joint side = hips;      // left joint that pulls at the ring's left, and its mirror image at the right ...
    double side_share = 0;  // ... by this share at the outermost vertices, none in the middle
};

// A right-handed frame: front x side = axis.
struct Frame {
    glm::dvec3 origin, axis, front, side;
};

struct Part {
    Frame frame;
    std::span<const Ring> rings;
    int segments;
    glm::u8vec3 color{255, 255, 255};  // where the tint carries none
};

// A vertex darkened after lofting: eyes and mouth.
struct Smudge {
    int ring, vertex;
    double shade;
};

constexpr Tint skin = Tint::skin, shirt = Tint::shirt, trousers = Tint::trousers, hair = Tint::hair;
constexpr Tint shoe = Tint::none;
constexpr glm::u8vec3 shoe_color{46, 44, 50};

// From the crotch up; heights above the ground, front = +z.
constexpr Ring torso_rings[] = {
    {0.830, -0.016, 0.085, 0.075, 0, 2.2, hips, hips, 0.0, trousers, 0.60},
    {0.900, -0.020, 0.155, 0.116, 0, 2.3, hips, hips, 0.0, trousers, 0.90},
    {0.985, -0.010, 0.160, 0.108, 0, 2.3, hips, hips, 0.0, trousers, 0.75},
    {0.985, -0.010, 0.168, 0.117, 0, 2.3, hips, spine, 0.1, shirt, 0.95},
    {1.065, -0.002, 0.150, 0.106, 0, 2.3, hips, spine, 0.7, shirt, 0.95},
    {1.150, 0.002, 0.143, 0.102, 0, 2.3, spine, chest, 0.3, shirt, 0.97},
    {1.250, 0.002, 0.157, 0.112, 0, 2.3, spine, chest, 0.8, shirt, 0.97},
    {1.335, -0.002, 0.170, 0.119, 0, 2.4, chest, chest, 0.0, shirt, 0.95, 0.0, clavicle_l, 0.15},
    {1.400, -0.012, 0.166, 0.108, 0, 2.4, chest, chest, 0.0, shirt, 1.00, 0.0, clavicle_l, 0.45},
    {1.450, -0.020, 0.132, 0.080, 0, 2.2, chest, chest, 0.0, shirt, 1.00, 0.0, clavicle_l, 0.50},
    {1.490, -0.020, 0.068, 0.062, 0, 2.0, chest, neck, 0.3, shirt, 0.85},
};

// From inside the collar up; heights above the ground, front = +z.
constexpr Ring head_rings[] = {
    {1.450, -0.022, 0.058, 0.056, 0, 2.0, chest, neck, 0.5, skin, 0.80},
    {1.530, -0.010, 0.053, 0.056, 0, 2.0, neck, head, 0.5, skin, 0.62},
    {1.556, 0.016, 0.050, 0.072, -24, 2.2, head, head, 0.0, skin, 0.80},
    {1.582, 0.018, 0.063, 0.084, -12, 2.2, head, head, 0.0, skin, 0.95},
    {1.622, 0.014, 0.071, 0.090, -4, 2.2, head, head, 0.0, skin, 1.00, 0.022},
    {1.652, 0.012, 0.074, 0.090, 0, 2.2, head, head, 0.0, skin, 1.00, 0.006},
    {1.695, 0.008, 0.074, 0.092, 0, 2.2, head, head, 0.0, skin, 1.00},
    {1.733, 0.000, 0.050, 0.066, 0, 2.0, head, head, 0.0, skin, 1.00},
};
constexpr Smudge face[] = {{5, 1, 0.45}, {5, 9, 0.45}, {3, 0, 0.72}};

// From the hairline, high at the forehead and low at the nape, up.
constexpr Ring hair_rings[] = {
    {1.638, -0.002, 0.080, 0.112, 31, 2.2, head, head, 0.0, hair, 0.85},
    {1.695, -0.002, 0.083, 0.108, 16, 2.2, head, head, 0.0, hair, 1.00},
    {1.735, -0.004, 0.064, 0.084, 8, 2.1, head, head, 0.0, hair, 1.00},
    {1.752, -0.006, 0.026, 0.036, 4, 2.0, head, head, 0.0, hair, 1.00},
};

// The left arm from inside the chest to the finger tips; from the shoulder, front = outward, width = front to back.
constexpr Ring arm_rings[] = {
    {-0.035, -0.072, 0.066, 0.052, -45, 2.0, clavicle_l, clavicle_l, 0.0, shirt, 0.90},
    {0.000, -0.014, 0.066, 0.052, -32, 2.0, clavicle_l, upper_arm_l, 0.45, shirt, 1.00},
    {0.052, -0.002, 0.062, 0.055, -12, 2.0, clavicle_l, upper_arm_l, 0.90, shirt, 0.97},
    {0.120, 0.000, 0.056, 0.053, 0, 2.0, upper_arm_l, upper_arm_l, 0.0, shirt, 0.95},
    {0.200, 0.000, 0.056, 0.054, 0, 2.0, upper_arm_l, upper_arm_l, 0.0, shirt, 0.90},
    {0.200, 0.000, 0.044, 0.042, 0, 2.0, upper_arm_l, upper_arm_l, 0.0, skin, 0.80},
    {0.280, 0.000, 0.040, 0.039, 0, 2.0, upper_arm_l, forearm_l, 0.30, skin, 0.97},
    {0.320, 0.000, 0.041, 0.038, 0, 2.0, upper_arm_l, forearm_l, 0.75, skin, 0.97},
    {0.375, 0.002, 0.043, 0.039, 0, 2.0, forearm_l, forearm_l, 0.0, skin, 1.00},
    {0.540, 0.000, 0.027, 0.021, 0, 2.2, forearm_l, hand_l, 0.40, skin, 0.97},
    {0.610, -0.004, 0.042, 0.017, 0, 2.6, hand_l, hand_l, 0.0, skin, 1.00},
    {0.680, -0.014, 0.037, 0.013, -10, 2.6, hand_l, hand_l, 0.0, skin, 1.00},
    {0.732, -0.028, 0.020, 0.007, -25, 2.4, hand_l, hand_l, 0.0, skin, 0.95},
};

// From inside the left palm to the tip.
constexpr Ring thumb_rings[] = {
    {0.000, 0.000, 0.015, 0.014, 0, 2.0, hand_l, hand_l, 0.0, skin, 0.95},
    {0.045, 0.000, 0.013, 0.012, 0, 2.0, hand_l, hand_l, 0.0, skin, 1.00},
    {0.075, -0.004, 0.007, 0.007, 0, 2.0, hand_l, hand_l, 0.0, skin, 1.00},
};

// The left leg from inside the pelvis to the hem; from the hip joint down, front = +z.
constexpr Ring leg_rings[] = {
    {0.000, -0.004, 0.084, 0.096, 0, 2.0, hips, thigh_l, 0.85, trousers, 0.85},
    {0.130, 0.002, 0.080, 0.090, 0, 2.0, thigh_l, thigh_l, 0.0, trousers, 0.92},
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

// Vertex `k` of `count` on the unit superellipse, stretched so that the polygon reaches 1 both ways: x = side, y =
// front. Vertices on the two sides are exact mirror images.
glm::dvec2 unit_ring(int k, int count, double squareness) {
    const auto raw = [&](double index) {
        const double angle = 2.0 * std::numbers::pi * index / count;
        const auto bulge = [&](double v) { return std::copysign(std::pow(std::abs(v), 2.0 / squareness), v); };
        return glm::dvec2(bulge(std::sin(angle)), bulge(std::cos(angle)));
    };
    glm::dvec2 reach(0.0);
    for (int i = 0; i < count; ++i) reach = glm::max(reach, glm::abs(raw(i)));

    const bool right = 2 * k > count;
    const glm::dvec2 v = raw(right ? count - k : k) / reach;
    if (k == 0 || 2 * k == count) return {0.0, v.y};
    return right ? glm::dvec2(-v.x, v.y) : v;
}

void add_influence(Mesh& mesh, int slot, Joint joint, double weight) {
    mesh.joints.back()[slot] = static_cast<std::uint16_t>(weight > 0.0 ? joint : 0);
    mesh.weights.back()[slot] = static_cast<float>(weight);
}

// The outer third of a ring belongs to its side joint, fading out towards the middle.
double side_share(const Ring& ring, double x) {
    const double t = std::clamp((std::abs(x) - 0.3) / 0.6, 0.0, 1.0);
    return ring.side_share * t * t * (3.0 - 2.0 * t);
}

void add_vertex(Mesh& mesh, const Part& part, const Ring& ring, Tint tint, int k) {
    const Frame& f = part.frame;
    const double tilt = ring.tilt * std::numbers::pi / 180.0;
    const glm::dvec3 front = std::cos(tilt) * f.front + std::sin(tilt) * f.axis;
    const glm::dvec2 unit = unit_ring(k, part.segments, ring.squareness);
    const double depth = unit.y * ring.half_depth + (k == 0 ? ring.front : 0.0);
    const glm::dvec3 centre = f.origin + ring.along * f.axis + ring.offset * f.front;
    mesh.positions.emplace_back(centre + unit.x * ring.half_width * f.side + depth * front);

    const double shade = 255.0 * ring.shade;
    const glm::dvec3 color = tint == Tint::none ? glm::dvec3(part.color) * ring.shade : glm::dvec3(shade);
    mesh.colors.emplace_back(glm::u8vec3(color + 0.5), std::uint8_t{255});
    mesh.tints.push_back(tint);

    const double side = side_share(ring, unit.x);
    mesh.joints.emplace_back(0);
    mesh.weights.emplace_back(0.0f);
    add_influence(mesh, 0, ring.a, (1.0 - ring.share_of_b) * (1.0 - side));
    add_influence(mesh, 1, ring.b, ring.share_of_b * (1.0 - side));
    add_influence(mesh, 2, unit.x > 0.0 ? ring.side : mirrored(ring.side), side);
}

// The strip between the ring of vertices that starts at `from` and the one that starts at `to`.
void add_strip(Mesh& mesh, std::uint32_t from, std::uint32_t to, std::uint32_t segments) {
    for (std::uint32_t k = 0; k < segments; ++k) {
        const std::uint32_t next = (k + 1) % segments;
        for (std::uint32_t index : {from + k, from + next, to + next, from + k, to + next, to + k})
            mesh.indices.push_back(index);
    }
}

// Closes the end whose ring starts at `ring`, zigzagging from the front vertex to the back.
void add_cap(Mesh& mesh, std::uint32_t ring, std::uint32_t segments, bool at_end) {
    const auto zigzag = [&](std::uint32_t i) { return ring + (i % 2 ? (i + 1) / 2 : (segments - i / 2) % segments); };
    for (std::uint32_t i = 0; i + 2 < segments; ++i) {
        const bool flip = (i % 2 == 1) == at_end;
        mesh.indices.push_back(zigzag(i));
        mesh.indices.push_back(zigzag(flip ? i + 2 : i + 1));
        mesh.indices.push_back(zigzag(flip ? i + 1 : i + 2));
    }
}

// Weighted by the angle of each face at the vertex (Thuermer and Wuethrich 1998), so that triangulation doesn't show.
// Vertices that were doubled for a change of material keep a hard edge.
void compute_normals(Mesh& mesh) {
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
    mesh.normals.clear();
    for (const glm::dvec3& sum : sums) mesh.normals.emplace_back(glm::normalize(sum));
}

Mesh loft(const Part& part, std::span<const Smudge> smudges = {}) {
    Mesh mesh;
    const auto segments = static_cast<std::uint32_t>(part.segments);
    const auto add_ring = [&](const Ring& ring, Tint tint) {
        const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
        for (int k = 0; k < part.segments; ++k) add_vertex(mesh, part, ring, tint, k);
        return first;
    };

    std::uint32_t last = add_ring(part.rings.front(), part.rings.front().tint);
    add_cap(mesh, last, segments, false);
    for (std::size_t i = 1; i < part.rings.size(); ++i) {
        const Ring& ring = part.rings[i];
        const Tint below = part.rings[i - 1].tint;
        const std::uint32_t first = add_ring(ring, below);
        for (const Smudge& smudge : smudges)
            if (smudge.ring == static_cast<int>(i)) {
                const auto dark = static_cast<std::uint8_t>(255.0 * smudge.shade);
                mesh.colors[first + smudge.vertex] = {dark, dark, dark, 255};
            }
        add_strip(mesh, last, first, segments);
        last = ring.tint == below ? first : add_ring(ring, ring.tint);
    }
    add_cap(mesh, last, segments, true);
    compute_normals(mesh);
    return mesh;
}

// The same part of the body's right side.
Mesh mirror(Mesh mesh) {
    for (glm::vec3& position : mesh.positions) position.x = -position.x;
    for (glm::vec3& normal : mesh.normals) normal.x = -normal.x;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        for (int slot = 0; slot < 4; ++slot)
            if (mesh.weights[v][slot] > 0.0f)
                mesh.joints[v][slot] = static_cast<std::uint16_t>(mirrored(static_cast<Joint>(mesh.joints[v][slot])));
    for (std::size_t first = 0; first < mesh.indices.size(); first += 3)
        std::swap(mesh.indices[first + 1], mesh.indices[first + 2]);
    return mesh;
}

void append(Mesh& mesh, const Mesh& part) {
    const auto base = static_cast<std::uint32_t>(mesh.vertex_count());
    const auto extend = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    extend(mesh.positions, part.positions);
    extend(mesh.normals, part.normals);
    extend(mesh.colors, part.colors);
    extend(mesh.tints, part.tints);
    extend(mesh.joints, part.joints);
    extend(mesh.weights, part.weights);
    for (const std::uint32_t index : part.indices) mesh.indices.push_back(base + index);
}

void append_pair(Mesh& mesh, const Mesh& left) {
    append(mesh, left);
    append(mesh, mirror(left));
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

Frame leg_frame() {
    return {rest_joints[thigh_l].position, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}};
}

Frame shoe_frame() {
    return {rest_joints[foot_l].position, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
}

}  // namespace

Mesh build_person_mesh() {
    Mesh mesh;
    append(mesh, loft({upright, torso_rings, 12}));
    append(mesh, loft({upright, head_rings, 10}, face));
    append(mesh, loft({upright, hair_rings, 10}));
    append_pair(mesh, loft({arm_frame(), arm_rings, 7}));
    append_pair(mesh, loft({thumb_frame(), thumb_rings, 3}));
    append_pair(mesh, loft({leg_frame(), leg_rings, 8}));
    append_pair(mesh, loft({shoe_frame(), shoe_rings, 7, shoe_color}));
    mesh.uvs.assign(mesh.vertex_count(), glm::vec2(0.0f));
    mesh.texture_ids.assign(mesh.vertex_count(), motion::no_texture);
    return mesh;
}

}  // namespace scene
