// What C++ and the shaders must agree on. Included by both: render/gl/renderer.cpp checks the sizes and offsets.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace render {
using vec4 = glm::vec4;
using mat4 = glm::mat4;
#define CONSTANT inline constexpr int
#define BLOCK_BEGIN(name, binding)                 \
    inline constexpr int name##_binding = binding; \
    struct name##Block {
#define BLOCK_END(name) \
    }                   \
    ;
#else
// What C++ computes too, many pixels at once (render/native/glsl.h), is written with `real` for a pixel's own numbers,
// `select` for its choices, and `somewhere` for leaving out what makes no difference to any: here nothing is left out.
#define real float
real select(bool condition, real yes, real no) {
    return condition ? yes : no;
}
vec2 select(bool condition, vec2 yes, vec2 no) {
    return condition ? yes : no;
}
bool somewhere(bool condition) {
    return true;
}
#define CONSTANT const int
#define BLOCK_BEGIN(name, slot) layout(std140, binding = slot) uniform name##Block {
#define BLOCK_END(name) \
    }                   \
    name;
#endif

// Slots come four a vector, the last filled up with 0.
CONSTANT slot_count = 4;  // model::slot_count
CONSTANT slot_vectors = (slot_count + 3) / 4;

// Vertex attributes of people: baked vertices, then the instance.
CONSTANT attribute_position = 0;   // unorm 16 x 3 over the character's box
CONSTANT attribute_normal = 1;     // snorm 8 x 2, octahedral
CONSTANT attribute_color = 2;      // unorm 8 x 3, sRGB
CONSTANT attribute_look = 3;       // uint 8: slot in the low 3 bits, texture layer above, no_layer = none; of points:
                                   // 1 = stands for both sides of the body, seen from everywhere
CONSTANT attribute_placement = 4;  // camera-relative position [m], scale
CONSTANT attribute_turn = 5;       // snorm 16 x 2: sin, cos of the yaw
CONSTANT attribute_palette = 6;    // slot_vectors of uint 32 x 4: sRGB of slots 1 to slot_count
// Behind it: of vertices uv, half x 2; of points slot_vectors of unorm 8 x 4, shares of slots 1 to slot_count.
CONSTANT attribute_uv = attribute_palette + slot_vectors;
CONSTANT attribute_shares = attribute_palette + slot_vectors;
CONSTANT attribute_alpha = attribute_uv + 1;                     // unorm 8, of vertices whose materials need it
CONSTANT attribute_own_light = attribute_shares + slot_vectors;  // unorm 8 x 4, of points that have any

// Vertex attributes of very far people, who stay where they are.
CONSTANT attribute_far_center = 0;     // the middle, from the block's origin [m]; side of a square as large as the
                                       // surface [m]
CONSTANT attribute_far_turn = 1;       // snorm 16 x 2: sin, cos of the yaw
CONSTANT attribute_far_character = 2;  // uint 8
CONSTANT attribute_far_key = 3;        // uint 8
CONSTANT attribute_far_palette = 4;    // slot_count of unorm 8 x 4: sRGB of slots 1 to slot_count

CONSTANT uniform_far_eye = 0;  // the camera, from the block's origin [m]

// The grid of directions that they are looked at from (render/native/far_looks.h).
CONSTANT far_rings = 9;
CONSTANT far_nodes = 16;
CONSTANT far_suns = 8;

// Vertex attributes of the structure.
CONSTANT attribute_static_position = 0;
CONSTANT attribute_static_normal = 1;
CONSTANT attribute_static_color = 2;  // alpha: scene::Surface
CONSTANT attribute_static_open = 3;

CONSTANT look_slot_bits = 3;
CONSTANT no_layer = 31;
// Where materials differ in more than their texture, looks hold the number of one of these instead of a layer.
CONSTANT texturing_count = 32;
// Two for each: as shaders/texturing.glsl says, w: alpha below which there is nothing; what is emitted, linear, w:
// times which layer.
CONSTANT uniform_texturings = 1;
CONSTANT texturing_nearest = 1;  // bits of their z
CONSTANT texturing_unlit = 2;    // the colour is seen in any light and shade
CONSTANT wrap_repeat = 0;        // model::Wrap
CONSTANT wrap_mirror = 1;
CONSTANT wrap_clamp = 2;
CONSTANT texture_unit_layers = 0;
CONSTANT texture_unit_looks = 1;

// Once a frame.
BLOCK_BEGIN(Frame, 0)
mat4 clip_from_camera_relative;  // world axes, camera at the origin, to clip space; reversed depth
vec4 camera_position;            // [m] from the structure's origin
vec4 sun_direction;              // towards the sun, unit
vec4 sun_color;                  // linear
vec4 sky_light;                  // linear, from above
vec4 ground_light;               // linear, from below
vec4 sky_haze;                   // sRGB, at the horizon
vec4 sky_zenith;                 // sRGB
vec4 sky_glare;                  // sRGB, of the sun and around it
vec4 view_right;                 // world; length = tan of half the horizontal field of view
vec4 view_up;                    // world; length = tan of half the vertical one
vec4 view_forward;               // world; unit
vec4 ground_parameters[2];       // as the file of shaders/grounds/ says that is in use
vec4 splat;                      // x: splat size [px]; y: pixels that a metre covers at a depth of one metre; zw: the
                                 // picture's share of the viewport that points are drawn into, across and up
BLOCK_END(Frame)

// Once a character.
BLOCK_BEGIN(Figure, 1)
vec4 box_min;   // [model units]; w: 1 = seen from both sides
vec4 box_size;  // [model units]; w: side of a square as large as the silhouette
BLOCK_END(Figure)

// What shaders/contact_grid.glsl reads.
CONSTANT contact_cells_binding = 0;
CONSTANT contact_feet_binding = 1;
CONSTANT contact_numbers_binding = 2;
BLOCK_BEGIN(ContactGrid, 2)
vec4 corner_and_scale;  // x, z camera-relative [m]; cells a metre
vec4 size;              // columns, rows
BLOCK_END(ContactGrid)

#ifdef __cplusplus
#undef CONSTANT
#undef BLOCK_BEGIN
#undef BLOCK_END
}  // namespace render
#endif
