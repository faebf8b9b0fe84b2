// Point models of random but lawful values.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <random>

#include "pointsample/point_model.h"

namespace tests {

inline pointsample::PointModel random_model(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto unit = [&] { return static_cast<float>(random() >> 40) * 0x1p-24f; };  // [0, 1)
    const auto byte = [&] { return static_cast<std::uint8_t>(random()); };
    pointsample::PointModel model;
    for (std::size_t i = 0; i < count; ++i) {
        const float u = unit();
        model.surface.push_back({static_cast<std::uint32_t>(random()), u, unit() * (1.0f - u)});
        model.positions.emplace_back(unit() - 0.5f, 1.8f * unit(), 0.3f * unit());
        model.normals.push_back(glm::normalize(glm::vec3(unit(), unit(), unit()) - 0.49f));
        model.colors.emplace_back(byte(), byte(), byte(), byte());
        model.slots.push_back(static_cast<model::Slot>(random() % (1 + model::slot_count)));
        model.joints.emplace_back(random(), random(), random(), random());
        glm::vec4 weights(unit(), unit(), unit(), unit());
        for (std::size_t k = random() % 4; k > 0; --k) weights[static_cast<int>(k)] = 0;
        weights.x += 0.01f;
        model.weights.push_back(weights / (weights.x + weights.y + weights.z + weights.w));
        model.spacing.push_back(i == 0 ? std::numeric_limits<float>::infinity() : unit());
    }
    for (std::size_t points = count; points > 0; points = points * 5 / 7)
        model.coverage.insert(model.coverage.begin(), {static_cast<std::uint32_t>(points), unit()});
    model.area = 1.9f;
    model.hidden_removed = 77;
    return model;
}

}  // namespace tests
