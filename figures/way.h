// A way of drawing: by what device, and so as what people can be drawn, and what that is believed to cost.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "figures/representation.h"

namespace figures {

struct Way {
    std::string_view name;
    std::span<const Representation> representations;  // in the order in which they are drawn and numbered
    std::array<double, sfsm::work_kinds> pieces;      // that one of each kind of work is believed to cost (sfsm/work.h)
};

const Way& by_opengl();
const Way& natively();

}  // namespace figures
