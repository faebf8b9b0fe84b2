#include "figures/choices.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "sfsm/prices.h"

namespace figures {

namespace {

double cost_of(const Level& level, const std::array<double, sfsm::work_kinds>& pieces) {
    return sfsm::cost_of(level.work, {0, pieces});
}

}  // namespace

Choices::Choices(const Figure& figure, const Way& way) {
    std::vector<Choice> offers, of_blocks;
    for (std::uint32_t i = 0; i < way.representations.size(); ++i)
        for (const Level& level : way.representations[i].levels(figure))
            (way.representations[i].is_by_block ? of_blocks : offers).push_back({i, level});
    // `better` serves whoever `other` serves, for less, or for as much and comes later.
    const auto replaces = [&](const Choice& better, const Choice& other) {
        const double cost = cost_of(better.level, way.pieces), other_cost = cost_of(other.level, way.pieces);
        return better.level.reach >= other.level.reach &&
               (cost < other_cost || (cost == other_cost && &better > &other));
    };
    std::ranges::copy_if(offers, std::back_inserter(all_), [&](const Choice& offer) {
        return std::ranges::none_of(offers, [&](const Choice& other) { return replaces(other, offer); });
    });
    assert(!all_.empty());
    for (std::uint32_t i = 0; i < all_.size(); ++i) by_cost_.push_back({all_[i].level.reach, i});
    std::ranges::sort(by_cost_, {}, &Reach::reach);  // cost rises along it too: else one replaced another
    std::ranges::copy_if(by_cost_, std::back_inserter(samples_), [&](const Reach& reach) {
        return !way.representations[all_[reach.choice].representation].is_mesh;
    });
    assert(of_blocks.size() <= 1);
    for (const Choice& offer : of_blocks) {
        block_ = {offer.level.reach, static_cast<std::uint32_t>(all_.size())};
        all_.push_back(offer);
    }
}

}  // namespace figures
