// What a character covers and sends when all of a person is one splat (figures/splats.h): a row of numbers for each key
// pose, azimuth of the sun and direction to the eye, to be interpolated between.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "figures/figure.h"
#include "render/native/array.h"
#include "render/native/directions.h"
#include "render/native/splat_model.h"

namespace render::native {

// Rows of a key go around the sun, then up the rings, then around a ring, whose first node comes once more at its end:
// what lies between two nodes is between two rows that are neighbours.
inline constexpr int far_ring_rows = ring_nodes + 1;
inline constexpr int far_sun_rows = rings * far_ring_rows;
inline constexpr int far_key_rows = sun_azimuths * far_sun_rows;

// Four values of each of four slots: linear red, green and blue that surfaces of the slot send where its colour is
// white, 32767 = 1, in shares of the silhouette; the fourth values are those of no_slot, and the silhouette.
static_assert(model::slot_count == 4);
inline constexpr int far_row_values = 16;
// A person's colours are multiplied by as squares of bytes, halved: so much is 1.
inline constexpr float far_color_unit = 255 * 255 / 2;
// Values of rows make up for what that lacks to 1.
inline constexpr float far_color_share = far_color_unit / 32768.0f;

// [model units] The surface over all keys: its middle, and the height of a box whose points would vary in height as its
// do.
struct FarShape {
    glm::vec3 center;
    float height;
};
FarShape far_shape(const motion::PoseTable& poses);

// Light of red, green and blue by slot, as SplatModel::lights.
using SlotLights = SplatModel::SlotLights;

// What a crowd hides of its people is their lower parts. Seen from a ring of directions, on average over poses and all
// around: the mean light of all that is seen of somebody who stands alone, and how it leans towards the upper parts:
// the mean of light times 1/2 - t, where t goes from 0 at the top of the silhouette to 1, by area.
struct Leaning {
    SlotLights mean{}, lean{};
};

struct FarLooks {
    FarLooks(const figures::Figure& figure, const SplatModel& model);

    Array<std::int16_t> rows;      // [key][sun][ring][node, and the first again][far_row_values]
    float largest_silhouette = 0;  // [model units^2] 32767 of a row's last value
    std::array<Leaning, rings> leanings;

private:
    void find_leanings(const figures::Figure& figure, const SplatModel& model, const std::vector<int>& keys);
};

}  // namespace render::native
