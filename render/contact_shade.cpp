#include "render/contact_shade.h"

#include <algorithm>
#include <cmath>

namespace render {

void find_contact_shades(const Frame& frame, const figures::Way& way, std::vector<ContactShade>& out) {
    out.clear();
    for (const Person& person : frame.people) {
        const float radius = person.shade_radius;
        if (!(radius > 0)) continue;
        const glm::vec3 feet = person.instance.position;
        const float pixels = radius * frame.view.pixels_per_metre(std::max(frame.view.depth(feet), near_plane));
        const bool is_whole =
            way.drawing == sfsm::Drawing::native && way.representations[person.representation].is_mesh;
        const float share = is_whole ? 1.0f : contact_share(pixels);
        if (!(share > 0)) continue;
        const float peak = std::sqrt(contact_strength * share);
        out.push_back({feet, radius, peak, peak / (radius * radius)});
    }
}

}  // namespace render
