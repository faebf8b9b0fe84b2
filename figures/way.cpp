#include "figures/way.h"

#include "figures/points.h"
#include "figures/triangles.h"

namespace figures {

namespace {

constexpr std::array<double, sfsm::work_kinds> believed_pieces = [] {
    std::array<double, sfsm::work_kinds> pieces{};
    for (std::size_t kind = 0; kind < sfsm::work_kinds; ++kind) pieces[kind] = sfsm::work_table[kind].prior.pieces;
    return pieces;
}();

constexpr std::array<double, sfsm::work_kinds> native_pieces = [] {
    std::array<double, sfsm::work_kinds> pieces = believed_pieces;
    pieces[sfsm::index_of(sfsm::WorkKind::point)] = 0.15;
    return pieces;
}();

}  // namespace

const Way& by_opengl() {
    static constexpr Representation list[] = {triangles, points};
    static constexpr Way way{"gl", list, believed_pieces};
    return way;
}

const Way& natively() {
    static constexpr Representation list[] = {triangles, native_points};
    static constexpr Way way{"native", list, native_pieces};
    return way;
}

}  // namespace figures
