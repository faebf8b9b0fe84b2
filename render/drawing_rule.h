// How a frame's people are drawn: decided for all of them, then asked person by person, by several threads at once.
#pragma once

#include <cstdint>
#include <limits>

#include "figures/choices.h"
#include "scene/crowd.h"

namespace render {

// Who is asked about: somebody alone, or the mean of a block's people of a character.
struct Subject {
    std::size_t character = 0;
    scene::Role role{};
    float depth = 0;             // [m] view depth
    float pixels_per_metre = 0;  // there
    float surface = 0;           // [px^2] of all of it; infinite of who is too near to be simplified
    float demand = 0;            // at S = 1 px (figures/representation.h)
    float place = 0;             // Exchange::place_of the share of them that others leave to be seen
    bool is_block = false;       // of all in a block that may be drawn as one
    // [model units] How far off their surface may be drawn at most: of a block whoever of it is nearest and largest.
    float allowed = std::numeric_limits<float>::infinity();
};

class DrawingRule {
public:
    virtual ~DrawingRule() = default;

    struct Shape {
        std::uint32_t choice = 0;  // into Choices::all() of the character
        float samples = 0;         // that are asked of it: figures::part_of
    };
    virtual Shape shape_of(const Subject& subject) const = 0;

    // Whether one splat serves people of a block.
    virtual bool is_splat(const Subject& subject) const = 0;

    // [ticks] How often they move, in [1, motion::max_period].
    virtual int period_of(const Subject& subject) const = 0;

    // S [px] of the frame: of points that have a size, and of the cells that others are added up in.
    virtual double splat_size() const = 0;
};

}  // namespace render
