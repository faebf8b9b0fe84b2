#include "pointsample/farthest_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointsample {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();

// Where normals oppose. Factor 1 starves the sides of a sheet of each other, 3 lets points across it come too near.
constexpr float opposed_squared = opposed_factor * opposed_factor;

// Level density: the most that a key gives way, for regions with so many points due. More costs distance point by
// point.
constexpr float most_bias = 0.02f, fewest_due = 8, most_due = 512;
// Biases are brought up to date when there are so many times the points, from so many on.
constexpr float rebias_growth = 1.02f, first_rebias = 64;

}  // namespace

template <bool takes_back>
FarthestTree<takes_back>::Family::Family() {
    for (Row<family_rows>* row : {&low_x, &low_y, &low_z}) row->fill(infinity);
    for (Row<family_rows>* row : {&high_x, &high_y, &high_z}) row->fill(-infinity);
    for (Row<family_rows>* row : {&farthest, &key, &inner}) row->fill(padding);
    for (Row<family_rows>* row : {&points, &candidates}) row->fill(0.0f);
}

template <bool takes_back>
FarthestTree<takes_back>::From::From(const Place& place)
    : x(all(place.position.x)),
      y(all(place.position.y)),
      z(all(place.position.z)),
      nx(all(place.normal.x)),
      ny(all(place.normal.y)),
      nz(all(place.normal.z)) {}

template <bool takes_back>
FarthestTree<takes_back>::FarthestTree(Candidates& candidates)
    : leaves_(candidates.leaves),
      normals_(candidates.normals),
      count_(static_cast<float>(candidates.count)),
      rebias_at_(takes_back ? infinity : first_rebias) {
    if (takes_back) nearest_.resize(leaves_.size() * leaf_size);
    for (Leaf& leaf : leaves_) leaf.distance.fill(infinity);
    for (std::size_t i = candidates.count; i < leaves_.size() * leaf_size; ++i)
        leaves_[i / leaf_size].distance[i % leaf_size] = padding;
    add_lowest_level();
    while (levels_.back().size() > 1) add_level();
}

template <bool takes_back>
void FarthestTree<takes_back>::add_lowest_level() {
    std::vector<Family>& level = levels_.emplace_back((leaves_.size() + fan - 1) / fan);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        const Leaf& leaf = leaves_[i];
        Family& family = level[i / fan];
        const std::size_t k = i % fan;
        family.low_x[k] = smallest(leaf.x), family.high_x[k] = largest(leaf.x);
        family.low_y[k] = smallest(leaf.y), family.high_y[k] = largest(leaf.y);
        family.low_z[k] = smallest(leaf.z), family.high_z[k] = largest(leaf.z);
        family.farthest[k] = family.key[k] = family.inner[k] = largest(leaf.distance);
        family.candidates[k] = leaf_size;
    }
}

template <bool takes_back>
void FarthestTree<takes_back>::add_level() {
    const std::vector<Family>& below = levels_.back();
    std::vector<Family> level((below.size() + fan - 1) / fan);
    for (std::size_t i = 0; i < below.size(); ++i) {
        const Family& from = below[i];
        Family& to = level[i / fan];
        const std::size_t k = i % fan;
        to.low_x[k] = smallest(from.low_x), to.high_x[k] = largest(from.high_x);
        to.low_y[k] = smallest(from.low_y), to.high_y[k] = largest(from.high_y);
        to.low_z[k] = smallest(from.low_z), to.high_z[k] = largest(from.high_z);
        to.farthest[k] = to.key[k] = to.inner[k] = largest(from.farthest);
        for (std::size_t j = 0; j < fan; ++j) to.candidates[k] += from.candidates[j];
    }
    levels_.push_back(std::move(level));
}

template <bool takes_back>
Row<FarthestTree<takes_back>::leaf_rows> FarthestTree<takes_back>::keys(std::size_t leaf) const {
    Row<leaf_rows> keys;
    for (std::size_t i = 0; i < leaf_rows; ++i)
        keys.four[i] = leaves_[leaf].distance.four[i] * normals_[leaf].stretch.four[i];
    return keys;
}

template <bool takes_back>
float FarthestTree<takes_back>::key(std::size_t candidate) const {
    const std::size_t leaf = candidate / leaf_size, i = candidate % leaf_size;
    return leaves_[leaf].distance[i] * normals_[leaf].stretch[i];
}

// Candidates have equal areas, so that a node is due its share of them in points.
template <bool takes_back>
float FarthestTree<takes_back>::bias(const Family& family, std::size_t i) const {
    if (takes_back) return 1;
    const float due = points_ * family.candidates[i] / count_;
    if (due < fewest_due || due >= most_due) return 1;
    return 1 - std::clamp((family.points[i] - due) / due, -most_bias, most_bias);
}

template <bool takes_back>
float FarthestTree<takes_back>::rebias(std::size_t l, std::size_t index) {
    Family& family = levels_[l][index];
    if (l > 0)
        for (std::size_t i = 0; i < fan; ++i) {
            if (!(family.candidates[i] > 0)) continue;
            family.inner[i] = rebias(l - 1, index * fan + i);
            family.key[i] = family.inner[i] * bias(family, i);
        }
    return largest(family.key);
}

template <bool takes_back>
std::size_t FarthestTree<takes_back>::next() {
    if (points_ >= rebias_at_) {
        rebias(levels_.size() - 1, 0);
        rebias_at_ = points_ * rebias_growth;
    }
    std::size_t node = 0;
    for (std::size_t l = levels_.size(); l-- > 0;) {
        const Row<family_rows>& key = levels_[l][node].key;
        node = node * fan + first_of(key, largest(key));
    }
    const Row<leaf_rows> within = keys(node);
    return node * leaf_size + first_of(within, largest(within));
}

template <bool takes_back>
void FarthestTree<takes_back>::choose(std::size_t candidate) {
    const std::size_t leaf = candidate / leaf_size, i = candidate % leaf_size;
    current_ = candidate;
    ++points_;
    leaves_[leaf].distance[i] = chosen;
    const Leaf& at = leaves_[leaf];
    const LeafNormals& normal = normals_[leaf];
    const Place place{{at.x[i], at.y[i], at.z[i]}, {normal.x[i], normal.y[i], normal.z[i]}};
    update_family(levels_.size() - 1, 0, From(place));
}

template <bool takes_back>
void FarthestTree<takes_back>::cover(const Place& point) requires(!takes_back) {
    current_ = nobody;
    update_family(levels_.size() - 1, 0, From(point));
}

template <bool takes_back>
Row<FarthestTree<takes_back>::family_rows> FarthestTree<takes_back>::squared_gaps(const Family& family, const From& p) {
    Row<family_rows> gaps;
    const Float4 zero = all(0.0f);
    for (std::size_t i = 0; i < family_rows; ++i) {
        const Float4 dx = larger(larger(family.low_x.four[i] - p.x, p.x - family.high_x.four[i]), zero);
        const Float4 dy = larger(larger(family.low_y.four[i] - p.y, p.y - family.high_y.four[i]), zero);
        const Float4 dz = larger(larger(family.low_z.four[i] - p.z, p.z - family.high_z.four[i]), zero);
        gaps.four[i] = dx * dx + dy * dy + dz * dz;
    }
    return gaps;
}

// Brings the distances below a family up to date. Only boxes that are nearer to the point than something within is to
// its nearest are entered.
template <bool takes_back>
typename FarthestTree<takes_back>::Maxima FarthestTree<takes_back>::update_family(std::size_t l, std::size_t index,
                                                                                  const From& p) {
    Family& family = levels_[l][index];
    Row<family_rows> slack = squared_gaps(family, p);
    for (std::size_t i = 0; i < family_rows; ++i) slack.four[i] = family.farthest.four[i] - slack.four[i];
    const std::size_t first = index * fan;
    if (l == 0) {
        for (std::size_t i = 0; i < fan; ++i)
            if (slack[i] >= 0) prefetch(leaves_[first + i]);
        for (std::size_t i = 0; i < fan; ++i) {
            if (!(slack[i] >= 0)) continue;
            const Maxima within = update_leaf(first + i, p);
            family.farthest[i] = within.farthest;
            family.key[i] = within.key;
        }
    } else {
        const std::size_t current = current_ / leaf_size >> (fan_bits * l);
        for (std::size_t i = 0; i < fan; ++i) {
            if (!(slack[i] >= 0)) continue;
            const Maxima within = update_family(l - 1, first + i, p);
            if (first + i == current) family.points[i] += 1;
            family.farthest[i] = within.farthest;
            family.inner[i] = within.key;
            family.key[i] = within.key * bias(family, i);
        }
    }
    return {largest(family.farthest), largest(family.key)};
}

template <bool takes_back>
void FarthestTree<takes_back>::prefetch(const Leaf& leaf) {
    const char* at = reinterpret_cast<const char*>(&leaf);
    for (std::size_t i = 0; i < sizeof(Leaf); i += 64) __builtin_prefetch(at + i);
}

template <bool takes_back>
typename FarthestTree<takes_back>::Maxima FarthestTree<takes_back>::update_leaf(std::size_t index, const From& p) {
    Leaf& leaf = leaves_[index];
    Row<leaf_rows> squared, gain;
    for (std::size_t i = 0; i < leaf_rows; ++i) {
        const Float4 dx = leaf.x.four[i] - p.x, dy = leaf.y.four[i] - p.y, dz = leaf.z.four[i] - p.z;
        squared.four[i] = dx * dx + dy * dy + dz * dz;
        gain.four[i] = leaf.distance.four[i] - squared.four[i];
    }
    if (largest(gain) > 0) {  // only then are normals needed
        const LeafNormals& normals = normals_[index];
        const Float4 cosine_limit = all(opposed_cosine), factor = all(opposed_squared);
        for (std::size_t i = 0; i < leaf_rows; ++i) {
            const Float4 cosine = normals.x.four[i] * p.nx + normals.y.four[i] * p.ny + normals.z.four[i] * p.nz;
            const Float4 distance = cosine < cosine_limit ? squared.four[i] * factor : squared.four[i];
            if constexpr (takes_back)
                for (std::size_t k = 0; k < 4; ++k)
                    if (distance[k] < leaf.distance.four[i][k])
                        nearest_[index * leaf_size + 4 * i + k] = static_cast<std::uint32_t>(current_);
            leaf.distance.four[i] = smaller(distance, leaf.distance.four[i]);
        }
    }
    return {largest(leaf.distance), largest(keys(index))};
}

// The squared distance of two candidates.
template <bool takes_back>
float FarthestTree<takes_back>::seen(std::size_t a, std::size_t b) const {
    const Leaf &p = leaves_[a / leaf_size], &q = leaves_[b / leaf_size];
    const LeafNormals &n = normals_[a / leaf_size], &m = normals_[b / leaf_size];
    const std::size_t i = a % leaf_size, k = b % leaf_size;
    const float dx = p.x[i] - q.x[k], dy = p.y[i] - q.y[k], dz = p.z[i] - q.z[k];
    const float cosine = n.x[i] * m.x[k] + n.y[i] * m.y[k] + n.z[i] * m.z[k];
    const float squared = dx * dx + dy * dy + dz * dz;
    return cosine < opposed_cosine ? squared * opposed_squared : squared;
}

// Collects, within the radius, the points, and the candidates that had the current one as their nearest.
template <bool takes_back>
void FarthestTree<takes_back>::gather(std::size_t l, std::size_t index, const From& p, float squared_radius) {
    const Row<family_rows> gaps = squared_gaps(levels_[l][index], p);
    for (std::size_t i = 0; i < fan; ++i) {
        if (!(gaps[i] <= squared_radius)) continue;
        if (l > 0)
            gather(l - 1, index * fan + i, p, squared_radius);
        else
            gather_leaf(index * fan + i, p, squared_radius);
    }
}

template <bool takes_back>
void FarthestTree<takes_back>::gather_leaf(std::size_t index, const From& p, float squared_radius) {
    const Leaf& leaf = leaves_[index];
    for (std::size_t r = 0; r < leaf_rows; ++r) {
        const Float4 dx = leaf.x.four[r] - p.x, dy = leaf.y.four[r] - p.y, dz = leaf.z.four[r] - p.z;
        const Float4 squared = dx * dx + dy * dy + dz * dz;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t candidate = static_cast<std::uint32_t>(index * leaf_size + 4 * r + k);
            const float distance = leaf.distance.four[r][k];
            if (distance == chosen && squared[k] <= squared_radius) near_points_.push_back(candidate);
            if (distance >= 0 && nearest_[candidate] == current_) orphans_.push_back(candidate);
        }
    }
}

// Gives the candidates that the current point was nearest to their nearest among the points within the radius of it;
// false, and nothing done, if one beyond might be nearer.
template <bool takes_back>
bool FarthestTree<takes_back>::adopt_orphans(const From& p, float radius) {
    near_points_.clear();
    orphans_.clear();
    gather(levels_.size() - 1, 0, p, radius * radius);
    std::vector<std::pair<float, std::uint32_t>> adopted;
    adopted.reserve(orphans_.size());
    for (const std::uint32_t orphan : orphans_) {
        std::pair<float, std::uint32_t> least{infinity, 0};
        for (const std::uint32_t point : near_points_) least = std::min(least, {seen(orphan, point), point});
        const Leaf& leaf = leaves_[orphan / leaf_size];
        const std::size_t i = orphan % leaf_size;
        const float dx = leaf.x[i] - p.x[0], dy = leaf.y[i] - p.y[0], dz = leaf.z[i] - p.z[0];
        const float beyond = radius - std::sqrt(dx * dx + dy * dy + dz * dz);
        if (!(std::sqrt(least.first) <= beyond)) return false;
        adopted.push_back(least);
    }
    for (std::size_t i = 0; i < orphans_.size(); ++i) {
        leaves_[orphans_[i] / leaf_size].distance[orphans_[i] % leaf_size] = adopted[i].first;
        nearest_[orphans_[i]] = adopted[i].second;
    }
    return true;
}

// Takes the largest within up from the leaves within the radius.
template <bool takes_back>
typename FarthestTree<takes_back>::Maxima FarthestTree<takes_back>::refresh(std::size_t l, std::size_t index,
                                                                            const From& p, float squared_radius) {
    Family& family = levels_[l][index];
    const Row<family_rows> gaps = squared_gaps(family, p);
    for (std::size_t i = 0; i < fan; ++i) {
        if (!(gaps[i] <= squared_radius)) continue;
        const std::size_t child = index * fan + i;
        const Maxima within = l == 0 ? Maxima{largest(leaves_[child].distance), largest(keys(child))}
                                     : refresh(l - 1, child, p, squared_radius);
        family.farthest[i] = within.farthest;
        family.key[i] = within.key;
    }
    return {largest(family.farthest), largest(family.key)};
}

template <bool takes_back>
void FarthestTree<takes_back>::unchoose(std::size_t candidate) requires takes_back {
    const std::size_t leaf = candidate / leaf_size, i = candidate % leaf_size;
    const LeafNormals& normal = normals_[leaf];
    const From p(
        Place{{leaves_[leaf].x[i], leaves_[leaf].y[i], leaves_[leaf].z[i]}, {normal.x[i], normal.y[i], normal.z[i]}});
    current_ = candidate;
    --points_;
    constexpr float least_reach = 1e-6f;                               // so that the radius can grow
    const float reach = std::max(std::sqrt(farthest()), least_reach);  // no orphan is farther away
    leaves_[leaf].distance[i] = 0;
    nearest_[candidate] = static_cast<std::uint32_t>(candidate);  // an orphan itself
    for (float radius = 2.2f * reach; !adopt_orphans(p, radius);) radius *= 1.5f;
    refresh(levels_.size() - 1, 0, p, reach * reach * 1.0001f);
}

template <bool takes_back>
bool FarthestTree<takes_back>::is_crowded(std::size_t candidate, float key) const requires takes_back {
    const std::size_t leaf = candidate / leaf_size, i = candidate % leaf_size;
    const From p(Place{{leaves_[leaf].x[i], leaves_[leaf].y[i], leaves_[leaf].z[i]}, glm::vec3(0)});
    return has_point_near(levels_.size() - 1, 0, p, candidate, key / normals_[leaf].stretch[i]);
}

template <bool takes_back>
bool FarthestTree<takes_back>::has_point_near(std::size_t l, std::size_t index, const From& p, std::size_t self,
                                              float squared) const {
    const Row<family_rows> gaps = squared_gaps(levels_[l][index], p);
    for (std::size_t i = 0; i < fan; ++i) {
        if (!(gaps[i] < squared)) continue;
        const std::size_t child = index * fan + i;
        if (l > 0) {
            if (has_point_near(l - 1, child, p, self, squared)) return true;
            continue;
        }
        const Row<leaf_rows>& distance = leaves_[child].distance;
        for (std::size_t k = 0; k < leaf_size; ++k) {
            const std::size_t candidate = child * leaf_size + k;
            if (distance[k] == chosen && candidate != self && seen(self, candidate) < squared) return true;
        }
    }
    return false;
}

template class FarthestTree<false>;
template class FarthestTree<true>;

}  // namespace pointsample
