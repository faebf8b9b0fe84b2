// What stands in a place: world positions, lit per vertex; the ground is painted per fragment.
#include "light.glsl"

layout(location = attribute_static_position) in vec3 world_position;
layout(location = attribute_static_normal) in vec3 normal;
layout(location = attribute_static_color) in vec4 vertex_color;
layout(location = attribute_static_open) in float open;

#ifdef SHADED
out vec3 at;  // camera-relative [m]
#endif
#ifdef GROUND
out vec2 ground;  // world x, z [m]
#else
flat out vec3 surface_color;
#endif

void main() {
    vec3 relative = world_position - Frame.camera_position.xyz;
    gl_Position = Frame.clip_from_camera_relative * vec4(relative, 1.0);
#ifdef SHADED
    at = relative;
#endif
#ifdef GROUND
    ground = world_position.xz;
#else
    surface_color = sqrt(vertex_color.rgb * vertex_color.rgb * lit(normal, open));
#endif
}
