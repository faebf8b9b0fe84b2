#include "scene/looks.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "scene/person.h"
#include "sfsm/random.h"

namespace scene {

namespace {

using sfsm::below;
using sfsm::mix;
using sfsm::upper_unit;

constexpr glm::u8vec4 rgb(int red, int green, int blue) {
    return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue), 255};
}

constexpr std::array skins{rgb(255, 222, 200), rgb(241, 200, 172), rgb(226, 180, 148), rgb(203, 152, 116),
                           rgb(172, 118, 84),  rgb(138, 90, 62),   rgb(104, 66, 46),   rgb(74, 48, 36)};
// From black to white; who is darker than the first `fair_skins` has one of the first `dark_hairs`.
constexpr std::array hairs{rgb(24, 20, 18),    rgb(38, 28, 22),   rgb(58, 40, 28),    rgb(84, 58, 38),
                           rgb(112, 80, 50),   rgb(168, 130, 78), rgb(206, 172, 112), rgb(140, 66, 34),
                           rgb(150, 148, 144), rgb(214, 212, 208)};
constexpr std::uint32_t fair_skins = 4, dark_hairs = 4;
// None near a skin's colour: nobody seems to wear nothing.
constexpr std::array casual_shirts{rgb(240, 240, 236), rgb(34, 36, 40),    rgb(98, 104, 112), rgb(30, 52, 96),
                                   rgb(70, 120, 176),  rgb(150, 190, 220), rgb(44, 94, 66),   rgb(122, 146, 84),
                                   rgb(236, 196, 84),  rgb(224, 124, 54),  rgb(150, 42, 50),  rgb(222, 112, 148),
                                   rgb(110, 70, 120),  rgb(222, 216, 198), rgb(58, 78, 92),   rgb(62, 132, 140)};
constexpr std::array home_shirts{rgb(200, 28, 44), rgb(182, 20, 36), rgb(214, 50, 58), rgb(244, 242, 240)};
constexpr std::array away_shirts{rgb(248, 206, 40), rgb(238, 190, 24), rgb(252, 222, 92), rgb(26, 70, 150)};
constexpr std::array trousers{rgb(44, 62, 96), rgb(58, 82, 122),   rgb(30, 40, 62),   rgb(28, 28, 32),
                              rgb(66, 68, 74), rgb(172, 150, 112), rgb(134, 112, 82), rgb(84, 92, 70)};

template <std::size_t N>
glm::u8vec4 pick(const std::array<glm::u8vec4, N>& from, std::uint64_t bits) {
    return from[below(bits, static_cast<std::uint32_t>(N))];
}

}  // namespace

Palette dress(Fans fans, std::uint64_t bits) {
    const auto next = [&] { return bits = mix(bits); };
    Palette palette;
    // The lesser of two draws: fair skins are more frequent than dark ones, as in many places.
    constexpr std::uint32_t skin_count = static_cast<std::uint32_t>(skins.size());
    const std::uint32_t skin = std::min(below(next(), skin_count), below(next(), skin_count));
    const std::uint32_t hair = below(next(), skin < fair_skins ? static_cast<std::uint32_t>(hairs.size()) : dark_hairs);
    palette[skin_slot] = skins[skin];
    palette[hair_slot] = hairs[hair];
    const float team = upper_unit(next());
    if (team < fans.home) {
        palette[shirt_slot] = pick(home_shirts, next());
    } else if (team < fans.home + fans.away) {
        palette[shirt_slot] = pick(away_shirts, next());
    } else {
        palette[shirt_slot] = pick(casual_shirts, next());
    }
    palette[trousers_slot] = pick(trousers, next());
    return palette;
}

// Normal about the mean, by the sum of four uniforms (of variance 1/3), clamped.
float draw_height(std::uint64_t bits) {
    constexpr float mean = 1.70f, deviation = 0.09f, low = 1.5f, high = 2.0f;
    float sum = 0;
    for (int i = 0; i < 4; ++i) sum += upper_unit(bits = mix(bits));
    return std::clamp(mean + deviation * std::numbers::sqrt3_v<float> * (sum - 2.0f), low, high);
}

}  // namespace scene
