// What somebody sees who looks at the person: clothes, face, proportions, and skin that holds together in every pose.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "tests/scene/posed_person.h"

namespace {

using namespace tests;
using model::Mesh;
using model::no_slot;
using model::Slot;

const Mesh& mesh() {
    return person().mesh;
}

double luma(glm::u8vec4 color) {
    return 0.299 * color.x + 0.587 * color.y + 0.114 * color.z;
}

// The first vertex of the triangle that a ray hits first, in rest.
std::optional<std::uint32_t> first_hit(glm::dvec3 from, glm::dvec3 along) {
    std::optional<std::uint32_t> best;
    double nearest = 1e9;
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3) {
        const glm::dvec3 a(mesh().positions[mesh().indices[i]]), b(mesh().positions[mesh().indices[i + 1]]),
            c(mesh().positions[mesh().indices[i + 2]]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double facing = glm::dot(normal, along);
        if (facing >= 0) continue;  // culled, as when drawn
        const double t = glm::dot(normal, a - from) / facing;
        const glm::dvec3 at = from + t * along;
        const bool inside = glm::dot(glm::cross(b - a, at - a), normal) >= 0 &&
                            glm::dot(glm::cross(c - b, at - b), normal) >= 0 &&
                            glm::dot(glm::cross(a - c, at - c), normal) >= 0;
        if (t > 0 && t < nearest && inside) {
            nearest = t;
            best = mesh().indices[i];
        }
    }
    return best;
}

Slot seen(glm::dvec3 from, glm::dvec3 along) {
    const auto hit = first_hit(from, along);
    EXPECT_TRUE(hit.has_value()) << "nothing at " << from.x << ' ' << from.y << ' ' << from.z;
    return hit ? mesh().slots[*hit] : no_slot;
}

Slot from_the_front(double x, double y) {
    return seen({x, y, 5}, {0, 0, -1});
}

Slot from_behind(double x, double y) {
    return seen({x, y, -5}, {0, 0, 1});
}

TEST(PersonLooks, WearsTrousersBelowAShirtBelowAFaceBelowHair) {
    for (const double side : {-1.0, 1.0}) {
        const double leg = 0.09 * side;
        EXPECT_EQ(from_the_front(leg, 0.04), no_slot) << "shoes";
        EXPECT_EQ(from_behind(leg, 0.04), no_slot) << "shoes";
        for (double y = 0.13; y < 0.97; y += 0.02) {
            EXPECT_EQ(from_the_front(leg, y), scene::trousers_slot) << y;
            EXPECT_EQ(from_behind(leg, y), scene::trousers_slot) << y;
        }
        for (double y = 1.0; y < 1.44; y += 0.02) {
            EXPECT_EQ(from_the_front(0.05 * side, y), scene::shirt_slot) << y;
            EXPECT_EQ(from_behind(0.05 * side, y), scene::shirt_slot) << y;
        }
    }
    constexpr double beside = 0.004;  // [m] the middle, where faces meet
    for (double y = 1.54; y < 1.68; y += 0.01) EXPECT_EQ(from_the_front(beside, y), scene::skin_slot) << y;
    for (double y = 1.64; y < 1.74; y += 0.02) EXPECT_EQ(from_behind(beside, y), scene::hair_slot) << y;
    EXPECT_EQ(from_the_front(beside, 1.73), scene::hair_slot);
    EXPECT_EQ(seen({beside, 5, 0}, {0, -1, 0}), scene::hair_slot) << "from above";
    EXPECT_EQ(from_behind(beside, 1.53), scene::skin_slot) << "the neck";
}

TEST(PersonLooks, EachJointsSkinIsInItsSlots) {
    const std::map<std::string, std::set<Slot>> worn{{"hand", {scene::skin_slot}},
                                                     {"forearm", {scene::skin_slot}},
                                                     {"foot", {no_slot}},
                                                     {"shin", {scene::trousers_slot}},
                                                     {"thigh", {scene::trousers_slot}},
                                                     {"head", {scene::skin_slot, scene::hair_slot, no_slot}},
                                                     {"chest", {scene::shirt_slot}}};
    for (const auto& [joint, slots] : worn) {
        for (const char* side : {"_l", "_r", ""}) {
            const bool has_sides = joint != "head" && joint != "chest";
            if (has_sides != (*side != '\0')) continue;
            const auto vertices = vertices_of(joint + side);
            EXPECT_FALSE(vertices.empty()) << joint << side;
            for (const std::size_t v : vertices) EXPECT_TRUE(slots.contains(mesh().slots[v])) << joint << side;
        }
    }
}

TEST(PersonLooks, HasADarkEyeOnEachSideOfTheNose) {
    for (const double side : {-1.0, 1.0}) {
        const auto hit = first_hit({0.031 * side, 1.648, 5}, {0, 0, -1});
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(mesh().slots[*hit], no_slot);
        EXPECT_LT(luma(mesh().colors[*hit]), 60);
    }
    int eyes = 0;
    for (std::size_t v = 0; v < mesh().vertex_count(); ++v) {
        if (mesh().slots[v] != no_slot || mesh().positions[v].y < 0.5f) continue;
        ++eyes;
        EXPECT_GT(mesh().positions[v].z, 0.05f);
        EXPECT_EQ(mesh().joints[v][0], node_named("head"));
    }
    EXPECT_GT(eyes, 4);
    // The nose is what is foremost in the face, below the eyes and above the mouth.
    std::size_t foremost = 0;
    for (std::size_t v = 0; v < mesh().vertex_count(); ++v)
        if (mesh().positions[v].y > 1.5f && mesh().positions[v].z > mesh().positions[foremost].z) foremost = v;
    EXPECT_EQ(mesh().positions[foremost].x, 0);
    EXPECT_GT(mesh().positions[foremost].y, 1.58f);
    EXPECT_LT(mesh().positions[foremost].y, 1.64f);
}

TEST(PersonLooks, ShoesAreDarkAndAllElseIsAShadeOfItsSlot) {
    constexpr int darkest = 140;  // a crease
    std::set<int> shades;
    for (std::size_t v = 0; v < mesh().vertex_count(); ++v) {
        const glm::u8vec4 color = mesh().colors[v];
        EXPECT_EQ(color.w, 255);
        if (mesh().slots[v] == no_slot) {
            EXPECT_LT(luma(color), 60);
            EXPECT_GT(luma(color), 15);
            continue;
        }
        EXPECT_EQ(color.x, color.y);
        EXPECT_EQ(color.x, color.z);
        EXPECT_GE(color.x, darkest);
        shades.insert(color.x);
    }
    EXPECT_EQ(*shades.rbegin(), 255);
    EXPECT_GE(shades.size(), 5u);
    // Between the legs, under the sleeves and the chin less light comes.
    const auto shade_near = [](glm::vec3 at) {
        std::size_t nearest = 0;
        for (std::size_t v = 0; v < mesh().vertex_count(); ++v)
            if (glm::distance(mesh().positions[v], at) < glm::distance(mesh().positions[nearest], at)) nearest = v;
        return static_cast<int>(mesh().colors[nearest].x);
    };
    EXPECT_LT(shade_near({0, 0.826f, 0}), 170);
    EXPECT_LT(shade_near({0, 1.53f, 0.06f}), 205) << "under the chin";
    EXPECT_EQ(shade_near({0, 1.618f, 0.12f}), 255) << "the nose";
}

// Names and weights of all that moves a vertex, on this or on the other side.
std::map<std::string, float> moved_by(std::size_t v, bool on_the_other_side) {
    std::map<std::string, float> result;
    for (int slot = 0; slot < 4; ++slot) {
        if (mesh().weights[v][slot] == 0) continue;
        std::string name = person().skeleton.nodes[mesh().joints[v][slot]].name;
        if (on_the_other_side && name.size() > 2 && name[name.size() - 2] == '_')
            name.back() = name.back() == 'l' ? 'r' : 'l';
        result[name] += mesh().weights[v][slot];
    }
    return result;
}

TEST(PersonLooks, BothSidesAreClothedShadedAndMovedAlike) {
    constexpr float tolerance = 1e-4f;
    for (std::size_t v = 0; v < mesh().vertex_count(); ++v) {
        const glm::vec3 mirrored(-mesh().positions[v].x, mesh().positions[v].y, mesh().positions[v].z);
        const glm::vec3 normal(-mesh().normals[v].x, mesh().normals[v].y, mesh().normals[v].z);
        bool found = false;
        for (std::size_t other = 0; other < mesh().vertex_count() && !found; ++other) {
            if (mesh().positions[other] != mirrored || mesh().slots[other] != mesh().slots[v]) continue;
            if (mesh().colors[other] != mesh().colors[v]) continue;
            if (glm::distance(mesh().normals[other], normal) > tolerance) continue;
            found = moved_by(v, true) == moved_by(other, false);
        }
        EXPECT_TRUE(found) << "vertex " << v << " at " << mirrored.x << ' ' << mirrored.y << ' ' << mirrored.z;
    }
}

TEST(PersonLooks, TheLeftIsAtPlusX) {
    for (const model::Node& node : person().skeleton.nodes) {
        const float x = joints_at(clip_named("stand"), 0)[node_named(node.name)].x;
        if (node.name.ends_with("_l")) {
            EXPECT_GT(x, 0.02f) << node.name;
        } else if (node.name.ends_with("_r")) {
            EXPECT_LT(x, -0.02f) << node.name;
        } else {
            EXPECT_NEAR(x, 0, 0.03f) << node.name;
        }
    }
}

TEST(PersonLooks, VerticesFollowBonesNearThem) {
    constexpr float furthest = 0.22f;  // [m] from the base of a skull to its top
    std::vector<glm::vec3> joints;
    for (std::size_t j = 0; j < person().skeleton.nodes.size(); ++j) {
        const glm::mat4& inverse = person().skeleton.palette[j].inverse_bind;
        joints.push_back(-glm::vec3(inverse[3]));
    }
    const auto to_bone = [&](glm::vec3 at, std::size_t joint) {
        float least = glm::distance(at, joints[joint]);
        for (std::size_t child = 0; child < joints.size(); ++child) {
            if (person().skeleton.nodes[child].parent != static_cast<int>(joint)) continue;
            const glm::vec3 along = joints[child] - joints[joint];
            const float share = std::clamp(glm::dot(at - joints[joint], along) / glm::dot(along, along), 0.0f, 1.0f);
            least = std::min(least, glm::distance(at, joints[joint] + share * along));
        }
        return least;
    };
    for (std::size_t v = 0; v < mesh().vertex_count(); ++v) {
        for (int slot = 0; slot < 4; ++slot) {
            if (mesh().weights[v][slot] < 0.1f) continue;
            EXPECT_LT(to_bone(mesh().positions[v], mesh().joints[v][slot]), furthest)
                << v << " by " << person().skeleton.nodes[mesh().joints[v][slot]].name;
        }
    }
}

TEST(PersonLooks, SidesDoNotMoveEachOther) {
    for (std::size_t v = 0; v < mesh().vertex_count(); ++v) {
        for (const auto& [name, weight] : moved_by(v, false)) {
            if (name.ends_with("_l")) {
                EXPECT_GT(mesh().positions[v].x, -1e-3f) << name;
            }
            if (name.ends_with("_r")) {
                EXPECT_LT(mesh().positions[v].x, 1e-3f) << name;
            }
        }
    }
}

TEST(PersonLooks, HasThePersonsProportions) {
    // Shares of stature after Winter, Biomechanics and Motor Control of Human Movement, fig. 4.1.
    constexpr float stature = 1.75f, tolerance = 0.04f;  // [m]
    std::map<std::string, glm::vec3> at;
    for (std::size_t j = 0; j < person().skeleton.nodes.size(); ++j)
        at[person().skeleton.nodes[j].name] = -glm::vec3(person().skeleton.palette[j].inverse_bind[3]);
    EXPECT_NEAR(at["upper_arm_l"].y, 0.818f * stature, tolerance);
    EXPECT_NEAR(at["thigh_l"].y, 0.530f * stature, tolerance);
    EXPECT_NEAR(at["shin_l"].y, 0.285f * stature, tolerance);
    EXPECT_NEAR(at["foot_l"].y, 0.039f * stature, tolerance);
    EXPECT_NEAR(glm::distance(at["upper_arm_l"], at["forearm_l"]), 0.186f * stature, tolerance);
    EXPECT_NEAR(glm::distance(at["forearm_l"], at["hand_l"]), 0.146f * stature, tolerance);
    // A tape around nothing: boxes of what each joint moves.
    const auto box = [](const std::string& joint) {
        std::vector<glm::vec3> positions;
        for (const std::size_t v : vertices_of(joint)) positions.push_back(mesh().positions[v]);
        return motion::bounds_of(positions);
    };
    EXPECT_NEAR(box("head").size().y, 0.13f * stature, tolerance);
    EXPECT_NEAR(box("foot_l").size().z, 0.152f * stature, tolerance);
    EXPECT_NEAR(box("hips").size().x, 0.191f * stature, tolerance);
}

double volume(const std::vector<glm::vec3>& positions) {
    double result = 0;
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3) {
        const glm::dvec3 a(positions[mesh().indices[i]]), b(positions[mesh().indices[i + 1]]),
            c(positions[mesh().indices[i + 2]]);
        result += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return result;
}

TEST(PersonLooks, WeighsWhatPeopleWeigh) {
    constexpr double litres = 70;  // of 70 kg: people all but float
    EXPECT_NEAR(1000 * volume(mesh().positions), litres, 12);
}

TEST(PersonLooks, NormalsAreNearTheMeanOfTheirFaces) {
    std::vector<glm::vec3> sums(mesh().vertex_count(), glm::vec3(0));
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3)
        for (std::size_t corner = 0; corner < 3; ++corner)
            sums[mesh().indices[i + corner]] += glm::normalize(face_cross(mesh(), i));
    for (std::size_t v = 0; v < mesh().vertex_count(); ++v)
        EXPECT_GT(glm::dot(glm::normalize(sums[v]), mesh().normals[v]), 0.65f) << v;
}

// A cylinder's normals point away from its axis whichever way its quads are cut: what weighting by angles is for.
TEST(PersonLooks, NormalsOfAShinPointAwayFromItsBone) {
    int looked = 0;
    for (const std::size_t v : vertices_of("shin_l")) {
        const glm::vec3 at = mesh().positions[v];
        if (at.y < 0.16f || at.y > 0.40f) continue;
        ++looked;
        const glm::vec2 away = glm::normalize(glm::vec2(at.x - 0.09f, at.z + 0.006f));
        const glm::vec2 normal = glm::normalize(glm::vec2(mesh().normals[v].x, mesh().normals[v].z));
        EXPECT_GT(glm::dot(away, normal), 0.985f) << at.x << ' ' << at.y << ' ' << at.z;
    }
    EXPECT_GE(looked, 16);
}

constexpr double look_every = 1.0 / 10.0;  // [s]

TEST(PersonSkin, HoldsTogetherWhereSlotsMeet) {
    constexpr float gap = 1e-5f;  // [m] rounding
    const std::vector<std::uint32_t> weld = welded(mesh());
    for (const model::Clip& clip : person().clips) {
        for (double t = 0; t < clip.duration; t += look_every) {
            const auto positions = posed(clip, t);
            std::map<std::uint32_t, glm::vec3> first;
            for (std::size_t v = 0; v < positions.size(); ++v) {
                const auto [at, is_new] = first.try_emplace(weld[v], positions[v]);
                ASSERT_LT(glm::distance(at->second, positions[v]), gap) << clip.name << " at " << t;
            }
        }
    }
}

TEST(PersonSkin, IsNotTornInAnyPose) {
    constexpr float longest = 4.0f;      // times an edge's length at rest: between the legs of who sits
    constexpr float short_edge = 0.02f;  // [m] whose stretching nobody sees
    for (const model::Clip& clip : person().clips) {
        for (double t = 0; t < clip.duration; t += look_every) {
            const auto positions = posed(clip, t);
            for (std::size_t i = 0; i < mesh().indices.size(); ++i) {
                const std::uint32_t a = mesh().indices[i], b = mesh().indices[i % 3 == 2 ? i - 2 : i + 1];
                const float rest = glm::distance(mesh().positions[a], mesh().positions[b]);
                if (rest < short_edge) continue;
                ASSERT_LT(glm::distance(positions[a], positions[b]), longest * rest)
                    << clip.name << " at " << t << ", y " << mesh().positions[a].y;
            }
        }
    }
}

// A forearm that follows the hand's turn in one place only is wrung to a thread there.
TEST(PersonSkin, OfTheForearmIsNotWrungByTheHand) {
    constexpr float thinnest = 0.6f;  // of what it is at rest
    const auto from_axis = [](glm::vec3 at, glm::vec3 elbow, glm::vec3 wrist) {
        return glm::length(glm::cross(at - elbow, glm::normalize(wrist - elbow)));
    };
    const std::vector<glm::vec3> rest_joints = [] {
        std::vector<glm::vec3> result;
        for (const auto& entry : person().skeleton.palette) result.push_back(-glm::vec3(entry.inverse_bind[3]));
        return result;
    }();
    for (const char* side : {"_l", "_r"}) {
        const int elbow = node_named(std::string("forearm") + side), wrist = node_named(std::string("hand") + side);
        for (const model::Clip& clip : person().clips) {
            for (double t = 0; t < clip.duration; t += look_every) {
                const auto positions = posed(clip, t), joints = joints_at(clip, t);
                for (const std::size_t v : vertices_of(std::string("forearm") + side)) {
                    const glm::vec3 at = mesh().positions[v];
                    // The lower half, away from the fold of the elbow.
                    if (glm::distance(at, rest_joints[elbow]) < 0.13f) continue;
                    const float rest = from_axis(at, rest_joints[elbow], rest_joints[wrist]);
                    ASSERT_GT(from_axis(positions[v], joints[elbow], joints[wrist]), thinnest * rest)
                        << clip.name << side << " at " << t;
                }
            }
        }
    }
}

TEST(PersonSkin, KeepsItsVolume) {
    const double rest = volume(mesh().positions);
    for (const model::Clip& clip : person().clips)
        for (double t = 0; t < clip.duration; t += look_every)
            ASSERT_NEAR(volume(posed(clip, t)) / rest, 1.0, 0.08) << clip.name << " at " << t;
}

}  // namespace
