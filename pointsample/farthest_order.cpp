#include "pointsample/farthest_order.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "pointsample/farthest_tree.h"

namespace pointsample {

FarthestOrder farthest_order(Candidates& candidates, std::size_t count, std::span<const std::uint32_t> first,
                             std::span<const std::uint32_t> marks, const std::function<void(double)>& progress) {
    assert(!first.empty() && first.size() <= count && count <= candidates.count);
    constexpr std::size_t progress_step = 1024;
    FarthestTree<false> tree(candidates);
    FarthestOrder order;
    order.candidates.reserve(count);
    order.spacing.reserve(count);
    float spacing = std::numeric_limits<float>::infinity();
    while (order.candidates.size() < count) {
        const std::size_t taken = order.candidates.size(), next = taken < first.size() ? first[taken] : tree.next();
        spacing = std::min(spacing, std::sqrt(tree.key(next)));
        order.candidates.push_back(static_cast<std::uint32_t>(next));
        order.spacing.push_back(spacing);
        tree.choose(next);
        const std::size_t size = order.candidates.size();
        if (order.radius.size() < marks.size() && size == marks[order.radius.size()])
            order.radius.push_back(std::sqrt(std::max(tree.farthest(), 0.0f)));
        if (progress && size % progress_step == 0) progress(static_cast<double>(size) / static_cast<double>(count));
    }
    return order;
}

}  // namespace pointsample
