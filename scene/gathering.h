// Makes a crowd person by person, block by block. Where they are is the place's business; what else makes a person of a
// spot is the same everywhere.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scene/audience.h"
#include "scene/looks.h"

namespace scene {

// What a random number is for. Distinct values keep choices independent of each other.
enum Salt : std::uint64_t {
    salt_person = 1,  // the gathering's own
    salt_seat,
    salt_lane,
    salt_place,
    salt_density,
    salt_looks,
    salt_height,
    salt_yaw,
};

// Where somebody is, and as whom.
struct Spot {
    glm::vec3 position{0.0f};  // [m] from their block's origin, of the floor that they stand on; of walkers and runners
                               // as Crowd::position has it
    float yaw = 0;             // [rad]
    float height = 1.7f;       // [m]
    std::uint8_t character = 0;  // into Audience::cast
    Role role = Role::standing;
    float around = 0;  // as Crowd::around has it
    Fans fans{0, 0};   // among whom they are
};

struct Gathering {
    const Audience audience;
    Crowd crowd;  // so far

    // `path`: Crowd::path.
    Gathering(const Audience& of, std::shared_ptr<const Path> path);

    // Random bits for element `which` of what `salt` says.
    std::uint64_t bits(Salt salt, std::uint64_t which) const;
    std::uint8_t draw_character(std::uint64_t from) const;

    // [m] How much higher than on the floor somebody's origin is on a seat that is seat_height above it, so that the
    // tall and the short rest on it alike: their feet may be some centimetres in or above the floor. Nothing for who
    // can't sit.
    float seat_lift(std::uint8_t character, float height) const;

    static constexpr float widest_block = 8'192;  // [m] from its origin

    // People are added to the open block, as far from `origin` [m, world] as their spots say: best a kilometre or two
    // (docs/precision.md). One that is closed with nobody in it is dropped. close_block() throws std::invalid_argument
    // if anybody may be farther from it than widest_block.
    void open_block(const glm::dvec3& origin = glm::dvec3(0.0));
    void add(const Spot& spot);
    void close_block();

private:
    std::vector<double> sums_;  // of the weights up to each character's; none if all are as many
    motion::Bounds reach_of(std::size_t person) const;
};

}  // namespace scene
