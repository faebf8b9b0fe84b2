in vec3 albedo;
in vec3 light;
#ifdef TEXTURED
in vec2 texture_uv;
flat in int texture_layer;
layout(binding = texture_unit_layers) uniform sampler2DArray layers;
#endif
out vec4 color;

void main() {
    vec3 surface = albedo;
#ifdef TEXTURED
    vec3 texel = texture(layers, vec3(texture_uv, float(texture_layer))).rgb;
    if (texture_layer != no_layer) surface *= texel * texel;
#endif
    color = vec4(sqrt(surface * light), 1.0);
}
