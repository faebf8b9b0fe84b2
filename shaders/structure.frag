// What stands in a place: the vertices' colour.
#ifdef SHADED
#include "contact_grid.glsl"
in vec3 at;  // camera-relative [m]
#endif
flat in vec3 surface_color;
out vec4 color;

void main() {
    color = vec4(surface_color, 1.0);
#ifdef SHADED
    color.rgb *= left_at(at);
#endif
}
