// figures/triangles.h without OpenGL: people as the triangles of their meshes, four samples a pixel.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <cstddef>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "render/frame.h"
#include "render/native/near_layer.h"
#include "render/native/person_triangles.h"
#include "scene/light.h"

namespace render::native {

// Looks as render/gl/triangles.cpp does, at every sample, but for edges: vertices are snapped to a 32nd of a pixel.
// The bits are the same on every processor and for any number of threads and any cut into tiles.
class TrianglePeople {
public:
    // The figures' meshes and poses must outlive this; poses aren't copied.
    TrianglePeople(std::span<const figures::Figure> figures, const scene::Light& light);

    // Forgets whom it had, and places and lights these, on all threads. `people` must stay until the last draw(). Each
    // is drawn by all of their mesh, whatever Person::first and count say. Who is nowhere (a position, scale or turn
    // that is not finite) or has scale 0 isn't drawn. About 30 kB a person of the built-in kind, 64 MiB at most:
    // whoever comes when that is full is placed anew in every tile. Who crosses the near plane or is over 1,000 px wide
    // or high takes 150 bytes a triangle on top.
    void prepare(const View& view, std::span<const Person* const> people);

    std::size_t size() const { return bounds_.size(); }
    // Pixels of the picture that person `i` of `people` may touch; empty: none.
    Rect bounds(std::size_t i) const { return bounds_[i]; }
    std::span<const Rect> bounds() const { return bounds_; }
    // Where samples are equally near, who was drawn first stays. In any other order the same is drawn, but from front
    // to back it is cheapest: whatever is hidden by what is in the layer already is skipped. For one layer at a time on
    // each thread.
    void draw(std::size_t i, NearLayer& layer) const;

private:
    std::vector<PersonMesh> meshes_;
    Daylight daylight_;
    View view_;
    std::span<const Person* const> people_;
    std::vector<Rect> bounds_;           // one a person
    std::vector<PersonTriangles> kept_;  // of the first people; others follow from them every time
    std::size_t kept_count_ = 0;
    mutable tbb::enumerable_thread_specific<PersonTriangles> scratch_;
};

}  // namespace render::native
