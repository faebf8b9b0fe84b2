// A clip: keyframed channels over one skeleton.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace model {

enum class Path : std::uint8_t { translation, rotation, scale, morph_weights };
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

// Values are packed per key: 3 floats (translation, scale), 4 (rotation, x y z w) or one a morph weight;
// cubic splines hold in-tangent, value, out-tangent per key, as glTF 2.0 does.
struct Channel {
    std::int32_t node = 0;
    Path path = Path::rotation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  // [s] ascending, >= 0
    std::vector<float> values;
};

struct Clip {
    std::string name;     // of its character's no two are alike, and none is empty
    double duration = 0;  // [s] the last key of any channel
    std::vector<Channel> channels;
};

}  // namespace model
