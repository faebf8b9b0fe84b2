#include "scene/person.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "motion/pose.h"
#include "tests/scene/posed_person.h"

namespace {

using namespace tests;

using model::Character;
using model::Clip;
using model::Mesh;

// One representative a triangle: triangles with a welded vertex in common are one part.
std::vector<std::uint32_t> parts(const Mesh& mesh) {
    const std::vector<std::uint32_t> weld = welded(mesh);
    std::vector<std::uint32_t> parent(weld.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) v = parent[v];
        return v;
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (int corner : {1, 2}) parent[root(weld[mesh.indices[i + corner]])] = root(weld[mesh.indices[i]]);
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) result.push_back(root(weld[mesh.indices[i]]));
    return result;
}

// ---- The surface ----

TEST(Person, HasTheTrianglesAndJointsPromised) {
    EXPECT_GE(person().mesh.triangle_count(), 1000u);
    EXPECT_LE(person().mesh.triangle_count(), 1300u);
    EXPECT_GE(person().skeleton.nodes.size(), 18u);
    EXPECT_LE(person().skeleton.nodes.size(), 22u);
}

TEST(Person, FillsEveryVertexArray) {
    const Mesh& mesh = person().mesh;
    const std::size_t count = mesh.vertex_count();
    EXPECT_EQ(mesh.normals.size(), count);
    EXPECT_EQ(mesh.uvs.size(), count);
    EXPECT_EQ(mesh.colors.size(), count);
    EXPECT_EQ(mesh.slots.size(), count);
    EXPECT_EQ(mesh.material_ids.size(), count);
    EXPECT_EQ(mesh.joints.size(), count);
    EXPECT_EQ(mesh.weights.size(), count);
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, count);
}

TEST(Person, EveryEdgeHasOneTriangleOnEachSide) {
    const Mesh& mesh = person().mesh;
    const std::vector<std::uint32_t> weld = welded(mesh);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t corner = 0; corner < 3; ++corner)
            ++directed[{weld[mesh.indices[i + corner]], weld[mesh.indices[i + (corner + 1) % 3]]}];
    for (const auto& [edge, count] : directed) {
        EXPECT_NE(edge.first, edge.second);
        EXPECT_EQ(count, 1) << edge.first << " to " << edge.second;
        EXPECT_TRUE(directed.contains({edge.second, edge.first})) << edge.first << " to " << edge.second;
    }
}

TEST(Person, EveryPartIsWoundOutward) {
    const Mesh& mesh = person().mesh;
    const std::vector<std::uint32_t> part = parts(mesh);
    std::map<std::uint32_t, double> volume;
    for (std::size_t t = 0; t < part.size(); ++t)
        volume[part[t]] += glm::dot(mesh.positions[mesh.indices[3 * t]], face_cross(mesh, 3 * t)) / 6.0;
    EXPECT_GE(volume.size(), 2u);
    for (const auto& [representative, cubic_metres] : volume) EXPECT_GT(cubic_metres, 0.0) << representative;
}

TEST(Person, HasNoSlivers) {
    constexpr float smallest = 1e-6f;  // [m^2] 1 mm^2: less would be a degenerate triangle by mistake
    for (std::size_t i = 0; i < person().mesh.indices.size(); i += 3)
        EXPECT_GT(0.5f * glm::length(face_cross(person().mesh, i)), smallest) << i / 3;
}

TEST(Person, NormalsAreUnitAndOnTheirFacesOuterSide) {
    const Mesh& mesh = person().mesh;
    constexpr float unit_tolerance = 1e-5f;  // float rounding
    for (const glm::vec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1.0f, unit_tolerance);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t corner = 0; corner < 3; ++corner)
            EXPECT_GT(glm::dot(glm::normalize(face_cross(mesh, i)), mesh.normals[mesh.indices[i + corner]]), 0.0f)
                << "triangle " << i / 3;
}

TEST(Person, WeightsSumToOneOverKnownJoints) {
    const Mesh& mesh = person().mesh;
    constexpr float tolerance = 1e-6f;  // float rounding of up to three shares
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        float sum = 0;
        for (int slot = 0; slot < 4; ++slot) {
            EXPECT_GE(mesh.weights[v][slot], 0.0f);
            EXPECT_LT(mesh.joints[v][slot], person().skeleton.palette.size());
            sum += mesh.weights[v][slot];
        }
        EXPECT_NEAR(sum, 1.0f, tolerance) << v;
    }
}

TEST(Person, WearsEverySlot) {
    for (const model::Slot slot :
         {model::no_slot, scene::skin_slot, scene::hair_slot, scene::shirt_slot, scene::trousers_slot})
        EXPECT_GT(std::count(person().mesh.slots.begin(), person().mesh.slots.end(), slot), 0);
}

TEST(Person, Stands175CentimetresTallOnTheGround) {
    constexpr float tolerance = 0.01f;  // [m] what a hairstyle may do
    const motion::Bounds box = motion::bounds_of(person().mesh.positions);
    EXPECT_NEAR(box.min.y, 0.0f, 1e-6f);
    EXPECT_NEAR(box.max.y, 1.75f, tolerance);
}

TEST(Person, IsItsOwnMirrorImageAtRest) {
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::vector<glm::vec3> left = person().mesh.positions, right = left;
    for (glm::vec3& p : right) p.x = 0.0f - p.x;
    std::sort(left.begin(), left.end(), less);
    std::sort(right.begin(), right.end(), less);
    for (std::size_t i = 0; i < left.size(); ++i) EXPECT_EQ(left[i], right[i]);
}

TEST(Person, RestPoseIsTheMeshItself) {
    constexpr float tolerance = 1e-6f;  // [m] float rounding along a chain of joints
    motion::Pose pose;
    std::vector<glm::vec3> positions, normals;
    motion::evaluate_rest(person(), pose);
    motion::skin(person().mesh, pose, positions, normals);
    for (std::size_t v = 0; v < positions.size(); ++v)
        EXPECT_LT(glm::distance(positions[v], person().mesh.positions[v]), tolerance) << v;
}

TEST(Person, IsTheSameEveryTime) {
    const Character again = scene::make_person();
    EXPECT_EQ(again.mesh.positions, person().mesh.positions);
    EXPECT_EQ(again.mesh.normals, person().mesh.normals);
    EXPECT_EQ(again.mesh.indices, person().mesh.indices);
    for (std::size_t i = 0; i < person().clips.size(); ++i)
        for (std::size_t channel = 0; channel < person().clips[i].channels.size(); ++channel)
            EXPECT_EQ(again.clips[i].channels[channel].values, person().clips[i].channels[channel].values);
}

// ---- All clips ----

TEST(Person, HasItsClips) {
    std::vector<std::string> names;
    for (const Clip& clip : person().clips) names.push_back(clip.name);
    EXPECT_EQ(names, (std::vector<std::string>{"sit", "clap", "cheer", "wave", "stand", "walk", "run"}));
    for (const std::string& name : seated_clips) EXPECT_EQ(clip_named(name).duration, 4.0) << name;
    EXPECT_EQ(clip_named("stand").duration, 4.0);
}

TEST(Person, ChannelsSpanTheirClip) {
    for (const Clip& clip : person().clips)
        for (const model::Channel& channel : clip.channels) {
            ASSERT_FALSE(channel.times.empty());
            EXPECT_EQ(channel.times.front(), 0.0f) << clip.name;
            EXPECT_EQ(channel.times.back(), static_cast<float>(clip.duration)) << clip.name;
            EXPECT_TRUE(std::is_sorted(channel.times.begin(), channel.times.end())) << clip.name;
            EXPECT_EQ(channel.values.size(), channel.times.size() * (channel.path == model::Path::rotation ? 4 : 3));
        }
}

TEST(Person, LoopsCloseBitByBit) {
    for (const Clip& clip : person().clips)
        for (const model::Channel& channel : clip.channels) {
            const std::size_t width = channel.values.size() / channel.times.size();
            EXPECT_TRUE(
                std::equal(channel.values.begin(), channel.values.begin() + width, channel.values.end() - width))
                << clip.name << ' ' << person().skeleton.nodes[channel.node].name;
        }
}

TEST(Person, RotationsAreUnitAndNeverJump) {
    constexpr float unit_tolerance = 1e-6f;   // float rounding
    constexpr float smallest_cosine = 0.94f;  // 40 degrees a key: a slip of the kinematics would turn by 90 or more
    for (const Clip& clip : person().clips)
        for (const model::Channel& channel : clip.channels) {
            if (channel.path != model::Path::rotation) continue;
            const auto* q = reinterpret_cast<const glm::vec4*>(channel.values.data());
            for (std::size_t key = 0; key < channel.times.size(); ++key)
                EXPECT_NEAR(glm::length(q[key]), 1.0f, unit_tolerance);
            for (std::size_t key = 1; key < channel.times.size(); ++key)
                EXPECT_GT(glm::dot(q[key - 1], q[key]), smallest_cosine)
                    << clip.name << ' ' << person().skeleton.nodes[channel.node].name << " at " << channel.times[key];
        }
}

// How often the surface of `triangles` winds around `point` (Jacobson et al. 2013): 1 inside, 0 outside, and in
// between near holes.
double winding_number(const glm::vec3& point, const std::vector<glm::vec3>& positions,
                      const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    double solid_angle = 0;
    for (const auto& triangle : triangles) {
        const glm::dvec3 a(positions[triangle[0]] - point), b(positions[triangle[1]] - point),
            c(positions[triangle[2]] - point);
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        solid_angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return solid_angle / (4.0 * 3.14159265358979);
}

TEST(Person, HandsStayOutOfTheBody) {
    constexpr double look_every = 1.0 / 15.0;  // [s]
    constexpr double inside = 0.5;
    const Mesh& mesh = person().mesh;
    const auto moved_by_arm = [&](std::uint32_t v) {
        for (int slot = 0; slot < 4; ++slot)
            if (mesh.weights[v][slot] > 0.0f &&
                person().skeleton.nodes[mesh.joints[v][slot]].name.find("arm_") != std::string::npos)
                return true;
        return false;
    };
    const auto hands = [&] {
        std::vector<std::size_t> both = vertices_of("hand_l");
        for (const std::size_t v : vertices_of("hand_r")) both.push_back(v);
        return both;
    }();
    std::vector<std::array<std::uint32_t, 3>> body;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::array triangle{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        const bool of_hand = std::find(hands.begin(), hands.end(), triangle[0]) != hands.end();
        if (!of_hand && std::none_of(triangle.begin(), triangle.end(), moved_by_arm)) body.push_back(triangle);
    }
    for (const Clip& clip : person().clips)
        for (double t = 0; t < clip.duration; t += look_every) {
            const auto positions = posed(clip, t);
            for (const std::size_t v : hands)
                ASSERT_LT(winding_number(positions[v], positions, body), inside) << clip.name << " at " << t;
        }
}

TEST(Person, NothingEverSinksIntoTheGround) {
    constexpr float deepest = -0.02f;  // [m] the grass is that high
    for (const Clip& clip : person().clips)
        for_every_instant(clip, [&](double t) {
            ASSERT_GE(motion::bounds_of(posed(clip, t)).min.y, deepest) << clip.name << " at " << t;
        });
}

TEST(Person, KneesBendBackwardAndElbowsForward) {
    constexpr float tolerance = 0.01f;  // [m] of a shin or forearm on the wrong side of the joint
    for (const Clip& clip : person().clips)
        for_every_instant(clip, [&](double t) {
            motion::Pose pose;
            motion::evaluate(person(), clip, t, pose);
            for (const char* side : {"_l", "_r"}) {
                const auto tip = [&](const char* limb, const char* end) {
                    const glm::mat4& root = pose.world[node_named(std::string(limb) + side)];
                    const glm::vec3 knee(pose.world[node_named(std::string(end) + side)][3]);
                    return glm::vec3(glm::inverse(root) * glm::vec4(knee, 1.0f));
                };
                const glm::vec3 ankle = tip("thigh", "foot"), wrist = tip("upper_arm", "hand");
                ASSERT_LT(ankle.z, tolerance) << clip.name << side << " at " << t;
                ASSERT_GT(wrist.z, -tolerance) << clip.name << side << " at " << t;
            }
        });
}

// ---- Seated clips ----

TEST(Person, SeatedClipsShareTheirFirstAndLastPose) {
    const Clip& sit = clip_named("sit");
    for (const std::string& name : seated_clips) {
        const Clip& clip = clip_named(name);
        ASSERT_EQ(clip.channels.size(), sit.channels.size());
        for (std::size_t i = 0; i < sit.channels.size(); ++i) {
            ASSERT_EQ(clip.channels[i].node, sit.channels[i].node);
            ASSERT_EQ(clip.channels[i].path, sit.channels[i].path);
            const auto& a = sit.channels[i].values;
            const auto& b = clip.channels[i].values;
            const std::size_t width = a.size() / sit.channels[i].times.size();
            EXPECT_TRUE(std::equal(a.begin(), a.begin() + width, b.begin())) << name;
            EXPECT_TRUE(std::equal(a.begin(), a.begin() + width, b.end() - width)) << name;
        }
    }
}

TEST(Person, SeatedClipsStartAndEndAtRest) {
    constexpr float fastest = 0.03f;  // [m/s] a viewer doesn't see 0.5 mm a frame
    constexpr double frame = 1.0 / 60.0;
    for (const std::string& name : seated_clips) {
        const Clip& clip = clip_named(name);
        const auto still = posed(clip, 0.0), first = posed(clip, frame), last = posed(clip, clip.duration - frame);
        for (std::size_t v = 0; v < still.size(); ++v) {
            EXPECT_LT(glm::distance(still[v], first[v]) / frame, fastest) << name;
            EXPECT_LT(glm::distance(still[v], last[v]) / frame, fastest) << name;
        }
    }
}

TEST(Person, SitsOnTheSeatWithFeetOnTheFloor) {
    constexpr float give = 0.03f;  // [m] flesh and cushion
    float lowest_on_seat = 1.0f, lowest = 1.0f;
    for (const glm::vec3& p : posed(clip_named("sit"), 0.0)) {
        lowest = std::min(lowest, p.y);
        if (p.z < 0.2f) lowest_on_seat = std::min(lowest_on_seat, p.y);
    }
    EXPECT_NEAR(lowest_on_seat, scene::seat_height, give);
    EXPECT_NEAR(lowest, 0.0f, 1e-3f);
    const auto joints = joints_at(clip_named("sit"), 0.0);
    EXPECT_NEAR(joints[node_named("hips")].x, 0.0f, 1e-6f);
    EXPECT_NEAR(joints[node_named("hips")].z, 0.0f, 1e-6f);
    EXPECT_GT(joints[node_named("foot_l")].z, 0.3f);
}

TEST(Person, SittersStayOnTheirSeatUnlessTheyCheer) {
    constexpr float fidget = 0.02f;  // [m]
    for (const char* name : {"sit", "clap", "wave"}) {
        const glm::vec3 seated = joints_at(clip_named(name), 0.0)[node_named("hips")];
        for_every_instant(clip_named(name), [&](double t) {
            ASSERT_LT(glm::distance(joints_at(clip_named(name), t)[node_named("hips")], seated), fidget) << name;
        });
    }
}

TEST(Person, ClappingHandsMeetAndPart) {
    constexpr float touching = 0.02f;  // [m] between the palms, either way
    constexpr float apart = 0.12f;     // [m]
    const std::vector<std::size_t> left = vertices_of("hand_l"), right = vertices_of("hand_r");
    int meetings = 0;
    bool was_apart = true;
    float nearest = 1.0f;
    for_every_instant(clip_named("clap"), [&](double t) {
        const auto positions = posed(clip_named("clap"), t);
        float gap = 1.0f, overlap = -1.0f;
        for (const std::size_t v : left) gap = std::min(gap, positions[v].x);
        for (const std::size_t v : right) overlap = std::max(overlap, positions[v].x);
        gap -= overlap;
        nearest = std::min(nearest, gap);
        if (gap > apart) was_apart = true;
        if (gap < touching && was_apart) {
            ++meetings;
            was_apart = false;
        }
    });
    EXPECT_GE(meetings, 5);
    EXPECT_GT(nearest, -touching);
}

TEST(Person, CheersOnItsFeetWithBothArmsUp) {
    bool arms_up = false;
    for_every_instant(clip_named("cheer"), [&](double t) {
        const auto joints = joints_at(clip_named("cheer"), t);
        const float head = joints[node_named("head")].y;
        const bool standing = joints[node_named("hips")].y > 0.9f;
        arms_up |=
            standing && joints[node_named("hand_l")].y > head + 0.2f && joints[node_named("hand_r")].y > head + 0.2f;
    });
    EXPECT_TRUE(arms_up);
}

TEST(Person, WavesWithOneArm) {
    float highest_left = -1, highest_right = -1;  // [m] above the shoulder
    for_every_instant(clip_named("wave"), [&](double t) {
        const auto joints = joints_at(clip_named("wave"), t);
        const float shoulder = joints[node_named("upper_arm_r")].y;
        highest_left = std::max(highest_left, joints[node_named("hand_l")].y - shoulder);
        highest_right = std::max(highest_right, joints[node_named("hand_r")].y - shoulder);
    });
    EXPECT_GT(highest_right, 0.15f);
    EXPECT_LT(highest_left, 0.0f);
}

// ---- Gaits ----

struct Contact {
    float height;  // [m] of the shoe's lowest vertex
    float speed;   // [m/s] of that vertex, backward
};

// Of one shoe, from the motion of its lowest vertex over a fine step.
Contact contact(const Clip& clip, const std::vector<std::size_t>& shoe, double t) {
    constexpr double half = 0.5 * fine_step;
    const auto wrap = [&](double time) { return time - clip.duration * std::floor(time / clip.duration); };
    const auto before = posed(clip, wrap(t - half)), now = posed(clip, t), after = posed(clip, wrap(t + half));
    const std::size_t lowest =
        *std::min_element(shoe.begin(), shoe.end(), [&](std::size_t a, std::size_t b) { return now[a].y < now[b].y; });
    return {now[lowest].y, static_cast<float>((before[lowest].z - after[lowest].z) / fine_step)};
}

// The lowest vertex touches the ground: closer than a swinging foot ever comes.
constexpr float touching = 0.004f;  // [m]

struct Steps {
    double worst_slip = 0;     // share of the speed
    double contact_share = 0;  // of the cycle, per foot
    double flight_share = 0;   // of the cycle, with no foot on the ground
    float worst_float = 0;     // [m] of the lower foot
};

Steps observe(const Clip& clip, float speed) {
    const std::vector<std::size_t> shoes[2] = {vertices_of("foot_l"), vertices_of("foot_r")};
    Steps steps;
    const double share = fine_step / clip.duration;
    for_every_instant(clip, [&](double t) {
        float lower = 1.0f;
        for (const auto& shoe : shoes) {
            const Contact c = contact(clip, shoe, t);
            lower = std::min(lower, c.height);
            if (c.height > touching) continue;
            steps.contact_share += 0.5 * share;
            steps.worst_slip = std::max(steps.worst_slip, std::abs(c.speed / speed - 1.0));
        }
        steps.worst_float = std::max(steps.worst_float, lower);
        if (lower > touching) steps.flight_share += share;
    });
    return steps;
}

constexpr double slip_limit = 0.15;  // share of the speed: at 20 m nobody sees a centimetre in a step

TEST(Person, FeetDoNotSlideWhenWalking) {
    EXPECT_LT(observe(clip_named("walk"), scene::walk_speed).worst_slip, slip_limit);
}

TEST(Person, FeetDoNotSlideWhenRunning) {
    EXPECT_LT(observe(clip_named("run"), scene::run_speed).worst_slip, slip_limit);
}

TEST(Person, AFootIsAlwaysOnTheGroundWhenWalking) {
    const Steps steps = observe(clip_named("walk"), scene::walk_speed);
    EXPECT_LT(steps.worst_float, 0.02f);
    EXPECT_GT(steps.contact_share, 0.55);
    EXPECT_LT(steps.contact_share, 0.68);
}

TEST(Person, FliesBetweenRunningSteps) {
    const Steps steps = observe(clip_named("run"), scene::run_speed);
    EXPECT_GT(steps.flight_share, 0.2);
    EXPECT_GT(steps.contact_share, 0.2);
}

TEST(Person, FeetStayPutWhenStandingAndCheering) {
    constexpr float tolerance = 0.002f;  // [m] between keys the chain of joints is interpolated, not solved
    for (const char* name : {"stand", "cheer"}) {
        const auto planted = joints_at(clip_named(name), 0.0);
        for_every_instant(clip_named(name), [&](double t) {
            for (const char* foot : {"foot_l", "foot_r"})
                ASSERT_LT(glm::distance(joints_at(clip_named(name), t)[node_named(foot)], planted[node_named(foot)]),
                          tolerance)
                    << name << " at " << t;
        });
    }
}

TEST(Person, ArmsSwingAgainstLegs) {
    for (const char* name : {"walk", "run"}) {
        double together = 0;
        for_every_instant(clip_named(name), [&](double t) {
            const auto joints = joints_at(clip_named(name), t);
            together += (joints[node_named("hand_l")].z - joints[node_named("hand_r")].z) *
                        (joints[node_named("foot_l")].z - joints[node_named("foot_r")].z);
        });
        EXPECT_LT(together, 0.0) << name;
    }
}

TEST(Person, TheTwoHalvesOfAGaitMirrorEachOther) {
    constexpr float tolerance = 1e-4f;  // [m] float rounding along a chain of joints
    for (const char* name : {"walk", "run"}) {
        const Clip& clip = clip_named(name);
        const auto first = joints_at(clip, 0.0), second = joints_at(clip, 0.5 * clip.duration);
        for (const char* joint : {"hand", "foot", "shin", "forearm"}) {
            const glm::vec3 left = first[node_named(std::string(joint) + "_l")];
            const glm::vec3 right = second[node_named(std::string(joint) + "_r")];
            EXPECT_LT(glm::distance(left, glm::vec3(-right.x, right.y, right.z)), tolerance) << name << ' ' << joint;
        }
    }
}

}  // namespace
