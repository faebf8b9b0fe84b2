// Those of a frame who are drawn as triangles, one by one.
#pragma once

#include <vector>

#include "figures/way.h"
#include "render/frame.h"

namespace tests {

struct MeshPeople {
    std::vector<render::Person> people;
    std::vector<const render::Person*> pointers;

    explicit MeshPeople(std::vector<render::Person> whom) : people(std::move(whom)) {
        for (const render::Person& person : people) pointers.push_back(&person);
    }
    MeshPeople(const MeshPeople&) = delete;
    MeshPeople& operator=(const MeshPeople&) = delete;
};

// Of a frame that is drawn natively.
inline std::vector<render::Person> mesh_people(const render::Frame& frame) {
    std::vector<render::Person> people;
    for (const render::Person& person : frame.people)
        if (figures::natively().representations[person.representation].is_mesh) people.push_back(person);
    return people;
}

}  // namespace tests
