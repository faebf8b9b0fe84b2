in vec3 albedo;
in vec3 light;
#ifdef TEXTURED
in vec2 texture_uv;
flat in int texture_layer;
layout(binding = texture_unit_layers) uniform sampler2DArray layers;
#endif
#ifdef MATERIALS
in float surface_alpha;
layout(location = uniform_texturings) uniform vec4 texturings[texturing_count];
#include "texturing.glsl"
#endif
out vec4 color;

void main() {
    vec3 surface = albedo, seen_by = light;
#ifdef MATERIALS
    vec4 texturing = texturings[texture_layer];
    vec4 texel = texel_of(layers, texturing, texture_uv);
    if (surface_alpha * texel.a < texturing.w - alpha_rounding) discard;
    surface *= texel.rgb * texel.rgb;
    if ((int(texturing.z) & texturing_unlit) != 0) seen_by = vec3(1.0);
#elif defined(TEXTURED)
    vec3 texel = texture(layers, vec3(texture_uv, float(texture_layer))).rgb;
    if (texture_layer != no_layer) surface *= texel * texel;
#endif
    color = vec4(sqrt(surface * seen_by), 1.0);
}
