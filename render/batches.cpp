#include "render/batches.h"

namespace render {

// Counting sort by batch number, stable.
void Batches::gather(const Frame& frame) {
    begin_.assign(std::size_t{frame.batch_numbers} + 1, 0u);
    somebody_.resize(frame.batch_numbers);
    for (std::uint32_t i = 0; i < frame.people.size(); ++i) {
        const std::uint32_t number = frame.people[i].batch;
        ++begin_[number + 1];
        somebody_[number] = i;
    }
    batches_.clear();
    for (std::uint32_t number = 0; number < frame.batch_numbers; ++number) {
        const std::uint32_t size = begin_[number + 1];
        begin_[number + 1] += begin_[number];
        if (size == 0) continue;
        const Person& one = frame.people[somebody_[number]];
        batches_.push_back({one.character, one.representation, one.first, one.count, one.pose, begin_[number], size});
    }
    instances_.resize(frame.people.size());
    for (const Person& person : frame.people) instances_[begin_[person.batch]++] = person.instance;
}

}  // namespace render
