// What a texture shows by a material's own sampler (model/texture_sample.h), where the driver's one sampler won't do.
const float alpha_rounding = 1e-5;  // of sums of bytes

// In [0, 1].
float wrapped(int wrap, float t) {
    if (wrap == wrap_clamp) return clamp(t, 0.0, 1.0);
    if (wrap == wrap_repeat) return fract(t);
    t = 2.0 * fract(0.5 * t);
    return min(t, 2.0 - t);
}

// In [0, side), of one at most one beside it.
int wrapped_texel(int wrap, int texel, int side) {
    if (wrap == wrap_repeat) return texel < 0 ? texel + side : texel >= side ? texel - side : texel;
    return clamp(texel, 0, side - 1);
}

// sRGB, and alpha. `texturing`: layer, or no_layer; wrap across + 4 wrap down; bits; -.
vec4 texel_of(sampler2DArray layers, vec4 texturing, vec2 uv) {
    int level = int(textureQueryLod(layers, uv).x + 0.5);  // the one mipmap that the driver would read itself
    int layer = int(texturing.x);
    if (layer == no_layer) return vec4(1.0);
    int across = int(texturing.y) & 3, down = int(texturing.y) >> 2;
    int side = textureSize(layers, 0).x >> level;  // asked by mipmap, Mesa tells all pixels of a vector the first one's
    vec2 at = vec2(wrapped(across, uv.x), wrapped(down, uv.y)) * float(side);
    bool nearest = (int(texturing.z) & texturing_nearest) != 0;
    if (nearest) return texelFetch(layers, ivec3(min(ivec2(at), side - 1), layer), level);
    at -= 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 share = at - floor(at);
    int x0 = wrapped_texel(across, first.x, side), x1 = wrapped_texel(across, first.x + 1, side);
    int y0 = wrapped_texel(down, first.y, side), y1 = wrapped_texel(down, first.y + 1, side);
    vec4 above = mix(texelFetch(layers, ivec3(x0, y0, layer), level), texelFetch(layers, ivec3(x1, y0, layer), level),
                     share.x);
    vec4 below = mix(texelFetch(layers, ivec3(x0, y1, layer), level), texelFetch(layers, ivec3(x1, y1, layer), level),
                     share.x);
    return mix(above, below, share.y);
}
