in vec3 albedo;
in vec3 light;
#ifdef TWO_SIDED
in vec3 light_behind;
#endif
#ifdef TEXTURED
in vec2 texture_uv;
flat in int texture_layer;
layout(binding = texture_unit_layers) uniform sampler2DArray layers;
#endif
#ifdef MATERIALS
in float surface_alpha;
layout(location = uniform_texturings) uniform vec4 texturings[2 * texturing_count];
#include "texturing.glsl"
#endif
out vec4 color;

void main() {
    vec3 surface = albedo, seen_by = light, emitted = vec3(0.0);
#ifdef TWO_SIDED
    if (!gl_FrontFacing) seen_by = light_behind;
#endif
#ifdef MATERIALS
    vec4 texturing = texturings[2 * texture_layer], emission = texturings[2 * texture_layer + 1];
    vec4 texel = texel_of(layers, texturing, texture_uv);
    if (surface_alpha * texel.a < texturing.w - alpha_rounding) discard;
    surface *= texel.rgb * texel.rgb;
    if ((int(texturing.z) & texturing_unlit) != 0) seen_by = vec3(1.0);
    emitted = emission.rgb;
    if (int(emission.w) != no_layer) {
        vec3 shown = texel_of(layers, vec4(emission.w, texturing.yzw), texture_uv).rgb;
        emitted *= shown * shown;
    }
#elif defined(TEXTURED)
    vec3 texel = texture(layers, vec3(texture_uv, float(texture_layer))).rgb;
    if (texture_layer != no_layer) surface *= texel * texel;
#endif
    color = vec4(sqrt(surface * seen_by + emitted), 1.0);
}
