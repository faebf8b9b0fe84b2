#include "sfsm/rivals/rivals.h"

#include <array>
#include <stdexcept>
#include <string>

#include "sfsm/rivals/laws.h"

namespace sfsm {
namespace {

struct Rival {
    std::string_view name;
    std::unique_ptr<Controller> (*make)();
};

constexpr std::array rivals = {
    Rival{"filament", make_filament},
    Rival{"intel", make_intel},
    Rival{"darkplaces", make_darkplaces},
    Rival{"minetest", make_minetest},
    Rival{"unreal-like", make_unreal_like},
    Rival{"valve", make_valve},
    Rival{"unity-sample", make_unity_sample},
    Rival{"hdrp", make_hdrp},
    Rival{"unity-adaptive", make_unity_adaptive},
    Rival{"woof", make_woof},
    Rival{"drei", make_drei},
    Rival{"second-life", make_second_life},
    Rival{"robust-mpc", make_robust_mpc},
};

constexpr auto names = [] {
    std::array<std::string_view, rivals.size()> list{};
    for (std::size_t i = 0; i < rivals.size(); ++i) list[i] = rivals[i].name;
    return list;
}();

}  // namespace

std::span<const std::string_view> rival_names() {
    return names;
}

std::unique_ptr<Controller> make_rival(std::string_view name) {
    for (const Rival& known : rivals) {
        if (known.name == name) return known.make();
    }
    std::string message = "found rival '" + std::string(name) + "', expected one of:";
    for (const std::string_view known : names) message.append(" ").append(known);
    throw std::invalid_argument(message);
}

}  // namespace sfsm
