// A character's points as the native way of drawing reads them: in chunks, structure of arrays, pose after pose; which
// of them are seen from where; and how large the silhouette is from there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "render/native/array.h"
#include "render/native/directions.h"
#include "render/native/mix.h"
#include "render/native/posed_chunk.h"
#include "scene/light.h"

namespace render::native {

// Prefixes up to so long show the mean looks of the surface that their points stand for (pointsample/prefix_look.h).
inline constexpr int longest_mean_prefix = chunk_points;
// Of a handful of points none may happen to face the eye: each stands for both sides of the body.
inline constexpr int longest_two_sided_prefix = 96;
// The sun goes around a body in so many steps; its height is the place's.
inline constexpr int sun_azimuths = 8;

class SplatModel {
public:
    // Takes half a second of processor time for a person of a thousand poses, on all threads.
    SplatModel(const figures::Figure& figure, const scene::Light& light);

    int points() const { return points_; }

    // The points of a pose. The first chunks of all poses are side by side, and so stay in a cache near by: of people
    // who are far away nothing else is asked for.
    const PosedChunk* first_chunk(std::uint32_t pose) const { return &first_chunks_[pose]; }
    const PosedChunk* other_chunks(std::uint32_t pose) const {
        return other_chunks_.data() + std::size_t{pose} * (chunks_ - 1);
    }
    // What a pose's points span, in the positions' own units.
    struct Extent {
        std::array<std::int16_t, 3> min, max;
    };
    const Extent& extent(std::uint32_t pose) const { return extents_[pose]; }

    // Colours of all points, linear, 32767 = 1: [chunk][channel][chunk_points]; and their slots: [chunk][chunk_points].
    const std::int16_t* colors() const { return colors_.data(); }
    const std::uint16_t* slots() const { return slots_.data(); }
    // Mean colours of a prefix of so many points, and its shares of each slot from no_slot on (32767 = all):
    // [channel][chunk_points], [slot][chunk_points].
    const std::int16_t* mean_colors(int prefix) const { return &mean_colors_[prefix * 3 * chunk_points]; }
    const std::int16_t* mean_shares(int prefix) const {
        return &mean_shares_[prefix * (1 + model::slot_count) * chunk_points];
    }

    // Seen in any light and shade, 32767 = 1: what points emit, by channel, linear, and the share of their colours:
    // [chunk][own_light_values][chunk_points]; the means of a prefix as if it were a chunk. Null: nothing of any.
    const std::int16_t* own_lights() const { return own_lights_.size() == 0 ? nullptr : own_lights_.data(); }
    const std::int16_t* mean_own_lights(int prefix) const {
        return own_lights_.size() == 0 ? nullptr : &mean_own_lights_[prefix * own_light_values * chunk_points];
    }

    // The shares of the surface that points stand for when so many are drawn: `near` and, by the fraction, `far` ones,
    // 16384 = 1: [chunk][chunk_points].
    struct Blend {
        const std::int16_t* near;
        const std::int16_t* far;
        float to_far;  // [0, 1]
    };
    Blend shares(float count) const;

    // What there is to see from a node's direction, in a key pose.
    struct Look {
        float silhouette;             // [model units^2]
        float summed;                 // the same as the visible points' sum says it, if together they were of area()
        float bend_around, bend_up;   // of silhouettes: half the second difference around, and from ring to ring
        float alike;                  // [0, 1] as unevenly as this share of all points lie, did they show alike much
        std::uint32_t first_visible;  // which points of the first chunk nothing of the body hides, a bit each
    };
    // In the key pose next to this one.
    const Look& look(std::uint32_t pose, int node) const { return looks_[look_of(pose, node)]; }
    const std::uint32_t* visible(std::uint32_t pose, int node) const {  // of all chunks
        return &visible_[visible_of(key_of_[pose], node)];
    }
    float silhouette(std::uint32_t pose, const Between& between) const;
    float most_alike() const;  // points, from wherever most of them are
    // What is seen from there of somebody on whom the sun shines along `to_sun`, in the model's axes: the mean linear
    // light of each channel that surfaces of a slot send, where the slot's own colour is white. Summed over slots,
    // times their colours, it is the mean light of the silhouette.
    using SlotLights = std::array<glm::vec3, 1 + model::slot_count>;
    SlotLights lights(std::uint32_t pose, const Between& between, glm::vec3 to_sun) const;
    // The same at a node, from which it is interpolated, and at one of the sun's azimuths.
    SlotLights lights(std::uint32_t pose, int azimuth, int node) const;

    // What a point sends from either side, for each azimuth of the sun and channel, were it of slot colour white.
    struct LitPoint {
        int slot;
        glm::vec3 facet;
        glm::vec3 emitted;  // besides, whatever the slot's colour
        std::array<std::array<float, 3 * sun_azimuths>, 2> light;
    };
    // Of the first ones of a pose.
    std::vector<LitPoint> light_points(std::uint32_t pose) const;

    float area() const { return area_; }  // [model units^2] that the points stand for together
    bool double_sided() const { return double_sided_; }

private:
    void pack_poses(const figures::Figure& figure);
    void pack_looks(const figures::Figure& figure);
    void pack_shares(const figures::Figure& figure);
    void choose_keys(const figures::Figure& figure);
    void look_around(const figures::Figure& figure);
    // `shown`: what is seen of each point from there.
    void find_lights(std::uint32_t key, int node, glm::vec3 direction, std::span<const LitPoint> lit,
                     std::span<const float> shown);
    void find_bends();

    std::size_t look_of(std::uint32_t pose, int node) const {
        return std::size_t{key_of_[pose]} * direction_nodes + node;
    }
    const PosedChunk& chunk_of(std::uint32_t pose, int chunk) const {
        return chunk == 0 ? *first_chunk(pose) : other_chunks(pose)[chunk - 1];
    }
    PosedChunk& chunk_of(std::uint32_t pose, int chunk) {
        return chunk == 0 ? first_chunks_[pose] : other_chunks_[std::size_t{pose} * (chunks_ - 1) + chunk - 1];
    }
    // Of a look, [slot][channel], and one more.
    static constexpr int light_values = (1 + model::slot_count) * 3, light_stride = mixed_values;
    static_assert(light_values <= light_stride);
    std::size_t lights_of(std::uint32_t key, int azimuth, int node) const {
        return ((std::size_t{key} * sun_azimuths + azimuth) * distinct_directions + distinct_of(node)) * light_stride;
    }
    std::size_t visible_of(std::uint32_t key, int node) const {
        return (std::size_t{key} * distinct_directions + distinct_of(node)) * chunks_;
    }

    int points_ = 0, chunks_ = 0;
    bool double_sided_ = false;
    float area_ = 0;
    Array<PosedChunk> first_chunks_, other_chunks_;
    Array<std::int16_t> colors_, mean_colors_, mean_shares_, own_lights_, mean_own_lights_;
    Array<std::int16_t> shares_;  // a rung of `rungs_` each, and in the place of those it lacks the next rung's
    std::vector<int> rungs_;      // numbers of points, rising to points_
    Array<std::uint16_t> slots_;
    std::vector<Extent> extents_;
    std::vector<std::uint32_t> key_of_;  // a pose's key pose, as a number of its own
    std::vector<std::uint32_t> key_poses_;
    std::vector<Look> looks_;             // [key][node]
    std::vector<std::uint32_t> visible_;  // [key][distinct direction][chunk]
    scene::Light light_;
    std::vector<std::uint16_t> lights_;  // [key][azimuth of the sun][distinct direction][light_stride], light_unit = 1
};

}  // namespace render::native
