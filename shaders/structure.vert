// What stands in a place: positions from the structure's origin, lit per vertex; the ground is painted per fragment.
#include "light.glsl"

layout(location = attribute_static_position) in vec3 position;
layout(location = attribute_static_normal) in vec3 normal;
layout(location = attribute_static_color) in vec4 vertex_color;
layout(location = attribute_static_open) in float open;

#ifdef SHADED
out vec3 at;  // camera-relative [m]
#endif
#ifdef GROUND
out vec2 ground;  // x, z from the structure's origin [m]
#else
flat out vec3 surface_color;
#endif

void main() {
    vec3 relative = position - Frame.camera_position.xyz;
    gl_Position = Frame.clip_from_camera_relative * vec4(relative, 1.0);
#ifdef SHADED
    at = relative;
#endif
#ifdef GROUND
    ground = position.xz;
#else
    surface_color = sqrt(vertex_color.rgb * vertex_color.rgb * lit(normal, open));
#endif
}
