#include "figures/representation.h"

#include <algorithm>
#include <cmath>

#include "figures/points.h"
#include "figures/triangles.h"

namespace figures {

namespace {

constexpr std::array<double, sfsm::work_kinds> believed_pieces = [] {
    std::array<double, sfsm::work_kinds> pieces{};
    for (std::size_t kind = 0; kind < sfsm::work_kinds; ++kind) pieces[kind] = sfsm::work_table[kind].prior.pieces;
    return pieces;
}();

}  // namespace

Part part_of(const Level& level, float demand) {
    if (!level.by_ones) return {level.count, 1.0f, level.work};
    constexpr float fewest = 4;  // of fewer none may show
    const float samples = std::clamp(demand, std::min(fewest, static_cast<float>(level.count)), static_cast<float>(level.count));
    const auto count = static_cast<std::uint32_t>(std::ceil(samples));
    Part part{count, samples - static_cast<float>(count - 1), {}};
    part.work[sfsm::WorkKind::point] = count;
    return part;
}

const Way& by_opengl() {
    static constexpr Representation list[] = {triangles, points};
    static constexpr Way way{"gl", list, believed_pieces};
    return way;
}

const Way& natively() {
    static constexpr Representation list[] = {triangles, native_points};
    static constexpr Way way{"native", list, [] {
        std::array<double, sfsm::work_kinds> pieces = believed_pieces;
        pieces[sfsm::index_of(sfsm::WorkKind::point)] = 0.15;
        return pieces;
    }()};
    return way;
}

}  // namespace figures
