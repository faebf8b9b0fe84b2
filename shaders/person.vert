// One vertex of a person, or with POINTS one splat: unpack the baked pose, place the person, light it.
layout(location = attribute_position) in vec3 packed_position;
layout(location = attribute_normal) in vec2 packed_normal;
layout(location = attribute_color) in vec3 vertex_color;
#ifdef POINTS
layout(location = attribute_uv) in vec4 shares;
#else
layout(location = attribute_uv) in vec2 uv;
#endif
layout(location = attribute_look) in uint look;
layout(location = attribute_placement) in vec4 placement;
layout(location = attribute_turn) in vec2 turn;
layout(location = attribute_palette) in uvec4 palette;

#ifdef POINTS
flat out vec3 splat_color;
#else
out vec3 albedo;
out vec3 light;
#ifdef TEXTURED
out vec2 texture_uv;
flat out int texture_layer;
#endif
#endif

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

vec3 palette_color(int slot) { return linear(unpackUnorm4x8(palette[slot]).rgb); }

// What the person's own palette makes of the vertex' colour.
vec3 tint() {
#ifdef POINTS
    float untinted = 1.0 - dot(shares, vec4(1.0));
    return vec3(untinted) + shares.x * palette_color(0) + shares.y * palette_color(1) + shares.z * palette_color(2) +
           shares.w * palette_color(3);
#else
    int slot = int(look & ((1u << look_tint_bits) - 1u));
    return slot == 0 ? vec3(1.0) : palette_color(slot - 1);
#endif
}

void main() {
    vec3 model = Figure.box_min.xyz + Figure.box_size.xyz * packed_position;
    vec3 position = placement.xyz + placement.w * turned(model);
    vec3 normal = turned(unfold(packed_normal));
    vec3 own_color = linear(vertex_color) * tint();
    bool away = dot(normal, position) > 0.0;
    gl_Position = Frame.clip_from_camera_relative * vec4(position, 1.0);
#ifdef POINTS
    // No splat outgrows the person it stands for.
    float whole_person = Figure.box_size.w * placement.w * Frame.splat.y / gl_Position.w;
    gl_PointSize = clamp(whole_person, 1.0, Frame.splat.x);
    // The far side of a closed body is hidden by the near side: drop it before it costs pixels.
    if (away && look == 0u && Figure.box_min.w == 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    splat_color = sqrt(own_color * lit(away ? -normal : normal));
#else
    albedo = own_color;
    light = lit(away && Figure.box_min.w != 0.0 ? -normal : normal);
#ifdef TEXTURED
    texture_uv = uv;
    texture_layer = int(look >> look_tint_bits);
#endif
#endif
}
