#include "render/crowding.h"

#include <cmath>

namespace render {

void Crowding::add(glm::vec3 middle, float height) {
    // Blocks touch: what sticks out of one is above or below its neighbours, and only a part of a body's height spreads
    // it. Sideways nobody is in another's place.
    constexpr double part = 0.25, width = 0.3;  // of a body's height
    const glm::dvec3 at(middle);
    count_ += 1;
    sum_ += at;
    squares_ += glm::outerProduct(at, at);
    const double tall = part * static_cast<double>(height), wide = width * static_cast<double>(height);
    squares_[0][0] += wide * wide / 12;  // of a side: its square / 12
    squares_[1][1] += tall * tall / 12;
    squares_[2][2] += wide * wide / 12;
}

float Crowding::visible_share(glm::vec3 away, float silhouette) const {
    if (count_ < 2) return 1;
    const glm::dvec3 mean = sum_ / count_, toward = glm::normalize(glm::dvec3(away));
    const glm::dmat3 spread = squares_ / count_ - glm::outerProduct(mean, mean);
    // The spread across a direction has the determinant toward' adj(spread) toward.
    const glm::dvec3 x = spread[0], y = spread[1], z = spread[2];
    const glm::dmat3 adjugate = glm::transpose(glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)));
    const double across = glm::dot(toward, adjugate * toward);
    const double area = 12 * std::sqrt(std::max(across, 1e-12));  // of a rectangle that is spread so
    // Bodies cover 1 / r^2 and the slope that they are strewn over 1 / r^3: to second order in the spread along the
    // way it looks as from so much nearer.
    const double along = glm::dot(toward, spread * toward) / glm::dot(glm::dvec3(away), glm::dvec3(away));
    const double layers = count_ * static_cast<double>(silhouette) / area / (1 + 3 * along);
    return static_cast<float>(1 / std::sqrt(1 + layers * layers));
}

}  // namespace render
