// What every ground shares, included by the file of shaders/grounds/ that paints it: light, and lines that are faded by
// how many of their widths a pixel covers across them, so that none of them shimmers when it is far.
in vec2 ground;  // world x, z [m]
out vec4 color;

// What a file of shaders/grounds/ is: the surface's linear colour at world x, z [m].
vec3 surface_at(vec2 p);

vec2 pixel_x, pixel_y;  // [m] from here to the next pixel's ground, to the right and up
vec2 footprint;         // [m] how wide a pixel is along x and z

// A line's or an area's edge is a signed distance and the width of a pixel across it, both [m].
vec2 edge_x(float distance) { return vec2(distance, footprint.x); }
vec2 edge_z(float distance) { return vec2(distance, footprint.y); }
vec2 circle(vec2 p, float radius) {
    float r = max(length(p), 1e-6);
    float pixel = (abs(dot(p, pixel_x)) + abs(dot(p, pixel_y))) / r;
    return vec2(r - radius, max(pixel, 1e-4));
}
vec2 box(vec2 p, vec2 half_size) {
    vec2 q = abs(p) - half_size;
    return q.x > q.y ? edge_x(q.x) : edge_z(q.y);
}
vec2 outset(vec2 edge, float by) { return vec2(edge.x - by, edge.y); }
vec2 other_side(vec2 edge) { return vec2(-edge.x, edge.y); }

// Coverage in [0, 1] of a line along an edge: as dark as it is thin, where a pixel is wider.
float line(vec2 edge, float half_width) {
    float pixel = edge.y;
    float w = max(half_width, 0.5 * pixel);
    return clamp((w - abs(edge.x)) / pixel + 0.5, 0.0, 1.0) * half_width / w;
}
float inside(vec2 edge) { return clamp(0.5 - edge.x / edge.y, 0.0, 1.0); }

void main() {
    pixel_x = dFdx(ground);
    pixel_y = dFdy(ground);
    footprint = max(abs(pixel_x) + abs(pixel_y), 1e-4);
    vec3 light = Frame.sky_light.rgb + Frame.sun_color.rgb * max(Frame.sun_direction.y, 0.0);
    color = vec4(sqrt(surface_at(ground) * light), 1.0);
}
