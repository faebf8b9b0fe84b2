#include "render/batches.h"

#include "render/chunks.h"

namespace render {

// Counting sort by batch number, stable. People are large and were written by many threads: each is read once to be
// sorted and once to be written, by many threads too.
void Batches::gather(const Frame& frame) {
    numbers_.resize(frame.people.size());
    for_each_chunk(frame.people.size(), [&](Chunk chunk) {
        for (std::size_t i = chunk.first; i < chunk.end; ++i) numbers_[i] = frame.people[i].batch;
    });
    begin_.assign(std::size_t{frame.batch_numbers} + 1, 0u);
    for (const std::uint32_t number : numbers_) ++begin_[number + 1];
    for (std::uint32_t number = 0; number < frame.batch_numbers; ++number) begin_[number + 1] += begin_[number];
    order_.resize(numbers_.size());
    for (std::uint32_t i = 0; i < numbers_.size(); ++i) order_[begin_[numbers_[i]]++] = i;
    batches_.clear();
    for (std::uint32_t first = 0, end = 0; first < order_.size(); first = end) {
        const Person& one = frame.people[order_[first]];
        end = begin_[one.batch];
        batches_.push_back({one.character, one.representation, one.first, one.count, one.pose, first, end - first});
    }
}

void Batches::write_instances(const Frame& frame, std::span<Instance> out) const {
    for_each_chunk(order_.size(), [&](Chunk chunk) {
        for (std::size_t i = chunk.first; i < chunk.end; ++i) out[i] = frame.people[order_[i]].instance;
    });
}

}  // namespace render
