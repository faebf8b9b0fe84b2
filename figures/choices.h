// Which level a person of a character is drawn at: the cheapest of all that serve their demand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "figures/way.h"

namespace figures {

struct Choice {
    std::uint32_t representation = 0;  // into Way::representations
    Level level;
};

class Choices {
public:
    // Levels that are never the cheapest are left out; of equal cost, the later representation is taken. What only
    // blocks are drawn as replaces nothing: it is kept beside the rest.
    Choices(const Figure& figure, const Way& way);

    // By representation, each from its coarsest level to its finest.
    std::span<const Choice> all() const { return all_; }

    // Into all(): for a demand > 0, of somebody alone. Who asks for more than anything serves has the dearest.
    std::uint32_t at(float demand) const {
        std::size_t i = 0;
        while (i + 1 < by_cost_.size() && !(demand <= by_cost_[i].reach)) ++i;
        return by_cost_[i].choice;
    }
    // The same of people of a block that is drawn as one where that serves them.
    std::uint32_t in_block_at(float demand) const { return demand <= block_.reach ? block_.choice : at(demand); }
    // The greatest demand of which a block is drawn as one; < 0: it never is.
    float block_reach() const { return block_.reach; }
    // Of those that aren't meshes the cheapest for so many samples of somebody alone, or the finest; none: exact().
    std::uint32_t samples_at(float demand) const {
        if (samples_.empty()) return exact();
        std::size_t i = 0;
        while (i + 1 < samples_.size() && !(demand <= samples_[i].reach)) ++i;
        return samples_[i].choice;
    }
    // The most samples that one of them has; 0 without any.
    float most_samples() const { return samples_.empty() ? 0 : samples_.back().reach; }
    // What serves any demand: the artist's own shape.
    std::uint32_t exact() const { return by_cost_.back().choice; }

private:
    struct Reach {
        float reach = -1;
        std::uint32_t choice = 0;
    };
    std::vector<Choice> all_;
    Reach block_;
    std::vector<Reach> by_cost_;  // cost and reach rise along it
    std::vector<Reach> samples_;  // of those that aren't meshes: cost and reach rise along it
};

}  // namespace figures
