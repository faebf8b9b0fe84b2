#include "render/native/triangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace render::native {

TrianglePeople::TrianglePeople(std::span<const figures::Figure> figures, const scene::Light& light)
    : daylight_(daylight_of(light)) {
    for (const figures::Figure& figure : figures) meshes_.emplace_back(figure);
}

void TrianglePeople::prepare(const View& view, std::span<const Person* const> people) {
    view_ = view;
    people_ = people;
    bounds_.resize(people.size());
    constexpr std::size_t most_bytes = std::size_t{64} << 20;
    std::size_t bytes_each = 1;
    for (const PersonMesh& mesh : meshes_) bytes_each = std::max(bytes_each, PersonTriangles::size_of(mesh));
    kept_count_ = std::min(people.size(), most_bytes / bytes_each);
    if (kept_count_ > kept_.size()) kept_.resize(kept_count_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, people.size()), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Person& person = *people[i];
            PersonTriangles& triangles = i < kept_count_ ? kept_[i] : scratch_.local();
            bounds_[i] = triangles.place(view, daylight_, meshes_[person.character], person);
        }
    });
}

void TrianglePeople::draw(std::size_t i, NearLayer& layer) const {
    if (bounds_[i].empty()) return;
    const Person& person = *people_[i];
    const PersonMesh& mesh = meshes_[person.character];
    if (i < kept_count_) {
        kept_[i].draw(mesh, layer);
        return;
    }
    PersonTriangles& triangles = scratch_.local();
    triangles.place(view_, daylight_, mesh, person);
    triangles.draw(mesh, layer);
}

}  // namespace render::native
