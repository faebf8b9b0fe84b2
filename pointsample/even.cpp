#include "pointsample/even.h"

#include <algorithm>

#include "pointsample/farthest_tree.h"

namespace pointsample {
namespace {

constexpr int most_rounds = 16;
// Points with no other within so many times the spacing stay. Nearly all must be free to move: with only those below
// the spacing free, it gets stuck at 0.73 d_max.
constexpr float loose = 1.3f;

// Whether all that were moved ended up at a key of `enough` or more. The last points of a farthest-point order have the
// nearest neighbours, so they go first.
bool move_all(FarthestTree<true>& tree, std::vector<std::uint32_t>& points, float enough, bool& moved) {
    bool done = true;
    for (std::size_t i = points.size(); i-- > 0;) {
        if (!tree.is_crowded(points[i], enough * loose * loose)) continue;
        tree.unchoose(points[i]);
        const std::size_t hole = tree.next();
        if (tree.key(hole) > tree.key(points[i])) {
            points[i] = static_cast<std::uint32_t>(hole);
            moved = true;
        }
        if (tree.key(points[i]) < enough) done = false;
        tree.choose(points[i]);
    }
    return done;
}

}  // namespace

std::vector<std::uint32_t> make_even(Candidates& candidates, std::vector<std::uint32_t> points, float spacing,
                                     const std::function<void(double)>& progress) {
    if (points.size() < 2) return points;
    FarthestTree<true> tree(candidates);
    for (const std::uint32_t point : points) tree.choose(point);
    for (int round = 0; round < most_rounds; ++round) {
        bool moved = false;
        const bool done = move_all(tree, points, spacing * spacing, moved);
        if (progress) progress(1 - 0.5 / (round + 1));
        if (done || !moved) break;
    }
    return points;
}

}  // namespace pointsample
