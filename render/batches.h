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

    std::span<const Batch> all() const { return batches_; }  // by rising Person::batch

    // Of the frame that was gathered, batch by batch; `out` is as long as its people. It is only written, in order.
    void write_instances(const Frame& frame, std::span<Instance> out) const;

private:
    std::vector<std::uint32_t> numbers_;  // per person: their batch's
    std::vector<std::uint32_t> begin_;    // per batch number, then the total
    std::vector<std::uint32_t> order_;    // people, batch by batch
    std::vector<Batch> batches_;
};

}  // namespace render
