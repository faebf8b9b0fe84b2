// The last few times, or ratios of them, in the order they came.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace sfsm {

template <std::size_t capacity>
class Window {
public:
    void push(double value) {
        std::rotate(values_.begin(), values_.end() - 1, values_.end());
        values_.front() = value;
        size_ = std::min(size_ + 1, capacity);
    }
    void clear() { size_ = 0; }

    std::size_t size() const { return size_; }
    bool is_full() const { return size_ == capacity; }
    double operator[](std::size_t age) const { return values_[age]; }  // 0 is the newest; age < size()

    // Of a window that is not empty.
    double mean() const {
        double sum = 0;
        for (std::size_t age = 0; age < size_; ++age) sum += values_[age];
        return sum / static_cast<double>(size_);
    }
    double median() const {
        std::array<double, capacity> sorted = values_;
        const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(size_);
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(size_ / 2);
        std::nth_element(sorted.begin(), middle, end);
        return *middle;
    }
    double max() const {
        return *std::max_element(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(size_));
    }

private:
    std::array<double, capacity> values_{};  // newest first
    std::size_t size_ = 0;
};

}  // namespace sfsm
