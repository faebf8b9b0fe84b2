#include "model/own_light.h"

#include <cmath>

namespace model {

glm::vec3 emission_of(const Material& material) {
    if (!emits(material)) return glm::vec3(0);
    // IEC 61966-2-1.
    const auto encoded = [](float linear) {
        return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
    };
    const glm::vec3& light = material.emissive;
    return {encoded(light.r), encoded(light.g), encoded(light.b)};
}

}  // namespace model
