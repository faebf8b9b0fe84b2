#include "figures/choices.h"

#include <algorithm>
#include <cassert>

#include "sfsm/prices.h"

namespace figures {

namespace {

double cost_of(const Level& level, const std::array<double, sfsm::work_kinds>& pieces) {
    return sfsm::cost_of(level.work, {0, pieces});
}

}  // namespace

Choices::Choices(const Figure& figure, const std::array<double, sfsm::work_kinds>& pieces) {
    std::vector<Choice> offers;
    for (std::uint32_t i = 0; i < representations().size(); ++i)
        for (const Level& level : representations()[i].levels(figure)) offers.push_back({i, level});
    std::vector<std::size_t> order;  // the cheapest first, of equal ones the later
    for (std::size_t i = offers.size(); i-- > 0;) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return cost_of(offers[a].level, pieces) < cost_of(offers[b].level, pieces);
    });
    std::vector<bool> is_taken(offers.size(), false);
    std::vector<std::size_t> taken;
    for (const std::size_t offer : order) {
        if (!taken.empty() && !(offers[offer].level.reach > offers[taken.back()].level.reach)) continue;
        taken.push_back(offer);
        is_taken[offer] = true;
    }
    assert(!taken.empty());
    std::vector<std::uint32_t> place(offers.size());
    for (std::size_t i = 0; i < offers.size(); ++i) {
        place[i] = static_cast<std::uint32_t>(all_.size());
        if (is_taken[i]) all_.push_back(offers[i]);
    }
    for (const std::size_t offer : taken) by_cost_.push_back({offers[offer].level.reach, place[offer]});
}

}  // namespace figures
