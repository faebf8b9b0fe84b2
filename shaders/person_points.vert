// One splat of a person.
#include "person.glsl"
layout(location = attribute_shares) in vec4 shares[slot_vectors];
flat out vec3 splat_color;

float share_of(int slot) { return shares[(slot - 1) / 4][(slot - 1) % 4]; }

// What the person's own palette makes of the point's colour.
vec3 tint() {
    float untinted = 1.0;
    for (int i = 0; i < slot_vectors; ++i) untinted -= dot(shares[i], vec4(1.0));
    vec3 sum = vec3(untinted);
    for (int slot = 1; slot <= slot_count; ++slot) sum += share_of(slot) * palette_color(slot);
    return sum;
}

void main() {
    vec3 position = placed_position();
    vec3 normal = placed_normal();
    vec3 own_color = linear(vertex_color) * tint();
    bool away = dot(normal, position) > 0.0;
    gl_Position = Frame.clip_from_camera_relative * vec4(position, 1.0);
    // No splat outgrows the person it stands for.
    float whole_person = Figure.box_size.w * placement.w * Frame.splat.y / gl_Position.w;
    gl_PointSize = clamp(whole_person, 1.0, Frame.splat.x);
    // The far side of a closed body is hidden by the near side: drop it before it costs pixels.
    if (away && look == 0u && !is_double_sided()) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    splat_color = sqrt(own_color * lit(away ? -normal : normal));
}
