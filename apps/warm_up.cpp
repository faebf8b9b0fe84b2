#include "apps/warm_up.h"

#include <set>
#include <utility>

namespace apps {

render::Frame one_of_each(const render::Frame& everybody) {
    render::Frame frame;
    frame.view = everybody.view;
    frame.splat_size = everybody.splat_size;
    frame.far_people = everybody.far_people;
    frame.batch_numbers = everybody.batch_numbers;
    frame.work = everybody.work;
    frame.state = everybody.state;
    if (!everybody.far_blocks.empty()) frame.far_blocks = {everybody.far_blocks.front()};
    std::set<std::pair<std::uint32_t, std::uint32_t>> kinds;
    for (const render::Person& person : everybody.people)
        if (kinds.emplace(person.character, person.representation).second) frame.people.push_back(person);
    return frame;
}

}  // namespace apps
