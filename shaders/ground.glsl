// What every ground shares, included by the file of shaders/grounds/ that paints it: lines that are faded by how many of
// their widths a pixel covers across them, so that none of them shimmers when it is far. Shared with C++.
vec2 pixel_x, pixel_y;  // [m] from here to the next pixel's ground, to the right and up
vec2 footprint;         // [m] how wide a pixel is along x and z

void set_pixel(vec2 to_right, vec2 to_up) {
    pixel_x = to_right;
    pixel_y = to_up;
    footprint = max(abs(pixel_x) + abs(pixel_y), 1e-4f);
}

// A line's or an area's edge is a signed distance and the width of a pixel across it, both [m].
vec2 edge_x(real distance) { return vec2(distance, footprint.x); }
vec2 edge_z(real distance) { return vec2(distance, footprint.y); }
vec2 circle(vec2 p, real radius) {
    real r = max(length(p), 1e-6f);
    real pixel = (abs(dot(p, pixel_x)) + abs(dot(p, pixel_y))) / r;
    return vec2(r - radius, max(pixel, 1e-4f));
}
vec2 box(vec2 p, vec2 half_size) {
    vec2 q = abs(p) - half_size;
    return select(q.x > q.y, edge_x(q.x), edge_z(q.y));
}
vec2 outset(vec2 edge, real by) { return vec2(edge.x - by, edge.y); }
vec2 other_side(vec2 edge) { return vec2(-edge.x, edge.y); }

// Coverage in [0, 1] of a line along an edge: as dark as it is thin, where a pixel is wider.
real line(vec2 edge, real half_width) {
    real pixel = edge.y;
    real w = max(half_width, 0.5f * pixel);
    if (!somewhere(abs(edge.x) < w + pixel)) return 0.0f;
    return clamp((w - abs(edge.x)) / pixel + 0.5f, 0.0f, 1.0f) * half_width / w;
}
real inside(vec2 edge) {
    if (!somewhere(abs(edge.x) < edge.y)) return select(edge.x < 0.0f, 1.0f, 0.0f);
    return clamp(0.5f - edge.x / edge.y, 0.0f, 1.0f);
}

// Of a line along a circle, and of all inside of one. Most pixels are too far from it for its distance to matter.
real ring(vec2 p, real radius, real half_width) {
    real reach = half_width + 2.0f * (footprint.x + footprint.y);
    real inner = max(radius - reach, 0.0f), outer = radius + reach;
    real square = dot(p, p);
    if (!somewhere(max(inner * inner - square, square - outer * outer) < 0.0f)) return 0.0f;
    return line(circle(p, radius), half_width);
}
real disc(vec2 p, real radius) {
    real outer = radius + 2.0f * (footprint.x + footprint.y);
    if (!somewhere(dot(p, p) < outer * outer)) return 0.0f;
    return inside(circle(p, radius));
}

vec3 daylight() { return vec3(Frame.sky_light) + vec3(Frame.sun_color) * max(Frame.sun_direction.y, 0.0f); }

#ifndef __cplusplus
#include "ground.frag"
#endif
