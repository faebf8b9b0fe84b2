// One vertex of a person's mesh.
#include "person.glsl"
#ifdef TEXTURED
layout(location = attribute_uv) in vec2 uv;
out vec2 texture_uv;
flat out int texture_layer;
#endif
#ifdef MATERIALS
layout(location = attribute_alpha) in float vertex_alpha;
out float surface_alpha;
#endif
out vec3 albedo;
out vec3 light;
#ifdef TWO_SIDED
out vec3 light_behind;
#endif

// What the person's own palette makes of the vertex' colour.
vec3 tint() {
    int slot = int(look & ((1u << look_slot_bits) - 1u));
    return slot == 0 ? vec3(1.0) : palette_color(slot);
}

void main() {
    vec3 position = placed_position();
    vec3 normal = placed_normal();
    gl_Position = Frame.clip_from_camera_relative * vec4(position, 1.0);
    albedo = linear(vertex_color) * tint();
    light = lit(normal);
#ifdef TWO_SIDED
    light_behind = lit(-normal);
#endif
#ifdef TEXTURED
    texture_uv = uv;
    texture_layer = int(look >> look_slot_bits);
#endif
#ifdef MATERIALS
    surface_alpha = vertex_alpha;
#endif
}
