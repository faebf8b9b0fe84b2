// A frame as every way of drawing takes it: from where, whom, and how each is drawn. Plain data, no device.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/view.h"
#include "scene/crowd.h"
#include "scene/palette.h"
#include "sfsm/decision.h"

namespace render {

// About the vertical.
struct Turn {
    std::int16_t sin_yaw = 0, cos_yaw = 0;  // snorm
};

// One person.
struct Instance {
    glm::vec3 position;  // [m] of the model's origin, camera-relative
    float scale;         // [m / model unit]
    Turn turn;
    scene::Palette palette;
};
static_assert(sizeof(Instance) == 20 + 4 * model::slot_count);

// How one person is drawn.
struct Person {
    Instance instance;
    std::uint32_t character;
    std::uint32_t representation;  // into Way::representations
    std::uint32_t first, count;    // of its elements: figures::Level's
    float last_share;              // of the last of them that is drawn, where a representation can: (0, 1]
    std::uint32_t pose;            // into the character's PoseTable
    std::uint32_t batch;           // people of one number are alike in all but instance, depth and points drawn by ones
    float depth;                   // [m] view depth of their middle, > 0
    float shade_radius;            // [m] around their feet it is darker (render/contact_shade.h); 0: they sit
};

// People of a block of the crowd who are all drawn as one splat each, and none by oneself.
struct FarBlock {
    std::uint32_t block;  // into Crowd::blocks
    float depth;          // [m] view depth of the middle of its box, > 0
    std::int64_t tick;    // at which its people were asked what they do
    bool operator==(const FarBlock&) const = default;
};

// Crowds of fewer have no far blocks: so many people are drawn at once.
inline constexpr int fewest_far_people = 16;

// What far blocks are drawn from. Each by person of the whole crowd.
struct FarPeople {
    const scene::Crowd* crowd = nullptr;
    const Turn* turns = nullptr;
    const std::uint8_t* keys = nullptr;  // of figures::splat_keys; only those of blocks that are drawn
};

struct Frame {
    View view;
    double splat_size = 0;             // S [px]
    std::vector<Person> people;        // in the crowd's order; none of far blocks
    std::vector<FarBlock> far_blocks;  // in the crowd's order
    FarPeople far_people;
    std::uint32_t batch_numbers = 0;  // Person::batch is below it; it rises with character, representation, level, pose
    sfsm::Work work;
    // What is promised of everybody in it: how far at most any of their surface is drawn from where it is at the tick
    // as they moved before it, and from the nearest point or triangle that is drawn of it [px].
    double max_motion_px = 0, max_splat_px = 0;
    double expected_flip = 0;  // mean over the frame, people and what is around them
    // What became of the decision: 2 if anybody is drawn by anything but a mesh, else 1 if anybody moves less often
    // than every frame, else 0.
    sfsm::State state = sfsm::State::original;
};

}  // namespace render
