// How the person moves: what each joint may do, and what makes a clap, a cheer, a walk and a run look like one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/pose.h"
#include "tests/scene/posed_person.h"

namespace {

using namespace tests;
using model::Clip;

constexpr float degree = std::numbers::pi_v<float> / 180;
constexpr double look_every = 1.0 / 60.0;  // [s]

struct Body {
    motion::Pose pose;
    Body(const Clip& clip, double time) { motion::evaluate(person(), clip, wrapped(clip, time), pose); }

    static double wrapped(const Clip& clip, double time) {
        return time - clip.duration * std::floor(time / clip.duration);
    }
    glm::vec3 at(const std::string& joint) const { return glm::vec3(pose.world[node_named(joint)][3]); }
    // A direction of the joint's own, which at rest is the model's.
    glm::vec3 turned(const std::string& joint, glm::vec3 direction) const {
        return glm::normalize(glm::mat3(pose.world[node_named(joint)]) * direction);
    }
    glm::vec3 forward(const std::string& joint) const { return turned(joint, {0, 0, 1}); }
    glm::vec3 up(const std::string& joint) const { return turned(joint, {0, 1, 0}); }
    // At rest the arms point out and down, palms towards the body.
    glm::vec3 palm(const std::string& side) const {
        const Body& self = *this;
        const glm::mat4 &arm = person().skeleton.palette[node_named("upper_arm" + side)].inverse_bind,
                        &hand = person().skeleton.palette[node_named("hand" + side)].inverse_bind;
        const glm::vec3 along = glm::normalize(glm::vec3(arm[3]) - glm::vec3(hand[3]));
        const float sign = side == "_l" ? 1.0f : -1.0f;
        return self.turned("hand" + side, -sign * glm::cross(glm::vec3(0, 0, 1), along));
    }
    // [rad] by which a joint is bent: 0 where its two bones are in line.
    float bend(const std::string& from, const std::string& joint, const std::string& to) const {
        const glm::vec3 one = glm::normalize(at(joint) - at(from)), other = glm::normalize(at(to) - at(joint));
        return std::acos(std::clamp(glm::dot(one, other), -1.0f, 1.0f));
    }
};

void watch(const Clip& clip, const std::function<void(const Body&, double)>& look) {
    for (double t = 0; t < clip.duration - 1e-9; t += look_every) look(Body(clip, t), t);
}

const char* const sides[] = {"_l", "_r"};

// ---- Every clip ----

TEST(PersonMoves, NoJointBendsFurtherThanPeoplesDo) {
    for (const Clip& clip : person().clips) {
        watch(clip, [&](const Body& body, double t) {
            for (const std::string side : sides) {
                const float knee = body.bend("thigh" + side, "shin" + side, "foot" + side);
                const float elbow = body.bend("upper_arm" + side, "forearm" + side, "hand" + side);
                ASSERT_LT(knee, 135 * degree) << clip.name << " at " << t;
                ASSERT_LT(elbow, 150 * degree) << clip.name << " at " << t;
                // The foot against the shin: toes up or down by what an ankle allows.
                const glm::vec3 shin = glm::normalize(body.at("foot" + side) - body.at("shin" + side));
                const float ankle = std::acos(std::clamp(-glm::dot(shin, body.up("foot" + side)), -1.0f, 1.0f));
                ASSERT_LT(ankle, 70 * degree) << clip.name << " at " << t;
                // A hand against its forearm.
                const glm::mat3 wrist = glm::transpose(glm::mat3(body.pose.world[node_named("forearm" + side)])) *
                                        glm::mat3(body.pose.world[node_named("hand" + side)]);
                const float turn =
                    std::acos(std::clamp((wrist[0][0] + wrist[1][1] + wrist[2][2] - 1) / 2, -1.0f, 1.0f));
                ASSERT_LT(turn, 100 * degree) << clip.name << side << " at " << t;
            }
        });
    }
}

TEST(PersonMoves, FaceChestAndFeetPointForward) {
    for (const Clip& clip : person().clips) {
        watch(clip, [&](const Body& body, double t) {
            ASSERT_GT(body.forward("head").z, 0.75f) << clip.name << " at " << t;
            ASSERT_GT(body.forward("chest").z, 0.7f) << clip.name << " at " << t;
            ASSERT_GT(body.up("head").y, 0.8f) << clip.name << " at " << t;
            for (const std::string side : sides) {
                const glm::vec3 foot = body.forward("foot" + side);
                ASSERT_LT(std::abs(foot.x), std::sin(15 * degree)) << clip.name << " at " << t;
                // Toes point out.
                ASSERT_GT(side == "_l" ? foot.x : -foot.x, -0.01f) << clip.name << " at " << t;
            }
        });
    }
}

TEST(PersonMoves, KneesAndElbowsPointWherePeoplesDo) {
    for (const Clip& clip : person().clips) {
        watch(clip, [&](const Body& body, double t) {
            for (const std::string side : sides) {
                const float sign = side == "_l" ? 1.0f : -1.0f;
                const glm::vec3 hip = body.at("thigh" + side), knee = body.at("shin" + side),
                                ankle = body.at("foot" + side);
                const float share = glm::dot(knee - hip, ankle - hip) / glm::dot(ankle - hip, ankle - hip);
                const glm::vec3 off = knee - glm::mix(hip, ankle, share);
                if (glm::length(off) > 0.03f) {
                    ASSERT_GT(glm::normalize(off).z, 0.25f) << clip.name << " at " << t;
                    ASSERT_LT(std::abs(glm::normalize(off).x), 0.5f) << clip.name << " at " << t;
                }
                const glm::vec3 shoulder = body.at("upper_arm" + side), elbow = body.at("forearm" + side),
                                wrist = body.at("hand" + side);
                const glm::vec3 out = elbow - (shoulder + wrist) / 2.0f;
                // Out of the way of the body, or behind it.
                ASSERT_GT(sign * out.x - out.z, 0) << clip.name << side << " at " << t;
            }
        });
    }
}

TEST(PersonMoves, NothingButTheWavingArmAndTheFidgetingAreOneSided) {
    constexpr float tolerance = 1e-4f;  // [m]
    const auto mirrored = [&](const Body& body, float most) {
        for (const model::Node& node : person().skeleton.nodes) {
            if (!node.name.ends_with("_l")) continue;
            const glm::vec3 left = body.at(node.name), right = body.at(node.name.substr(0, node.name.size() - 1) + "r");
            ASSERT_LT(glm::distance(left, glm::vec3(-right.x, right.y, right.z)), most) << node.name;
        }
    };
    for (const Clip& clip : person().clips)
        if (clip.duration == 4) mirrored(Body(clip, 0), clip.name == "stand" ? 0.03f : tolerance);
    watch(clip_named("cheer"), [&](const Body& body, double) { mirrored(body, tolerance); });
}

// ---- Seated clips ----

TEST(PersonMoves, SitsWithHandsOnThighsAndLooksAround) {
    float left = 0, right = 0, most_up = 0;
    watch(clip_named("sit"), [&](const Body& body, double t) {
        for (const std::string side : sides) {
            const glm::vec3 hand = body.at("hand" + side), hip = body.at("thigh" + side), knee = body.at("shin" + side);
            const glm::vec3 thigh = glm::mix(hip, knee, (hand.z - hip.z) / (knee.z - hip.z));
            ASSERT_LT(glm::distance(hand, thigh), 0.16f) << t;
            ASSERT_GT(hand.y, thigh.y + 0.04f) << t;
            ASSERT_LT(body.palm(side).y, -0.7f) << "palms down, " << t;
        }
        left = std::max(left, body.forward("head").x);
        right = std::min(right, body.forward("head").x);
        most_up = std::max(most_up, std::abs(body.forward("head").y));
        ASSERT_LT(body.bend("thigh_l", "shin_l", "foot_l"), 110 * degree);
        ASSERT_GT(body.bend("thigh_l", "shin_l", "foot_l"), 60 * degree);
    });
    EXPECT_GT(left, std::sin(15 * degree));
    EXPECT_LT(right, -std::sin(12 * degree));
    EXPECT_LT(most_up, std::sin(15 * degree));
}

TEST(PersonMoves, BreathesWhileSitting) {
    std::vector<float> heights;
    watch(clip_named("sit"), [&](const Body& body, double) { heights.push_back(body.at("clavicle_l").z); });
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    EXPECT_GT(*high - *low, 0.002f);
    EXPECT_LT(*high - *low, 0.03f);
}

TEST(PersonMoves, FeetStayOnTheFloorWhileSeated) {
    constexpr float tolerance = 0.002f, tap = 0.02f;  // [m]
    for (const char* name : {"sit", "clap", "wave"}) {
        const Body first(clip_named(name), 0);
        float tapped = 0;
        watch(clip_named(name), [&](const Body& body, double t) {
            ASSERT_LT(glm::distance(body.at("foot_r"), first.at("foot_r")), tolerance) << name << " at " << t;
            ASSERT_LT(glm::distance(body.at("foot_l"), first.at("foot_l")), tap) << name << " at " << t;
            tapped = std::max(tapped, body.forward("foot_l").y);
        });
        EXPECT_EQ(tapped > 0.1f, std::string(name) == "sit") << "the left foot taps";
    }
}

TEST(PersonMoves, ClapsThreeTimesASecondPalmToPalmBeforeTheChest) {
    std::vector<double> claps;
    const auto gap = [](double t) {
        const Body body(clip_named("clap"), t);
        return body.at("hand_l").x - body.at("hand_r").x;
    };
    for (double t = 0.6; t < 3.3; t += 1.0 / 240) {
        if (gap(t) > gap(t - 1.0 / 240) || gap(t) > gap(t + 1.0 / 240) || gap(t) > 0.1f) continue;
        if (!claps.empty() && t - claps.back() < 0.1) continue;
        claps.push_back(t);
        const Body body(clip_named("clap"), t);
        EXPECT_LT(body.palm("_l").x, -0.9f);
        EXPECT_GT(body.palm("_r").x, 0.9f);
        for (const std::string side : sides) {
            EXPECT_GT(body.at("hand" + side).z, body.at("chest").z + 0.2f);
            EXPECT_NEAR(body.at("hand" + side).y, body.at("chest").y + 0.15f, 0.2f);
        }
        EXPECT_NEAR(body.at("hand_l").y, body.at("hand_r").y, 1e-3f);
    }
    ASSERT_GE(claps.size(), 7u);
    for (std::size_t i = 1; i < claps.size(); ++i) EXPECT_NEAR(claps[i] - claps[i - 1], 0.31, 0.03);
}

// Largest and least of a number over a time of a clip.
std::pair<float, float> range(const char* clip, double from, double to, const std::function<float(const Body&)>& of) {
    float least = 1e6f, most = -1e6f;
    for (double t = from; t < to; t += look_every) {
        const float value = of(Body(clip_named(clip), t));
        least = std::min(least, value);
        most = std::max(most, value);
    }
    return {least, most};
}

TEST(PersonMoves, CheersForTwoSecondsWithPalmsToTheGameAndBounces) {
    int up = 0, bounces = 0;
    float before = 0, last = 0;
    watch(clip_named("cheer"), [&](const Body& body, double t) {
        const bool raised = body.at("hand_l").y > body.at("head").y + 0.2f && body.at("hips").y > 0.85f;
        up += raised;
        if (t > 1.2 && t < 2.6) {
            ASSERT_TRUE(raised) << t;
            for (const std::string side : sides) {
                ASSERT_GT(body.palm(side).z, 0.5f) << t;
                ASSERT_GT(side == "_l" ? body.at("hand_l").x : -body.at("hand_r").x, 0.2f) << "arms apart, " << t;
            }
        }
        const float height = body.at("hips").y;
        bounces += t > 0.9 && t < 2.9 && before > last && height > last;
        before = last;
        last = height;
    });
    EXPECT_GT(up, 100);
    EXPECT_EQ(bounces, 3);
    const auto [low, high] = range("cheer", 1.0, 2.7, [](const Body& body) { return body.at("hips").y; });
    EXPECT_GT(high - low, 0.04f);
    EXPECT_LT(high - low, 0.12f);
}

TEST(PersonMoves, WavesTheRightHandToAndFroPalmForward) {
    int turns = 0;
    float before = 0, last = 0, left_most = 0;
    watch(clip_named("wave"), [&](const Body& body, double t) {
        const float x = body.at("hand_r").x;
        if (t > 1.0 && t < 3.0) {
            ASSERT_GT(body.palm("_r").z, 0.8f) << t;
            ASSERT_GT(body.at("hand_r").y, body.at("upper_arm_r").y + 0.05f) << t;
            turns += (last - before) * (x - last) < 0;
        }
        left_most = std::max(left_most, glm::distance(body.at("hand_l"), Body(clip_named("wave"), 0).at("hand_l")));
        before = last;
        last = x;
    });
    EXPECT_GE(turns, 5);
    EXPECT_LE(turns, 9);
    EXPECT_LT(left_most, 0.08f) << "the other hand rests";
}

// ---- Standing ----

TEST(PersonMoves, StandsUprightAndShiftsItsWeightOnce) {
    const auto [right, left] = range("stand", 0, 4, [](const Body& body) { return body.at("hips").x; });
    EXPECT_NEAR(left, -right, 1e-3f);
    EXPECT_GT(left, 0.008f);
    EXPECT_LT(left, 0.03f);
    watch(clip_named("stand"), [&](const Body& body, double t) {
        for (const std::string side : sides) {
            ASSERT_LT(body.bend("thigh" + side, "shin" + side, "foot" + side), 30 * degree) << t;
            ASSERT_LT(body.at("hand" + side).y, body.at("hips").y) << "arms hang, " << t;
        }
        ASSERT_GT(body.at("head").y, 1.5f);
        ASSERT_LT(std::abs(body.at("head").z - body.at("hips").z), 0.1f);
    });
    EXPECT_GT(Body(clip_named("stand"), 1).at("hips").x, 0.005f);
    EXPECT_LT(Body(clip_named("stand"), 3).at("hips").x, -0.005f);
}

// ---- Gaits ----

struct Gait {
    const char* name;
    float speed;
};
constexpr Gait gaits[] = {{"walk", scene::walk_speed}, {"run", scene::run_speed}};

// How two numbers go together over a gait, -1 to 1.
double together(const char* clip, const std::function<float(const Body&)>& a,
                const std::function<float(const Body&)>& b) {
    double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0, n = 0;
    watch(clip_named(clip), [&](const Body& body, double) {
        const double x = static_cast<double>(a(body)), y = static_cast<double>(b(body));
        sum_a += x, sum_b += y, aa += x * x, bb += y * y, ab += x * y, n += 1;
    });
    return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

float ahead(const Body& body, const std::string& joint) {
    return body.at(joint + "_l").z - body.at(joint + "_r").z;
}

TEST(PersonGaits, TheTwoHalvesMirrorEachOtherAllAlong) {
    constexpr float tolerance = 2e-3f;  // [m] between keys, joints are interpolated
    for (const Gait& gait : gaits) {
        const Clip& clip = clip_named(gait.name);
        watch(clip, [&](const Body& first, double t) {
            const Body second(clip, t + clip.duration / 2);
            for (const model::Node& node : person().skeleton.nodes) {
                std::string other = node.name;
                if (other.ends_with("_l"))
                    other.back() = 'r';
                else if (other.ends_with("_r"))
                    other.back() = 'l';
                const glm::vec3 here = first.at(node.name), there = second.at(other);
                ASSERT_LT(glm::distance(here, glm::vec3(-there.x, there.y, there.z)), tolerance)
                    << gait.name << ' ' << node.name << " at " << t;
            }
        });
    }
}

TEST(PersonGaits, HipsTurnWithTheLegsAndShouldersAgainstThem) {
    for (const Gait& gait : gaits) {
        const auto with_legs = [&](const char* joint) {
            return together(
                gait.name, [&](const Body& body) { return ahead(body, joint); },
                [](const Body& body) { return ahead(body, "foot"); });
        };
        EXPECT_GT(with_legs("thigh"), 0.5) << gait.name;
        for (const char* joint : {"upper_arm", "forearm", "hand"}) EXPECT_LT(with_legs(joint), -0.5) << gait.name;
    }
}

TEST(PersonGaits, TheBodySwaysOverTheFootThatCarriesAndTheOtherHipDrops) {
    for (const Gait& gait : gaits) {
        // The foot that carries is the lower one.
        const auto left_carries = [](const Body& b) { return b.at("foot_r").y - b.at("foot_l").y; };
        EXPECT_GT(together(
                      gait.name, [](const Body& b) { return b.at("hips").x; }, left_carries),
                  0.4)
            << gait.name;
        const auto left_hip_up = [](const Body& b) { return b.at("thigh_l").y - b.at("thigh_r").y; };
        EXPECT_GT(together(gait.name, left_hip_up, left_carries), 0.4) << gait.name;
        const auto [right, left] = range(gait.name, 0, 1, [](const Body& b) { return b.at("hips").x; });
        EXPECT_GT(left, 0.005f);
        EXPECT_LT(left, 0.03f);
        EXPECT_NEAR(left, -right, 2e-3f);
    }
}

TEST(PersonGaits, AWalkerIsHighestOverTheStandingFootARunnerInTheAir) {
    const auto height = [](const Body& b) { return b.at("hips").y; };
    const auto straddle = [](const Body& b) { return std::abs(ahead(b, "foot")); };
    EXPECT_LT(together("walk", height, straddle), -0.7);
    // In the air both feet are off the ground.
    float in_air = 0, on_ground = 0, airs = 0, grounds = 0;
    for (double t = 0; t < 0.7; t += 0.005) {
        const Body body(clip_named("run"), t);
        const auto positions = posed(clip_named("run"), t);
        const bool flying = motion::bounds_of(positions).min.y > 0.01f;
        (flying ? in_air : on_ground) += body.at("hips").y;
        (flying ? airs : grounds) += 1;
    }
    EXPECT_GT(in_air / airs, on_ground / grounds + 0.01f);
    for (const Gait& gait : gaits) {
        const auto [low, high] = range(gait.name, 0, 1, height);
        EXPECT_GT(high - low, 0.02f) << gait.name;
        EXPECT_LT(high - low, 0.09f) << gait.name;
    }
}

float trunk_lean(const Body& body) {
    const glm::vec3 trunk = body.at("neck") - body.at("hips");
    return std::atan2(trunk.z, trunk.y) / degree;
}

TEST(PersonGaits, ARunnerLeansForwardAndBendsTheElbowsAWalkerHardlyDoes) {
    const auto elbow = [](const Body& b) { return b.bend("upper_arm_l", "forearm_l", "hand_l") / degree; };
    EXPECT_GT(range("run", 0, 0.7, trunk_lean).first, 6);
    EXPECT_LT(range("run", 0, 0.7, trunk_lean).second, 20);
    EXPECT_GT(range("walk", 0, 1, trunk_lean).first, -2);
    EXPECT_LT(range("walk", 0, 1, trunk_lean).second, 6);
    EXPECT_GT(range("run", 0, 0.7, elbow).first, 70);
    EXPECT_LT(range("run", 0, 0.7, elbow).second, 120);
    EXPECT_GT(range("walk", 0, 1, elbow).first, 3);
    EXPECT_LT(range("walk", 0, 1, elbow).second, 45);
    for (const Gait& gait : gaits) {
        // The head is level though the trunk leans and turns.
        const auto nod = [](const Body& b) { return std::asin(b.forward("head").y) / degree; };
        EXPECT_GT(range(gait.name, 0, 1, nod).first, -12) << gait.name;
        EXPECT_LT(range(gait.name, 0, 1, nod).second, 12) << gait.name;
        const auto turn = [](const Body& b) { return std::asin(b.forward("head").x) / degree; };
        EXPECT_LT(range(gait.name, 0, 1, turn).second, 8) << gait.name;
    }
}

TEST(PersonGaits, ArmsSwingForwardAndBackPastTheHips) {
    for (const Gait& gait : gaits) {
        const auto reach = [](const Body& b) { return b.at("forearm_l").z - b.at("upper_arm_l").z; };
        const auto [back, front] = range(gait.name, 0, 1, reach);
        EXPECT_LT(back, -0.05f) << gait.name;
        EXPECT_GT(front, -0.01f) << gait.name;
        EXPECT_GT(front - back, 0.1f) << gait.name;
    }
    const auto swing = [](const char* name) {
        const auto [back, front] = range(name, 0, 1, [](const Body& b) { return b.at("forearm_l").z; });
        return front - back;
    };
    EXPECT_GT(swing("run"), 1.3f * swing("walk"));
}

TEST(PersonGaits, FeetKeepToTheirSideOfANarrowTrack) {
    for (const Gait& gait : gaits) {
        watch(clip_named(gait.name), [&](const Body& body, double t) {
            ASSERT_GT(body.at("foot_l").x, 0.03f) << gait.name << " at " << t;
            ASSERT_LT(body.at("foot_l").x, 0.11f) << gait.name << " at " << t;
        });
    }
}

// [m] of a shoe: its lowest vertex, and how far that is before or behind the ankle.
struct Shoe {
    float height, before_ankle;
};

Shoe left_shoe(const char* clip, double t) {
    const double time = Body::wrapped(clip_named(clip), t);
    const auto positions = posed(clip_named(clip), time);
    Shoe result{1e6f, 0};
    for (const std::size_t v : vertices_of("foot_l")) {
        if (positions[v].y >= result.height) continue;
        result = {positions[v].y, positions[v].z - Body(clip_named(clip), time).at("foot_l").z};
    }
    return result;
}

TEST(PersonGaits, AWalkerLandsOnTheHeelAheadAndLeavesByTheToesBehind) {
    // The clip begins as the left foot lands.
    EXPECT_LT(left_shoe("walk", 0.01).before_ankle, 0);
    EXPECT_GT(Body(clip_named("walk"), 0.01).at("foot_l").z, 0.2f);
    EXPECT_GT(Body(clip_named("walk"), 0.01).forward("foot_l").y, 0.2f) << "toes up";
    EXPECT_GT(left_shoe("walk", 0.58).before_ankle, 0.08f);
    EXPECT_LT(Body(clip_named("walk"), 0.58).at("foot_l").z, -0.25f);
    EXPECT_LT(Body(clip_named("walk"), 0.58).forward("foot_l").y, -0.3f) << "toes down";
    // In between the sole is flat.
    for (double t = 0.12; t < 0.34; t += 0.02) EXPECT_NEAR(Body(clip_named("walk"), t).forward("foot_l").y, 0, 0.03f);
}

TEST(PersonGaits, FeetAreOffTheGroundAsTheySwingPastTheOther) {
    for (const Gait& gait : gaits) {
        const double cycle = clip_named(gait.name).duration;
        float highest = 0;
        for (double share = 0.65; share < 0.94; share += 0.01)
            highest = std::max(highest, Body(clip_named(gait.name), share * cycle).at("foot_l").y);
        EXPECT_GT(left_shoe(gait.name, 0.8 * cycle).height, 0.01f) << gait.name;
        if (gait.speed > 2) {
            EXPECT_GT(highest, 0.35f) << "heels nearly reach a runner's seat";
        } else {
            EXPECT_LT(highest, 0.3f) << "a walker's feet stay low";
        }
    }
}

TEST(PersonGaits, AStepIsAsLongAsSpeedAndTimeMakeIt) {
    for (const Gait& gait : gaits) {
        const Clip& clip = clip_named(gait.name);
        // Where the standing foot is carried back by, in the middle of its stance, in a tenth of the cycle.
        const double from = gait.speed > 2 ? 0.06 : 0.15, to = from + 0.1;
        const float back =
            Body(clip, from * clip.duration).at("foot_l").z - Body(clip, to * clip.duration).at("foot_l").z;
        EXPECT_NEAR(back, gait.speed * static_cast<float>(0.1 * clip.duration), 0.02f) << gait.name;
    }
}

TEST(PersonGaits, NothingJerks) {
    constexpr double frame = 1.0 / 60;
    // [m/s^2] The trunk of a runner feels three times its weight, and hands and head little more.
    constexpr float hardest = 40.0f;
    for (const Gait& gait : gaits) {
        const Clip& clip = clip_named(gait.name);
        watch(clip, [&](const Body& body, double t) {
            const Body before(clip, t - frame), after(clip, t + frame);
            for (const char* joint : {"hips", "head", "hand_l"}) {
                const glm::vec3 bend = before.at(joint) - 2.0f * body.at(joint) + after.at(joint);
                ASSERT_LT(glm::length(bend) / (frame * frame), hardest) << gait.name << ' ' << joint << " at " << t;
            }
        });
    }
}

}  // namespace
