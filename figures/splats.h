// A very far person as one splat: what their silhouette covers and the mean light that it sends, from tables by pose
// and direction. Whole blocks of people are drawn so, and nobody alone: nothing is sorted or written for each.
#pragma once

#include <cstdint>
#include <vector>

#include "figures/representation.h"

namespace figures {

// The greatest demand that one splat serves: a person of two and a quarter pixels of height, at S = 1 px.
inline constexpr float splat_reach = 4.0f;

// One, or none of a character with more clips than SplatKeys tells apart.
std::vector<Level> splat_levels(const Figure& figure);

// All of a person is where their splat is: half the side of their silhouette.
constexpr double splat_outline_px(double, double silhouette) {
    return 0.5 * silhouette;
}

inline constexpr Representation splats{"splats", false, splat_levels, splat_outline_px, /* is_by_block */ true};

// The poses that tables of splats are made for: some of each clip's, evenly spread.
struct SplatKeys {
    std::vector<int> poses;             // of each key, into the PoseTable; none if a byte can't tell them apart
    std::vector<std::uint8_t> of_pose;  // the key that is next to each pose
};
SplatKeys splat_keys(const motion::PoseTable& poses);

}  // namespace figures
