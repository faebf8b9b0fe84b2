// Characters that differ in how many triangles they have, before a forecaster of rates.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/rate_forecaster.h"
#include "tests/figures/counted_character.h"

namespace tests {

struct Troupe {
    const figures::Way& way = figures::natively();
    std::vector<std::unique_ptr<CountedCharacter>> characters;
    render::ErrorBounds bounds;
    render::RateForecaster forecaster;
    render::View view = render::make_view({{0, 0, 0}, {0, 0, -1}, 0.8}, 1280, 720);

    // The first of so many triangles, each of some more than the one before; all of so many points. People who moved a
    // tick ago are off by a centimetre.
    Troupe(std::size_t count, std::size_t triangles, int points) {
        constexpr std::size_t more = 397;
        std::vector<render::RateForecaster::Kind> kinds;
        for (std::size_t i = 0; i < count; ++i) {
            characters.push_back(std::make_unique<CountedCharacter>(triangles + more * i, points, way));
            render::RateForecaster::Kind kind{{&characters.back()->choices, 1.9, 1.65}, {}, &bounds, 1};
            for (render::Staleness& staleness : kind.staleness)
                for (std::size_t period = 2; period < staleness.size(); ++period)
                    staleness[period] = 0.01f * static_cast<float>(period - 1);
            kinds.push_back(kind);
        }
        forecaster = render::RateForecaster(std::move(kinds), way);
    }
};

}  // namespace tests
