// The vertices of a mesh whose file gives looks to corners: one for each look that a place is seen with. Internal to
// the loaders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace model {

// Look: what vertices of one place differ in; compares with ==.
template <typename Look>
class VertexSplits {
public:
    struct Vertex {
        std::uint32_t place;
        std::uint32_t next;  // of the place's list: its first, then the others, newest first
        Look look;
    };

    void add_place() { first_.push_back(none); }
    void add_places(std::size_t count) { first_.resize(first_.size() + count, none); }

    // The vertex of these, a new one if need be. A list is looked through only so far: of a place with thousands of
    // looks a vertex may come twice.
    std::uint32_t vertex_of(std::uint32_t place, const Look& look) {
        std::uint32_t vertex = first_[place];
        for (int i = 0; i < patience && vertex != none; ++i) {
            if (vertices_[vertex].look == look) return vertex;
            vertex = vertices_[vertex].next;
        }
        vertex = static_cast<std::uint32_t>(vertices_.size());
        if (first_[place] == none) {
            first_[place] = vertex;
            vertices_.push_back({place, none, look});
        } else {
            vertices_.push_back({place, std::exchange(vertices_[first_[place]].next, vertex), look});
        }
        return vertex;
    }

    const std::vector<Vertex>& vertices() const { return vertices_; }

    // Of each vertex the number of one of its place whose look is alike, the same for all of those; of a list only the
    // beginning is looked through. alike(a, b) of two looks is an equivalence.
    template <typename Alike>
    std::vector<std::uint32_t> alike(Alike is_alike) const {
        std::vector<std::uint32_t> of_vertex(vertices_.size());
        for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
            of_vertex[i] = i;
            std::uint32_t other = first_[vertices_[i].place];
            for (int k = 0; k < patience && other != none; ++k) {
                if (is_alike(vertices_[i].look, vertices_[other].look)) {
                    of_vertex[i] = other;
                    break;
                }
                other = vertices_[other].next;
            }
        }
        return of_vertex;
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    static constexpr int patience = 32;

    std::vector<std::uint32_t> first_;  // of each place
    std::vector<Vertex> vertices_;
};

}  // namespace model
