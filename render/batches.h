// A frame's people gathered so that each run of them reads one pose, for devices that draw many alike at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/frame.h"

namespace render {

// People of one character in one pose, drawn alike.
struct Batch {
    std::uint32_t character;
    std::uint32_t representation;  // into Way::representations
    std::uint32_t first, count;    // of its elements: figures::Level's
    std::uint32_t pose;            // into the character's PoseTable
    std::uint32_t first_instance;
    std::uint32_t instance_count;
};

// Reuses its memory: after the first frames nothing is allocated.
class Batches {
public:
    void gather(const Frame& frame);

    std::span<const Instance> instances() const { return instances_; }
    std::span<const Batch> all() const { return batches_; }  // by rising Person::batch

private:
    std::vector<std::uint32_t> begin_;     // per batch number, then the total
    std::vector<std::uint32_t> somebody_;  // per batch number: one of its people
    std::vector<Instance> instances_;
    std::vector<Batch> batches_;
};

}  // namespace render
