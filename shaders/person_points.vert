// One splat of a person.
#include "person.glsl"
#include "shares.glsl"
#ifdef OWN_LIGHT
layout(location = attribute_own_light) in vec4 own_light;
#endif
flat out vec3 splat_color;

void main() {
    vec3 position = placed_position();
    vec3 normal = placed_normal();
    vec3 own_color = linear(vertex_color) * tint();
    bool away = dot(normal, position) > 0.0;
    gl_Position = Frame.clip_from_camera_relative * vec4(position, 1.0);
    // No splat outgrows the person it stands for.
    float whole_person = Figure.box_size.w * placement.w * Frame.splat.y / gl_Position.w;
    gl_PointSize = clamp(whole_person, 1.0, Frame.splat.x);
    gl_Position.xy *= Frame.splat.zw;
    // The far side of a closed body is hidden by the near side: drop it before it costs pixels.
    if (away && look == 0u && !is_double_sided()) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    vec3 sent = own_color * lit(away ? -normal : normal);
#ifdef OWN_LIGHT
    sent = mix(sent, own_color, own_light.a) + linear(own_light.rgb);
#endif
    splat_color = sqrt(sent);
}
