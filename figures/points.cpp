#include "figures/points.h"

#include "pointsample/prefix_ladder.h"
#include "pointsample/prefix_look.h"

namespace figures {

namespace {

constexpr std::uint32_t first_rung = 1;  // two points: about one of them faces the camera
constexpr std::uint32_t last_rung = 31;  // 65,536 points
constexpr std::uint32_t longest_averaged_prefix = 32;
// Of a handful of points none may happen to face the camera.
constexpr std::uint32_t longest_two_sided_prefix = 8;

// The rungs that a model of so many points has.
std::vector<std::uint32_t> prefixes(std::size_t point_count) {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t rung = first_rung; rung <= last_rung; ++rung) {
        const std::uint32_t count = pointsample::points_of_rung(rung);
        if (count <= point_count) counts.push_back(count);
    }
    return counts;
}

std::array<std::uint8_t, model::slot_count> all_of(model::Slot slot) {
    std::array<std::uint8_t, model::slot_count> shares{};
    if (slot != model::no_slot) shares[std::size_t{slot} - 1] = 255;
    return shares;
}

}  // namespace

std::vector<Level> point_levels(const Figure& figure) {
    std::vector<Level> levels;
    std::uint32_t first = 0;
    for (const std::uint32_t count : prefixes(static_cast<std::size_t>(figure.poses->point_count))) {
        Level& level = levels.emplace_back();
        level.work[sfsm::WorkKind::single] = 1;
        level.work[sfsm::WorkKind::point] = count;
        level.reach = static_cast<float>(count);
        level.first = first;
        level.count = count;
        if (count <= longest_averaged_prefix) first += count;  // longer ones begin together, behind these
    }
    return levels;
}

std::vector<Level> native_point_levels(const Figure& figure) {
    const auto all = static_cast<std::uint32_t>(figure.poses->point_count);
    std::vector<std::uint32_t> counts = prefixes(all);
    std::erase_if(counts, [](std::uint32_t count) { return count < fewest_points; });
    if (all > 0 && (counts.empty() || counts.back() < all)) counts.push_back(all);
    std::vector<Level> levels;
    for (const std::uint32_t count : counts) {
        Level& level = levels.emplace_back();
        level.work[sfsm::WorkKind::single] = 1;
        level.work[sfsm::WorkKind::point] = count;
        level.reach = static_cast<float>(count);
        level.count = count;
        level.by_ones = true;
    }
    return levels;
}

std::vector<PointLook> point_looks(const Figure& figure) {
    const pointsample::PointModel& model = *figure.points;
    std::vector<PointLook> looks;
    for (const std::uint32_t count : prefixes(model.size())) {
        if (count > longest_averaged_prefix) break;
        std::uint32_t point = 0;
        for (const pointsample::PrefixLook& look : pointsample::prefix_looks(model, count))
            looks.push_back({point++, look.color, look.shares, look.own_light, count <= longest_two_sided_prefix});
    }
    for (std::uint32_t point = 0; point < model.size(); ++point)
        looks.push_back({point, model.colors[point], all_of(model.slots[point]),
                         model.own_lights.empty() ? glm::u8vec4(0) : model.own_lights[point], false});
    return looks;
}

}  // namespace figures
