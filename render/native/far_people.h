// People who are so far away that each is one splat: drawn block by block, straight from the crowd's arrays.
//
// A block is laid down as one person is who is drawn as points: its people are added up in a patch, where their areas
// add, and the patch goes behind what is in the tile already.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "figures/splats.h"
#include "render/frame.h"
#include "render/native/far_looks.h"
#include "render/native/near_layer.h"
#include "render/native/splat.h"
#include "scene/light.h"

namespace render::native {

// [cells] Who is higher is two splats, one above the other.
inline constexpr float lowest_tall = 1.25f;

// A block as it is drawn.
struct FarBlockOnScreen : InDepth {
    std::int32_t character;        // of all its people; < 0: they are of several
    std::uint32_t first, count;    // people
    std::array<glm::vec3, 2> eye;  // [m] the camera from its origin: the nearest floats, and what they lack
    std::array<float, 3> leaning;  // of red, green, blue: 12 times Leaning's lean over its mean
    bool in_rows;
    bool is_tall;                 // somebody may be two splats
    std::int16_t x0, y0, x1, y1;  // [cells] what they may touch

    Rect cells() const { return {x0, y0, x1, y1}; }
    float nearest() const { return depth - reach; }  // [m] view depth
};

// What becomes of areas that fell on a cell, by how much they are together, in steps of 2^far_cover_shift.
inline constexpr int far_cover_shift = 6;
struct FarCover {
    using Table = std::array<std::int16_t, (32768 >> far_cover_shift)>;
    Table covered;  // the share of them that covers the cell, 32767 = all
    Table upper;    // how much people's upper parts prevail in what shows, 32767 = they alone
};

// The same for all blocks.
struct FarScene {
    FarPeople people;
    glm::vec3 right, up, forward;
    float cells_at_one_metre;     // that a metre covers at a depth of one
    std::array<float, 2> center;  // [cells] the picture's
    std::array<float, 2> to_sun;  // its x and z, world
    FarCover scattered, in_rows;  // of people who stand anywhere, and who sit in rows
    // By character.
    std::vector<float> metres;                        // [1 / model units] a person's scale by their height
    std::vector<float> center_x, center_y, center_z;  // [model units]
    std::vector<float> height;                        // [model units] of a box whose points vary as theirs do
    std::vector<float> largest_silhouette;            // [model units^2]
    std::vector<std::int32_t> first_key;              // of its keys among all
    Array<std::int16_t> rows;                         // FarLooks'
};

class FarCrowd {
public:
    // `figures` must outlive it.
    FarCrowd(std::span<const figures::Figure> figures, const scene::Light& light);

    // What everybody is drawn from. `models`: a character each, null where nobody of it is ever in a far block.
    void learn(std::span<const SplatModel* const> models);
    std::size_t characters() const { return figures_.size(); }
    // Whether anybody of it may be in a far block.
    bool can_draw(std::size_t character) const { return !figures::splat_levels(figures_[character]).empty(); }
    bool knows() const { return !scene_.rows.empty(); }

    // Of one frame, the nearest first; `cell` [px]. After learn(). A crowd stays as it is while frames of it are drawn.
    void prepare(const Frame& frame, float cell);
    std::span<const FarBlockOnScreen> blocks() const { return blocks_; }
    std::span<const Rect> bounds() const { return bounds_; }  // [px] that each may touch

    // Adds a block up in a patch that is all 0.
    void splat(const FarBlockOnScreen& block, const Patch& patch) const;

    // It will be drawn soon.
    void prefetch(const FarBlockOnScreen& block) const;

private:
    void look_at(const scene::Crowd& crowd);
    FarBlockOnScreen ready(const View& world, const FarBlock& block) const;

    // What a block's people are like.
    struct Look {
        std::size_t character = 0;                              // of most of them
        bool is_mixed = false;                                  // not of all
        std::array<glm::vec3, 1 + model::slot_count> colors{};  // linear mean of theirs, by slot
    };
    std::array<float, 3> leaning_of(const Look& look, float ring) const;
    static Look look_of(const scene::Crowd& crowd, const scene::CrowdBlock& block);

    std::vector<figures::Figure> figures_;
    std::vector<std::array<Leaning, rings>> leanings_;  // by character
    const scene::Crowd* crowd_ = nullptr;               // whose looks are known
    std::vector<Look> looks_;                           // by Crowd::blocks
    FarScene scene_;
    std::vector<FarBlock> by_depth_;
    std::vector<FarBlockOnScreen> blocks_;
    std::vector<Rect> bounds_;
};

}  // namespace render::native
