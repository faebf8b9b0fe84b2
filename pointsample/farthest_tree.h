// Candidates in a flat implicit tree that knows how far each is from its nearest point, and which is to come next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pointsample/candidates.h"
#include "pointsample/float4.h"

namespace pointsample {

// Normals whose cosine is below `opposed_cosine` oppose, and make a distance `opposed_factor` times as long.
inline constexpr float opposed_cosine = -0.7f, opposed_factor = 2.0f;

// Distances are Euclid's, twice that where the faces' normals oppose (cosine below -0.7): so the two sides of a thin
// sheet hardly see each other. A candidate's key is its squared distance to the nearest point times its stretch: where
// a surface stretches to s times its area, points are to be sqrt(s) times as near to each other.
// There are two kinds.
// - Without `takes_back` the tree evens out density: where a node has more points than its share, say 1 % more, the
// keys
//   below it count as 1 % smaller, so that the next points go elsewhere. 2 % at most.
// - With it the tree knows which point is nearest to each candidate, so that points can be taken back.
template <bool takes_back>
class FarthestTree {
public:
    // Keeps a reference to padded candidates, and its distances in their leaves.
    explicit FarthestTree(Candidates& candidates);

    // The largest squared distance of a candidate; infinite before the first point, negative when all are points.
    float farthest() const { return largest(levels_.back()[0].farthest); }

    // The candidate of the largest key; the first of several.
    std::size_t next();

    // Of a candidate that is no point.
    float key(std::size_t candidate) const;

    // Makes a point of the candidate. Time is that of the leaves that the point is nearest to.
    void choose(std::size_t candidate);

    // The same for a point that is none of the candidates (Surface::scaled).
    void cover(const Place& point) requires(!takes_back);

    // Makes a mere candidate of the point. At least one other must be left.
    void unchoose(std::size_t candidate) requires takes_back;

    // Whether another point is so near to the point that its key, were it a candidate, would be below `key`.
    bool is_crowded(std::size_t candidate, float key) const requires takes_back;

private:
    static constexpr std::size_t fan = 8, fan_bits = 3, leaf_rows = leaf_size / 4, family_rows = fan / 4;
    static constexpr float chosen = -1.0f, padding = -2.0f;  // in place of a squared distance

    // Boxes of sister nodes, and the largest within each.
    struct alignas(64) Family {
        Row<family_rows> low_x, low_y, low_z, high_x, high_y, high_z;
        Row<family_rows> farthest;  // squared distance
        Row<family_rows> key;       // with the biases of all nodes below and of the node itself
        Row<family_rows> inner;     // key without the node's own bias
        Row<family_rows> points, candidates;
        Family();
    };
    // A point to measure from, in all four lanes.
    struct From {
        Float4 x, y, z, nx, ny, nz;
        explicit From(const Place& place);
    };
    struct Maxima {
        float farthest, key;
    };

    void add_lowest_level();
    void add_level();
    Row<leaf_rows> keys(std::size_t leaf) const;
    float bias(const Family& family, std::size_t i) const;
    float rebias(std::size_t level, std::size_t index);

    static Row<family_rows> squared_gaps(const Family& family, const From& p);
    Maxima update_family(std::size_t level, std::size_t index, const From& p);
    Maxima update_leaf(std::size_t index, const From& p);
    static void prefetch(const Leaf& leaf);

    bool adopt_orphans(const From& p, float radius);
    void gather(std::size_t level, std::size_t index, const From& p, float squared_radius);
    void gather_leaf(std::size_t index, const From& p, float squared_radius);
    Maxima refresh(std::size_t level, std::size_t index, const From& p, float squared_radius);
    float seen(std::size_t a, std::size_t b) const;
    bool has_point_near(std::size_t level, std::size_t index, const From& p, std::size_t self, float squared) const;

    std::vector<Leaf>& leaves_;
    const std::vector<LeafNormals>& normals_;
    std::vector<std::vector<Family>> levels_;  // from the leaves up
    float count_;                              // candidates
    float points_ = 0, rebias_at_;
    std::size_t current_ = 0;             // candidate that is being chosen or taken back
    std::vector<std::uint32_t> nearest_;  // point of each candidate, if takes_back
    std::vector<std::uint32_t> near_points_, orphans_;
};

extern template class FarthestTree<false>;
extern template class FarthestTree<true>;

}  // namespace pointsample
