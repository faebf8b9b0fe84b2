// What all ways of drawing a person share: unpack a baked vertex or point, turn and place it, colour it.
#include "light.glsl"

layout(location = attribute_position) in vec3 packed_position;
layout(location = attribute_normal) in vec2 packed_normal;
layout(location = attribute_color) in vec3 vertex_color;
layout(location = attribute_look) in uint look;
layout(location = attribute_placement) in vec4 placement;
layout(location = attribute_turn) in vec2 turn;
layout(location = attribute_palette) in uvec4 palette[slot_vectors];

vec3 unfold(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float fold = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -fold : fold;
    n.y += n.y >= 0.0 ? -fold : fold;
    return normalize(n);
}

vec3 turned(vec3 v) { return vec3(turn.y * v.x + turn.x * v.z, v.y, turn.y * v.z - turn.x * v.x); }

// sRGB is near enough to a square for light: one multiplication each way.
vec3 linear(vec3 srgb) { return srgb * srgb; }

// Of a slot from 1 on.
vec3 palette_color(int slot) { return linear(unpackUnorm4x8(palette[(slot - 1) / 4][(slot - 1) % 4]).rgb); }

// Camera-relative [m].
vec3 placed_position() {
    vec3 model = Figure.box_min.xyz + Figure.box_size.xyz * packed_position;
    return placement.xyz + placement.w * turned(model);
}
vec3 placed_normal() { return turned(unfold(packed_normal)); }

bool is_double_sided() { return Figure.box_min.w != 0.0; }
