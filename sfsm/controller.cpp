#include "sfsm/controller.h"

#include <array>
#include <stdexcept>
#include <string>

#include "sfsm/paper.h"
#include "sfsm/predictive.h"
#include "sfsm/safeguarded.h"
#include "sfsm/same_bits.h"

namespace sfsm {
namespace {

struct Law {
    std::string_view name;
    std::unique_ptr<Controller> (*make)(const LawOptions& options);
};

using Made = std::unique_ptr<Controller>;
constexpr std::array laws = {
    Law{"predictive",
        [](const LawOptions& options) -> Made {
            return std::make_unique<PredictiveLaw>(options.predictive, options.drawing);
        }},
    Law{"safeguarded", [](const LawOptions&) -> Made { return std::make_unique<SafeguardedLaw>(); }},
    Law{"paper", [](const LawOptions&) -> Made { return std::make_unique<PaperLaw>(); }},
};

constexpr auto names = [] {
    std::array<std::string_view, laws.size()> list{};
    for (std::size_t i = 0; i < laws.size(); ++i) list[i] = laws[i].name;
    return list;
}();

}  // namespace

std::span<const std::string_view> law_names() {
    return names;
}

std::unique_ptr<Controller> make_controller(std::string_view law, const LawOptions& options) {
    options.predictive.validate();
    for (const Law& known : laws) {
        if (known.name == law) return known.make(options);
    }
    std::string message = "found law '" + std::string(law) + "', expected one of:";
    for (const std::string_view name : names) message.append(" ").append(name);
    throw std::invalid_argument(message);
}

}  // namespace sfsm
