// A short text that differs where data does: for names of files.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sfsm/random.h"

namespace bench::front {

class Digest {
public:
    void add(std::span<const std::byte> bytes) {
        add_word(bytes.size());
        for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
            add_word(word);
        }
    }
    void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
    template <typename T>
    void add(const std::vector<T>& values) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> ||
                      std::is_same_v<T, glm::vec3>);
        add(std::as_bytes(std::span(values)));
    }
    void add(double value) { add(std::as_bytes(std::span(&value, 1))); }

    static constexpr std::size_t length = 16;  // of its text

    std::string text() const {
        char text[length + 1];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
        return text;
    }

private:
    void add_word(std::uint64_t word) { state_ = sfsm::hash(state_, word); }

    std::uint64_t state_ = 0;
};

}  // namespace bench::front
