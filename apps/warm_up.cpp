#include "apps/warm_up.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace apps {

render::Frame one_of_each(const render::View& view, const scene::Crowd& crowd, std::span<const figures::Figure> figures,
                          const figures::Way& way) {
    constexpr float away = 30.0f;  // [m]
    render::Frame frame;
    frame.view = view;
    frame.splat_size = 1;
    for (std::uint32_t character = 0; character < figures.size(); ++character) {
        const auto somebody = std::ranges::find(crowd.character, character);
        if (somebody == crowd.character.end()) continue;
        const auto person = static_cast<std::size_t>(somebody - crowd.character.begin());
        const figures::Figure& figure = figures[character];
        const float scale = crowd.height[person] / figure.poses->rest_height;
        for (std::uint32_t i = 0; i < way.representations.size(); ++i) {
            if (way.representations[i].is_by_block) continue;
            const std::vector<figures::Level> levels = way.representations[i].levels(figure);
            if (levels.empty()) continue;
            render::Person one{};
            one.instance = {away * view.forward, scale, {0, 32767}, crowd.palette[person]};
            one.character = character;
            one.representation = i;
            one.first = levels.back().first;
            one.count = levels.back().count;
            one.last_share = 1;
            one.batch = frame.batch_numbers++;
            one.depth = away;
            frame.people.push_back(one);
        }
    }
    return frame;
}

}  // namespace apps
