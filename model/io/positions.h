// Places as a file has them, in more than a float's precision where it does. Internal to the loaders.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace model {

// As floats and what these lack of doubles, which takes no memory while it is nothing. 48 bits of each coordinate; one
// that a float is too small for is infinite.
class Positions {
public:
    void push_back(const glm::dvec3& position) {
        const glm::vec3 rounded(position);
        glm::vec3 rest(0.0f);
        for (int axis = 0; axis < 3; ++axis)
            if (std::isfinite(rounded[axis])) rest[axis] = static_cast<float>(position[axis] - double{rounded[axis]});
        rounded_.push_back(rounded);
        if (rests_.empty() && rest == glm::vec3(0.0f)) return;
        rests_.resize(rounded_.size() - 1, glm::vec3(0.0f));
        rests_.push_back(rest);
    }
    std::vector<glm::vec3> take_rounded() { return std::move(rounded_); }
    void reserve(std::size_t count) { rounded_.reserve(count); }

    std::size_t size() const { return rounded_.size(); }
    glm::dvec3 operator[](std::size_t i) const {
        const glm::dvec3 rounded(rounded_[i]);
        return rests_.empty() ? rounded : rounded + glm::dvec3(rests_[i]);
    }

private:
    std::vector<glm::vec3> rounded_, rests_;  // the latter empty or as long
};

}  // namespace model
