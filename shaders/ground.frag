#ifdef SHADED
#include "contact_grid.glsl"
in vec3 at;  // camera-relative [m]
#endif
in vec2 ground;  // x, z from the structure's origin [m]
out vec4 color;

// What a file of shaders/grounds/ is: the surface's linear colour at that place.
vec3 surface_at(vec2 p);

void main() {
    set_pixel(dFdx(ground), dFdy(ground));
    color = vec4(sqrt(surface_at(ground) * daylight()), 1.0);
#ifdef SHADED
    color.rgb *= left_at(at);
#endif
}
