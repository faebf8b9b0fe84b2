// Those of a frame who are drawn as triangles, one by one.
#pragma once

#include <vector>

#include "figures/representation.h"
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

inline std::vector<render::Person> mesh_people(const render::Frame& frame) {
    std::vector<render::Person> people;
    for (const render::Batch& batch : frame.batches) {
        if (!figures::representations()[batch.representation].is_mesh) continue;
        for (std::uint32_t i = 0; i < batch.instance_count; ++i) {
            const render::Instance& instance = frame.instances[batch.first_instance + i];
            people.push_back({instance, batch.character, batch.representation, batch.first, batch.count, batch.pose, 0,
                              frame.view.depth(instance.position)});
        }
    }
    return people;
}

}  // namespace tests
