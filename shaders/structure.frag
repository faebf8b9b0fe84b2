// Structure: the vertices' colour. GROUND: grass, markings, track and paving from the place alone, each line faded by
// how many of its widths a pixel covers across it, so that none of it shimmers when it is far.
out vec4 color;

#ifndef GROUND
flat in vec3 surface_color;

void main() { color = vec4(surface_color, 1.0); }
#else
in vec2 ground;

// The Laws of the Game's pitch [m]; halves are from the middle, depths from the goal line.
const vec2 pitch_half = vec2(52.5, 34.0);
const float circle_radius = 9.15;   // around the middle, and around the penalty mark
const float penalty_depth = 16.5, penalty_half_width = 20.16;
const float goal_area_depth = 5.5, goal_area_half_width = 9.16;
const float penalty_mark = 11.0;
const float mark_radius = 0.12;
const float line_half_width = 0.06;        // [m]
const float lane_width = 1.22;             // [m]
const float lane_count = 8.0;

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

// A box that reaches `depth` into the pitch from the goal line.
vec2 goal_box(vec2 m, float depth, float half_width) {
    return box(m - vec2(pitch_half.x - 0.5 * depth, 0.0), vec2(0.5 * depth, half_width));
}

float markings(vec2 p) {
    vec2 m = vec2(abs(p.x), p.y);  // both halves are alike
    vec2 from_mark = vec2(p.x - sign(p.x) * (pitch_half.x - penalty_mark), p.y);
    float on_pitch = inside(outset(box(p, pitch_half), line_half_width));
    float marks = line(box(p, pitch_half), line_half_width);
    marks = max(marks, line(edge_x(p.x), line_half_width));
    marks = max(marks, line(circle(p, circle_radius), line_half_width));
    marks = max(marks, line(goal_box(m, penalty_depth, penalty_half_width), line_half_width));
    marks = max(marks, line(goal_box(m, goal_area_depth, goal_area_half_width), line_half_width));
    float arc = line(circle(from_mark, circle_radius), line_half_width);
    marks = max(marks, m.x < pitch_half.x - penalty_depth ? arc : 0.0);
    marks = max(marks, inside(circle(from_mark, mark_radius)));
    marks = max(marks, inside(circle(p, mark_radius)));
    return marks * on_pitch;
}

vec3 grass(vec2 p) {
    const float stripe = 5.25;  // [m] twenty mown stripes on a pitch
    float pixel = footprint.x;
    float mown = clamp(0.5 + sin(p.x * 3.14159265 / stripe) / max(pixel, 0.05), 0.0, 1.0);
    mown = mix(mown, 0.5, clamp(pixel / stripe, 0.0, 1.0));
    return mix(vec3(0.050, 0.150, 0.030), vec3(0.068, 0.190, 0.040), mown);
}

vec3 paving(vec2 p) {
    const float slab = 8.0;  // [m]
    vec2 joint = abs(fract(p / slab + 0.5) - 0.5) * slab;
    float joints = max(line(edge_x(joint.x), 0.05), line(edge_z(joint.y), 0.05));
    return mix(vec3(0.26, 0.25, 0.235), vec3(0.19, 0.185, 0.18), joints);
}

void main() {
    pixel_x = dFdx(ground);
    pixel_y = dFdy(ground);
    footprint = max(abs(pixel_x) + abs(pixel_y), 1e-4);
    // Outward from the track's inner line.
    vec2 beyond = vec2(sign(ground.x) * max(abs(ground.x) - Frame.oval.x, 0.0), ground.y);
    vec2 track_edge = circle(beyond, Frame.oval.y);

    vec3 surface = mix(grass(ground), vec3(0.80), markings(ground));
    float track = inside(other_side(track_edge)) * inside(outset(track_edge, lane_count * lane_width));
    vec2 lane = outset(track_edge, lane_width * round(track_edge.x / lane_width));
    vec3 tartan = mix(vec3(0.32, 0.075, 0.045), vec3(0.75), line(lane, 0.025));
    float finish = line(edge_x(ground.x - Frame.oval.x), 0.025) * float(ground.y > 0.0);
    surface = mix(surface, mix(tartan, vec3(0.75), finish), track);
    float apron = inside(other_side(outset(track_edge, lane_count * lane_width)));
    surface = mix(surface, vec3(0.10, 0.17, 0.20), apron);
    surface = mix(surface, paving(ground), inside(other_side(outset(track_edge, Frame.oval.z))));
    vec3 light = Frame.sky_light.rgb + Frame.sun_color.rgb * Frame.sun_direction.y;
    color = vec4(sqrt(surface * light), 1.0);
}
#endif
