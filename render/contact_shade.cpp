#include "render/contact_shade.h"

#include <array>
#include <cmath>
#include <numeric>

#include "render/chunks.h"

namespace render {

namespace {

// The strength's share, 0 for who has none.
float share_of(const Person& person, const View& view, const figures::Way& way) {
    if (!(person.shade_radius > 0)) return 0;
    if (way.drawing == sfsm::Drawing::native && way.representations[person.representation].is_mesh) return 1;
    const float depth = std::max(view.depth(person.instance.position), near_plane);
    return contact_share(person.shade_radius * view.pixels_per_metre(depth));
}

ContactShade shade_of(const Person& person, float share) {
    const float radius = person.shade_radius, peak = std::sqrt(contact_strength * share);
    return {person.instance.position, radius, peak, peak / (radius * radius)};
}

}  // namespace

void find_contact_shades(const Frame& frame, const figures::Way& way, std::vector<ContactShade>& out) {
    const auto visit = [&](Chunk chunk, auto take) {
        for (std::size_t i = chunk.first; i < chunk.end; ++i)
            if (const float share = share_of(frame.people[i], frame.view, way); share > 0)
                take(shade_of(frame.people[i], share));
    };
    std::array<std::size_t, most_chunks + 1> first{};
    for_each_chunk(frame.people.size(),
                   [&](Chunk chunk) { visit(chunk, [&](const ContactShade&) { ++first[chunk.number + 1]; }); });
    std::partial_sum(first.begin(), first.end(), first.begin());
    out.resize(first.back());
    for_each_chunk(frame.people.size(), [&](Chunk chunk) {
        std::size_t at = first[chunk.number];
        visit(chunk, [&](const ContactShade& shade) { out[at++] = shade; });
    });
}

}  // namespace render
